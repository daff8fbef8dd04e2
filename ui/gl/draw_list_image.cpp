#include "ui/gl/draw_list_image.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

struct Rgba {
    float r = 0, g = 0, b = 0, a = 0;
};
Rgba operator*(const Rgba& c, float k) { return {c.r * k, c.g * k, c.b * k, c.a * k}; }
Rgba operator+(const Rgba& x, const Rgba& y) { return {x.r + y.r, x.g + y.g, x.b + y.b, x.a + y.a}; }

Rgba unpacked(ImU32 c) {
    const auto channel = [&](int shift) { return float(c >> shift & 255) / 255; };
    return {channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT), channel(IM_COL32_A_SHIFT)};
}

// Samples the coverage of ImGui's font atlas, whose colour is white; bilinear, as in the window.
struct Atlas {
    unsigned char* alpha = nullptr;
    int width = 0, height = 0;

    Atlas() { ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&alpha, &width, &height); }
    float texel(int x, int y) const {
        return float(alpha[size_t(std::clamp(y, 0, height - 1)) * size_t(width) + size_t(std::clamp(x, 0, width - 1))]) / 255;
    }
    float at(float u, float v) const {
        const float x = u * float(width) - 0.5f, y = v * float(height) - 0.5f;
        const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
        const float fx = x - float(x0), fy = y - float(y0);
        return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
               (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
    }
};

struct Canvas {
    std::vector<float> rgb;
    int width = 0, height = 0;
    Atlas atlas;

    void blend(int x, int y, const Rgba& c) {
        float* p = &rgb[3 * (size_t(y) * size_t(width) + size_t(x))];
        // The sum of the barycentric weights can be slightly larger than 1.
        const auto over = [&](float& below, float above) { below = std::clamp(below + (above - below) * c.a, 0.f, 1.f); };
        over(p[0], c.r);
        over(p[1], c.g);
        over(p[2], c.b);
    }

    // Pixels whose centre is inside. Top-left rule on edges, so that adjacent triangles do not both draw a pixel.
    void triangle(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, const ImVec4& clip) {
        const auto edge = [](const ImVec2& p, const ImVec2& q, float x, float y) {
            return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
        };
        const float area = edge(a.pos, b.pos, c.pos.x, c.pos.y);
        if (area == 0 || !std::isfinite(area)) return;
        if (area < 0) return triangle(a, c, b, clip);
        const auto owns = [](const ImVec2& p, const ImVec2& q) { return q.y < p.y || (q.y == p.y && q.x > p.x); };
        const bool owned[] = {owns(b.pos, c.pos), owns(c.pos, a.pos), owns(a.pos, b.pos)};
        const auto first = [](float low, float limit) { return std::max(0, int(std::floor(std::max(low, limit)))); };
        const auto last = [](float high, float limit, int size) { return std::min(size, int(std::ceil(std::min(high, limit)))); };
        const int x0 = first(std::min({a.pos.x, b.pos.x, c.pos.x}), clip.x),
                  x1 = last(std::max({a.pos.x, b.pos.x, c.pos.x}), clip.z, width);
        const int y0 = first(std::min({a.pos.y, b.pos.y, c.pos.y}), clip.y),
                  y1 = last(std::max({a.pos.y, b.pos.y, c.pos.y}), clip.w, height);
        const Rgba colors[] = {unpacked(a.col), unpacked(b.col), unpacked(c.col)};
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const float mx = float(x) + 0.5f, my = float(y) + 0.5f;
                const float w[] = {edge(b.pos, c.pos, mx, my), edge(c.pos, a.pos, mx, my), edge(a.pos, b.pos, mx, my)};
                bool inside = true;
                for (int i = 0; i < 3; ++i) inside &= w[i] > 0 || (w[i] == 0 && owned[i]);
                if (!inside) continue;
                const float wa = w[0] / area, wb = w[1] / area, wc = w[2] / area;
                Rgba color = colors[0] * wa + colors[1] * wb + colors[2] * wc;
                color.a *= atlas.at(a.uv.x * wa + b.uv.x * wb + c.uv.x * wc, a.uv.y * wa + b.uv.y * wb + c.uv.y * wc);
                blend(x, y, color);
            }
        }
    }
};

} // namespace

std::vector<float> rasterize(const ImDrawList& list, int width, int height, ImU32 ground) {
    Canvas canvas{std::vector<float>(3 * size_t(width) * size_t(height)), width, height, {}};
    const Rgba base = unpacked(ground);
    for (size_t i = 0; i < canvas.rgb.size(); i += 3) canvas.rgb[i] = base.r, canvas.rgb[i + 1] = base.g, canvas.rgb[i + 2] = base.b;
    const ImTextureID atlas = ImGui::GetIO().Fonts->TexID;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback || command.TextureId != atlas) continue;
        const auto vertex = [&](unsigned i) -> const ImDrawVert& {
            return list.VtxBuffer[int(command.VtxOffset + list.IdxBuffer[int(command.IdxOffset + i)])];
        };
        for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) canvas.triangle(vertex(i), vertex(i + 1), vertex(i + 2), command.ClipRect);
    }
    return std::move(canvas.rgb);
}

} // namespace blush
