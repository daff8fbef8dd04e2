#include "ui/gl/overdraw.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <epoxy/gl.h>
#include <optional>
#include <vector>

namespace blush {
namespace {

constexpr unsigned few_elements = 60; // drawing a few elements once per part is cheaper than filling covered pixels
constexpr size_t max_parts = 8;

// As ImGui's clip rectangles: from (x, y) to (z, w).
using Rect = ImVec4;

bool is_empty(const Rect& r) { return !(r.x < r.z && r.y < r.w); }
Rect common(const Rect& a, const Rect& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::min(a.z, b.z), std::min(a.w, b.w)}; }
bool is_on_pixels(const Rect& r) {
    return std::floor(r.x) == r.x && std::floor(r.y) == r.y && std::floor(r.z) == r.z && std::floor(r.w) == r.w;
}

// Subtracts a rectangle: the remaining parts above, below and beside it.
std::vector<Rect> without(const std::vector<Rect>& rects, const Rect& hole) {
    std::vector<Rect> left;
    for (const Rect& r : rects) {
        const Rect inner = common(r, hole);
        if (is_empty(inner)) {
            left.push_back(r);
            continue;
        }
        for (const Rect& part : {Rect{r.x, r.y, r.z, inner.y}, Rect{r.x, inner.w, r.z, r.w}, Rect{r.x, inner.y, inner.x, inner.w},
                                 Rect{inner.z, inner.y, r.z, inner.w}})
            if (!is_empty(part)) left.push_back(part);
    }
    return left;
}

struct Ground {
    Rect rect;
    ImU32 color;
};

// The opaque rectangle of whole pixels at the start of a list, as ImGui draws a window's background.
std::optional<Ground> ground_of(const ImDrawList& list) {
    if (list.CmdBuffer.empty()) return {};
    const ImDrawCmd& first = list.CmdBuffer.front();
    if (first.UserCallback || first.ElemCount < 6 || first.TextureId != ImGui::GetIO().Fonts->TexID) return {};
    const auto vertex = [&](unsigned i) -> const ImDrawVert& {
        return list.VtxBuffer[int(first.VtxOffset + list.IdxBuffer[int(first.IdxOffset + i)])];
    };
    const ImVec2 low = vertex(0).pos, high = vertex(2).pos, white = ImGui::GetFontTexUvWhitePixel();
    const ImVec2 corners[] = {low, {high.x, low.y}, high, low, high, {low.x, high.y}};
    const ImU32 color = vertex(0).col;
    for (unsigned i = 0; i < 6; ++i) {
        const ImDrawVert& v = vertex(i);
        if (v.pos.x != corners[i].x || v.pos.y != corners[i].y || v.uv.x != white.x || v.uv.y != white.y || v.col != color) return {};
    }
    const Rect rect = common({low.x, low.y, high.x, high.y}, first.ClipRect);
    if (color >> IM_COL32_A_SHIFT != 255 || is_empty(rect) || !is_on_pixels(rect)) return {};
    return Ground{rect, color};
}

void clear(const ImDrawList*, const ImDrawCmd* command) {
    const ImDrawData& data = *ImGui::GetDrawData();
    const ImVec4 color = ImGui::ColorConvertU32ToFloat4(clearing_color(*command));
    const Rect& r = command->ClipRect;
    const auto pixel = [](float at) { return GLint(std::lround(at)); };
    const GLint left = pixel((r.x - data.DisplayPos.x) * data.FramebufferScale.x),
                right = pixel((r.z - data.DisplayPos.x) * data.FramebufferScale.x);
    const float bottom_edge = data.DisplayPos.y + data.DisplaySize.y;
    const GLint bottom = pixel((bottom_edge - r.w) * data.FramebufferScale.y), top = pixel((bottom_edge - r.y) * data.FramebufferScale.y);
    glScissor(left, bottom, std::max(right - left, 0), std::max(top - bottom, 0));
    glClearColor(color.x, color.y, color.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

ImDrawCmd clearing(const Rect& rect, ImU32 color) {
    ImDrawCmd command;
    command.ClipRect = rect;
    command.UserCallback = clear;
    command.UserCallbackData = reinterpret_cast<void*>(uintptr_t(color));
    return command;
}

// The command, once per visible part; none if it is fully covered.
void add_visible_parts(ImVector<ImDrawCmd>& seen, const ImDrawCmd& command, const std::vector<Rect>& covered) {
    std::vector<Rect> parts{command.ClipRect};
    if (!command.UserCallback)
        for (const Rect& c : covered) parts = without(parts, c);
    if (parts.size() > 1 && (command.ElemCount > few_elements || parts.size() > max_parts)) parts = {command.ClipRect};
    for (const Rect& part : parts) {
        seen.push_back(command);
        seen.back().ClipRect = part;
    }
}

} // namespace

void reduce_overdraw(ImDrawData& data) {
    std::vector<Rect> covered; // covered by windows above
    for (int i = data.CmdListsCount; i-- > 0;) {
        ImDrawList& list = *data.CmdLists[i];
        const std::optional<Ground> ground = ground_of(list);
        ImVector<ImDrawCmd> seen;
        if (ground) {
            list.CmdBuffer.front().IdxOffset += 6;
            list.CmdBuffer.front().ElemCount -= 6;
            std::vector<Rect> parts{ground->rect};
            for (const Rect& c : covered) parts = without(parts, c);
            for (const Rect& part : parts) seen.push_back(clearing(part, ground->color));
        }
        for (const ImDrawCmd& command : list.CmdBuffer)
            if (command.UserCallback || command.ElemCount > 0) add_visible_parts(seen, command, covered);
        list.CmdBuffer.swap(seen);
        if (ground) covered.push_back(ground->rect);
    }
}

bool is_clearing(const ImDrawCmd& command) { return command.UserCallback == clear; }
ImU32 clearing_color(const ImDrawCmd& command) { return ImU32(reinterpret_cast<uintptr_t>(command.UserCallbackData)); }

} // namespace blush
