#include "ui/outline_pass.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace blush {
namespace {

// Outside the objects, as opaque as a ring of eight neighbours finds one of them within `thickness` screen pixels.
const char* const source = R"(
uniform sampler2D picture;
uniform sampler2D mask;
uniform vec2 ring; // thickness in uv; 0: the picture alone
float inside(vec2 at) { return texture(mask, at).r; }
void main() {
    result = vec4(texture(picture, uv).rgb, 1.0);
    if (ring.x == 0.0) return;
    vec2 d = ring * 0.7071;
    float near = max(max(max(inside(uv + vec2(ring.x, 0.0)), inside(uv - vec2(ring.x, 0.0))),
                         max(inside(uv + vec2(0.0, ring.y)), inside(uv - vec2(0.0, ring.y)))),
                     max(max(inside(uv + d), inside(uv - d)), max(inside(uv + vec2(d.x, -d.y)), inside(uv + vec2(-d.x, d.y)))));
    result.rgb = mix(result.rgb, vec3(1.0, 0.62, 0.2), 0.9 * near * (1.0 - inside(uv)));
})";

// The smallest rectangle that holds all pixels that are not 0.
PixelRect rectangle_of(const std::vector<uint8_t>& mask, int width, int height) {
    PixelRect r{width, height, 0, 0};
    for (int y = 0; y < height; ++y) {
        const auto row = mask.begin() + ptrdiff_t(y) * width, end = row + width;
        const auto first = std::find_if(row, end, [](uint8_t m) { return m != 0; });
        if (first == end) continue;
        const auto last = std::find_if(std::reverse_iterator(end), std::reverse_iterator(row), [](uint8_t m) { return m != 0; });
        r = {std::min(r.x0, int(first - row)), std::min(r.y0, y), std::max(r.x1, int(last.base() - row)), y + 1};
    }
    return r;
}

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
    around_ = rectangle_of(inside_, frame.width, frame.height);
    const bool seen = around_.x0 < around_.x1;
    width_ = seen ? frame.width : 0;
    height_ = seen ? frame.height : 0;
    if (!seen) return;
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
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, picture);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mask_.name());
    glBindVertexArray(no_vertices_.name());
    // The picture, and then around the objects, where the line may be, again with it: looking for it costs ten times as much.
    const GLint ring = glGetUniformLocation(program_.name(), "ring");
    glUniform2f(ring, 0, 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glUniform2f(ring, thickness / float(width), thickness / float(height));
    const float across = float(width) / float(width_), down = float(height) / float(height_);
    const auto low = [&](int edge, float scale) { return int(std::floor(float(edge) * scale - thickness)) - 1; };
    const auto high = [&](int edge, float scale) { return int(std::ceil(float(edge) * scale + thickness)) + 1; };
    const int x = low(around_.x0, across), y = low(around_.y0, down);
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, y, high(around_.x1, across) - x, high(around_.y1, down) - y);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(0);
    target_.end();
}

} // namespace blush
