#include "ui/outline_pass.h"

namespace blush {
namespace {

// Outside the object, as opaque as a ring of eight neighbours finds the object within `thickness` screen pixels.
const char* const source = R"(
uniform sampler2D picture;
uniform usampler2D ids;
uniform uint object;
uniform vec2 ring; // thickness in uv
float inside(vec2 at) { return texture(ids, at).r == object ? 1.0 : 0.0; }
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
    ids_ = GlTexture::create();
    glUseProgram(program_.name());
    glUniform1i(glGetUniformLocation(program_.name(), "ids"), 0);
    glUniform1i(glGetUniformLocation(program_.name(), "picture"), 1);
    return {};
}

void OutlinePass::upload(const Frame& frame) {
    if (frame.object_id.empty()) {
        width_ = height_ = 0;
        return;
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, ids_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (frame.width != width_ || frame.height != height_) {
        width_ = frame.width;
        height_ = frame.height;
        glTexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, width_, height_, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, frame.object_id.data());
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
        for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    } else {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, frame.object_id.data());
    }
}

void OutlinePass::draw(GLuint picture, uint32_t object, int width, int height, float thickness) {
    target_.begin(width, height);
    glUseProgram(program_.name());
    glUniform1ui(glGetUniformLocation(program_.name(), "object"), object);
    glUniform2f(glGetUniformLocation(program_.name(), "ring"), thickness / float(width), thickness / float(height));
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, picture);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, ids_.name());
    glBindVertexArray(no_vertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    target_.end();
}

} // namespace blush
