// Finds unreadable text in ImGui draw data: cut off at a side of its clip rectangle, below other text, or below a filled shape.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace blush::test {

// A letter on the screen.
struct DrawnGlyph {
    float x0, y0, x1, y1; // the visible part
    ImWchar code = 0;
    bool cut = false; // at its left or right side
    int at = 0;       // position in the indices of its draw list
};

// An opaque triangle without texture.
struct FilledTriangle {
    ImVec2 a, b, c;
    int at; // as DrawnGlyph::at

    bool covers(const ImVec2& p) const {
        const auto side = [&](const ImVec2& from, const ImVec2& to) {
            return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
        };
        const float ab = side(a, b), bc = side(b, c), ca = side(c, a);
        return (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
    }
};

inline std::vector<FilledTriangle> filled_triangles(const ImDrawList& list) {
    const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
    std::vector<FilledTriangle> found;
    for (const ImDrawCmd& cmd : list.CmdBuffer) {
        if (cmd.UserCallback) continue;
        for (unsigned i = cmd.IdxOffset; i + 3 <= cmd.IdxOffset + cmd.ElemCount; i += 3) {
            const auto vertex = [&](unsigned k) -> const ImDrawVert& {
                return list.VtxBuffer[int(cmd.VtxOffset + list.IdxBuffer[int(i + k)])];
            };
            const auto is_filled = [&](const ImDrawVert& v) {
                return v.uv.x == white.x && v.uv.y == white.y && (v.col >> IM_COL32_A_SHIFT & 255) == 255;
            };
            if (is_filled(vertex(0)) && is_filled(vertex(1)) && is_filled(vertex(2)))
                found.push_back({vertex(0).pos, vertex(1).pos, vertex(2).pos, int(i)});
        }
    }
    return found;
}

class GlyphFinder {
public:
    GlyphFinder() {
        for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
            for (const ImFontGlyph& glyph : font->Glyphs)
                if (glyph.Visible) glyphs_.push_back(glyph);
        std::ranges::sort(glyphs_, {}, &ImFontGlyph::V0);
    }

    // From one draw list, in drawing order.
    std::vector<DrawnGlyph> glyphs_of(const ImDrawList& list) const {
        std::vector<DrawnGlyph> drawn;
        for (const ImDrawCmd& cmd : list.CmdBuffer) {
            if (cmd.UserCallback) continue;
            for (unsigned i = cmd.IdxOffset; i + 6 <= cmd.IdxOffset + cmd.ElemCount;) {
                const ImDrawIdx* idx = &list.IdxBuffer[int(i)];
                if (!is_quad(idx)) {
                    i += 3;
                    continue;
                }
                if (const auto glyph =
                        drawn_glyph(list.VtxBuffer[int(cmd.VtxOffset + idx[0])], list.VtxBuffer[int(cmd.VtxOffset + idx[2])], cmd.ClipRect);
                    glyph.code) {
                    drawn.push_back(glyph);
                    drawn.back().at = int(i);
                }
                i += 6;
            }
        }
        return drawn;
    }

private:
    static bool is_quad(const ImDrawIdx* i) {
        return i[1] == i[0] + 1 && i[2] == i[0] + 2 && i[3] == i[0] && i[4] == i[2] && i[5] == i[0] + 3;
    }

    // The texture coordinates identify the glyph; a partial glyph is cut.
    DrawnGlyph drawn_glyph(const ImDrawVert& low, const ImDrawVert& high, const ImVec4& clip) const {
        constexpr float e = 1e-5f;
        DrawnGlyph drawn{low.pos.x, low.pos.y, high.pos.x, high.pos.y};
        if (high.uv.x <= low.uv.x || high.uv.y <= low.uv.y) return drawn;
        for (const ImFontGlyph& g : glyphs_) {
            if (g.V0 > low.uv.y + e) break;
            if (low.uv.x < g.U0 - e || low.uv.y < g.V0 - e || high.uv.x > g.U1 + e || high.uv.y > g.V1 + e) continue;
            drawn.code = ImWchar(g.Codepoint);
            drawn.cut = high.uv.x - low.uv.x < 0.9f * (g.U1 - g.U0) || drawn.x1 > clip.z + 1 || drawn.x0 < clip.x - 1;
            const bool in_sight = drawn.y1 > clip.y && drawn.y0 < clip.w;
            if (!in_sight) drawn.code = 0;
            return drawn;
        }
        return drawn;
    }

    std::vector<ImFontGlyph> glyphs_; // by V0
};

// The line of text of a glyph.
inline std::string line_around(const std::vector<DrawnGlyph>& glyphs, size_t i) {
    std::string text;
    const size_t from = i > 40 ? i - 40 : 0;
    for (size_t k = from; k < std::min(glyphs.size(), i + 8); ++k) {
        if (std::abs(glyphs[k].y1 - glyphs[i].y1) > (glyphs[i].y1 - glyphs[i].y0) + 6) continue;
        if (k > from && glyphs[k].x0 > glyphs[k - 1].x1 + 3) text += ' ';
        text += glyphs[k].code < 128 ? char(glyphs[k].code) : '?';
    }
    return text;
}

// One sentence per unreadable text; empty: all is readable. Lists whose name contains `scrolled` may be cut, because they scroll
// horizontally.
inline std::vector<std::string> unreadable_text(const ImDrawData& data, const std::vector<std::string>& scrolled = {}) {
    const GlyphFinder finder;
    std::vector<std::string> found;
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        const std::string name = list._OwnerName ? list._OwnerName : "";
        if (std::ranges::any_of(scrolled, [&](const std::string& s) { return name.find(s) != std::string::npos; })) continue;
        const std::vector<DrawnGlyph> glyphs = finder.glyphs_of(list);
        const std::vector<FilledTriangle> filled = filled_triangles(list);
        float last_cut_y = -1e9f, last_covered_y = -1e9f;
        for (size_t i = 0; i < glyphs.size(); ++i) {
            const DrawnGlyph& a = glyphs[i];
            const ImVec2 centre{(a.x0 + a.x1) / 2, (a.y0 + a.y1) / 2};
            const auto later = std::ranges::upper_bound(filled, a.at, {}, &FilledTriangle::at);
            if (std::abs(a.y1 - last_covered_y) > 6 && std::any_of(later, filled.end(), [&](const auto& t) { return t.covers(centre); })) {
                found.push_back("covered in " + name + ": " + line_around(glyphs, i));
                last_covered_y = a.y1;
            }
            if (a.cut && std::abs(a.y1 - last_cut_y) > 6) {
                found.push_back("cut in " + name + ": " + line_around(glyphs, i));
                last_cut_y = a.y1;
            }
            for (size_t k = i + 2; k < glyphs.size(); ++k) {
                const DrawnGlyph& b = glyphs[k];
                const float w = std::min(a.x1, b.x1) - std::max(a.x0, b.x0), h = std::min(a.y1, b.y1) - std::max(a.y0, b.y0);
                if (w <= 1 || h <= 1) continue;
                const float smaller = std::min((a.x1 - a.x0) * (a.y1 - a.y0), (b.x1 - b.x0) * (b.y1 - b.y0));
                if (w * h < 0.3f * smaller) continue;
                found.push_back("written over in " + name + ": " + line_around(glyphs, i) + " | " + line_around(glyphs, k));
                i = glyphs.size();
                break;
            }
        }
    }
    return found;
}

} // namespace blush::test
