#include "ui/gl/outline_pass.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Drawn outside the objects; opacity is the maximum of the mask at eight neighbours in `thickness` screen pixels distance.
const char* const source = R"(
uniform sampler2D mask;
uniform vec2 ring; // thickness in uv
float inside(vec2 at) { return texture(mask, at).r; }
void main() {
    vec2 d = ring * 0.7071;
    float near = max(max(max(inside(uv + vec2(ring.x, 0.0)), inside(uv - vec2(ring.x, 0.0))),
                         max(inside(uv + vec2(0.0, ring.y)), inside(uv - vec2(0.0, ring.y)))),
                     max(max(inside(uv + d), inside(uv - d)), max(inside(uv + vec2(d.x, -d.y)), inside(uv + vec2(-d.x, d.y)))));
    result = vec4(1.0, 0.62, 0.2, 0.9 * near * (1.0 - inside(uv)));
})";

constexpr int cell = 16; // pixels along a side; larger than the line width

// Cells where the line can be: they have pixels outside the objects, and they or a neighbour have pixels inside. Merged into
// horizontal runs.
std::vector<PixelRect> edges_of(const std::vector<uint8_t>& mask, int width, int height) {
    const int across = (width + cell - 1) / cell, down = (height + cell - 1) / cell;
    const auto index = [&](int x, int y) { return size_t(y) * size_t(across) + size_t(x); };
    std::vector<uint8_t> inside(index(0, down)), outside(inside.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool in = mask[size_t(y) * size_t(width) + size_t(x)] != 0;
            inside[index(x / cell, y / cell)] |= uint8_t(in);
            outside[index(x / cell, y / cell)] |= uint8_t(!in);
        }
    const auto near = [&](int x, int y) {
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, down - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, across - 1); ++u)
                if (inside[index(u, v)]) return true;
        return false;
    };
    std::vector<PixelRect> edges;
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            if (!outside[index(x, y)] || !near(x, y)) continue;
            const int from = x;
            while (x + 1 < across && outside[index(x + 1, y)] && near(x + 1, y)) ++x;
            edges.push_back({from * cell, y * cell, std::min((x + 1) * cell, width), std::min((y + 1) * cell, height)});
        }
    return edges;
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
    return {};
}

void OutlinePass::upload(const Frame& frame, const std::vector<uint8_t>& selected) {
    coming_.resize(frame.object_id.size());
    std::ranges::transform(frame.object_id, coming_.begin(), [&](uint32_t id) { return id < selected.size() && selected[id] ? 255 : 0; });
    // Most frames have the same mask with more samples.
    if (frame.width == width_ && frame.height == height_ && coming_ == inside_) return;
    inside_.swap(coming_);
    width_ = frame.width;
    height_ = frame.height;
    thickness_ = 0;
    edges_.clear();
    if (!inside_.empty()) edges_ = edges_of(inside_, width_, height_);
    if (edges_.empty()) return;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mask_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width_, height_, 0, GL_RED, GL_UNSIGNED_BYTE, inside_.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

void OutlinePass::draw(int width, int height, float thickness) {
    if (edges_.empty() || (thickness == thickness_ && width == target_.width() && height == target_.height())) return;
    thickness_ = thickness;
    target_.begin(width, height);
    textures_changed();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glUseProgram(program_.name());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, mask_.name());
    glBindVertexArray(no_vertices_.name());
    glUniform2f(glGetUniformLocation(program_.name(), "ring"), thickness / float(width), thickness / float(height));
    const float across = float(width) / float(width_), down = float(height) / float(height_);
    glEnable(GL_SCISSOR_TEST); // searching the whole image would cost ten times as much
    for (const PixelRect& edge : edges_) {
        const int x0 = int(std::floor(float(edge.x0) * across)), y0 = int(std::floor(float(edge.y0) * down));
        glScissor(x0, y0, int(std::ceil(float(edge.x1) * across)) - x0, int(std::ceil(float(edge.y1) * down)) - y0);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(0);
    target_.end();
}

} // namespace blush
