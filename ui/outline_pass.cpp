#include "ui/outline_pass.h"

#include <algorithm>

namespace blush {
namespace {

// Outside the objects, as opaque as a ring of eight neighbours finds one of them within `thickness` screen pixels.
const char* const source = R"(
uniform sampler2D picture;
uniform sampler2D mask;
uniform vec2 ring; // thickness in uv
float inside(vec2 at) { return texture(mask, at).r; }
void main() {
    vec2 d = ring * 0.7071;
    float near = max(max(max(inside(uv + vec2(ring.x, 0.0)), inside(uv - vec2(ring.x, 0.0))),
                         max(inside(uv + vec2(0.0, ring.y)), inside(uv - vec2(0.0, ring.y)))),
                     max(max(inside(uv + d), inside(uv - d)), max(inside(uv + vec2(d.x, -d.y)), inside(uv + vec2(-d.x, d.y)))));
    result = vec4(mix(texture(picture, uv).rgb, vec3(1.0, 0.62, 0.2), 0.9 * near * (1.0 - inside(uv))), 1.0);
})";

} // namespace

Result<void> OutlinePass::load() {
    auto program = make_fill_program(source);
    if (!program) return program.error();
    program_ = std::move(*program);
    no_vertices_ = GlVertexArray::create();
    mask_ = GlTexture::create();
    glUseProgram(program_.name());
    glUniform1i(glGetUniformLocation(program_.name(), "mask"), 0);
    glUniform1i(glGetUniformLocation(program_.name(), "picture"), 1);
    return {};
}

void OutlinePass::upload(const Frame& frame, const std::vector<uint8_t>& selected) {
    if (frame.object_id.empty()) {
        width_ = height_ = 0;
        return;
    }
    inside_.resize(frame.object_id.size());
    std::ranges::transform(frame.object_id, inside_.begin(), [&](uint32_t id) { return id < selected.size() && selected[id] ? 255 : 0; });
    width_ = frame.width;
    height_ = frame.height;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mask_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width_, height_, 0, GL_RED, GL_UNSIGNED_BYTE, inside_.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

void OutlinePass::draw(GLuint picture, int width, int height, float thickness) {
    target_.begin(width, height);
    glUseProgram(program_.name());
    glUniform2f(glGetUniformLocation(program_.name(), "ring"), thickness / float(width), thickness / float(height));
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, picture);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mask_.name());
    glBindVertexArray(no_vertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    target_.end();
}

} // namespace blush
