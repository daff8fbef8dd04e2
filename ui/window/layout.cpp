#include "ui/window/layout.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Font sizes.
constexpr float min_panel_width = 10, max_panel_width = 45, min_viewport_width = 16, min_viewport_height = 9, min_dock_width = 15,
                min_dock_height = 6;

float max_dock_width(const Region& room, float font_size) {
    return std::max(room.width - min_viewport_width * font_size, min_dock_width * font_size);
}

float right_dock_width(const Region& room, float font_size, const ViewportInsets& beside) {
    if (!beside.right || !has_right_dock(room, font_size)) return 0;
    return std::clamp(std::round(beside.docks.right * font_size), min_dock_width * font_size, max_dock_width(room, font_size));
}

// Subtracts docks and strip from the room.
void divide_room(Layout& l, float bottom_edge, float font_size, const ViewportInsets& beside) {
    const float body = bottom_edge - l.room.y, image = std::min(min_viewport_height * font_size, std::floor(body * 0.45f));
    float free = std::max(body - beside.time - image, 0.f);
    float dock = beside.bottom ? std::clamp(std::round(beside.docks.bottom * font_size), 0.f, std::max(free - beside.strip, 0.f)) : 0;
    if (beside.bottom) dock = std::min(std::max(dock, std::round(min_dock_height * font_size)), free);
    free -= dock;
    const float strip = std::min(beside.strip, free), right = right_dock_width(l.room, font_size, beside);
    const float left_of_dock = l.room.width - right;
    l.bottom_dock = {l.room.x, bottom_edge - dock, l.room.width, dock};
    l.time = {l.room.x, l.bottom_dock.y - beside.time, left_of_dock, beside.time};
    l.strip = {l.room.x, l.time.y - strip, left_of_dock, strip};
    l.viewport = {l.room.x, l.room.y, left_of_dock, std::max(l.strip.y - l.room.y, 1.f)};
    l.right_dock = {l.room.x + left_of_dock, l.room.y, right, l.bottom_dock.y - l.room.y};
}

} // namespace

bool has_right_dock(const Region& room, float font_size) { return room.width >= (min_viewport_width + min_dock_width) * font_size; }

Layout lay_out(float width, float height, float menu_height, float status_height, float font_size, const Splitters& splitters,
               const ViewportInsets& beside) {
    float left = std::round(splitters.outliner * font_size), right = std::round(splitters.inspector * font_size);
    const float available = std::max(width - min_viewport_width * font_size, 0.f);
    if (left + right > available) {
        const float shrink = available / (left + right);
        left = std::floor(left * shrink);
        right = std::floor(right * shrink);
    }
    const float body = std::max(height - menu_height - status_height, 1.f);
    ViewportInsets taken = beside;
    taken.time = std::min(beside.time, body - 1);
    Layout l;
    l.outliner = {0, menu_height, left, body};
    l.room = {left, menu_height, std::max(width - left - right, 1.f), body - taken.time};
    divide_room(l, menu_height + body, font_size, taken);
    l.inspector = {width - right, menu_height, right, body};
    l.status = {0, menu_height + body, width, status_height};
    return l;
}

Splitters drag_outliner(Splitters splitters, float x, float font_size) {
    splitters.outliner = std::clamp(x / font_size, min_panel_width, max_panel_width);
    return splitters;
}

Splitters drag_inspector(Splitters splitters, float x, float width, float font_size) {
    splitters.inspector = std::clamp((width - x) / font_size, min_panel_width, max_panel_width);
    return splitters;
}

DockSizes drag_right_dock(DockSizes sizes, float x, const Layout& layout, float font_size) {
    const Region& room = layout.room;
    sizes.right = std::clamp((room.x + room.width - x) / font_size, min_dock_width, max_dock_width(room, font_size) / font_size);
    return sizes;
}

DockSizes drag_bottom_dock(DockSizes sizes, float y, const Layout& layout, float font_size) {
    const Region& dock = layout.bottom_dock;
    const float highest = dock.height + layout.viewport.height - min_viewport_height * font_size;
    sizes.bottom = std::clamp((dock.y + dock.height - y) / font_size, min_dock_height, std::max(highest / font_size, min_dock_height));
    return sizes;
}

std::optional<DockSide> dock_at(const Layout& layout, float x, float y, float font_size) {
    const float edge = 2 * font_size;
    const Region& room = layout.room;
    const float bottom = layout.bottom_dock.y + layout.bottom_dock.height;
    if (x < room.x || x >= room.x + room.width || y < room.y || y >= bottom) return {};
    const float bottom_tabs = layout.bottom_dock.height > 0 ? layout.bottom_dock.y : bottom - edge;
    if (y >= bottom_tabs && y < bottom_tabs + edge) return DockSide::bottom;
    if (!has_right_dock(room, font_size) || y >= bottom_tabs) return {};
    if (layout.right_dock.width > 0) return x >= layout.right_dock.x && y < room.y + edge ? std::optional(DockSide::right) : std::nullopt;
    return x >= room.x + room.width - edge ? std::optional(DockSide::right) : std::nullopt;
}

Region fit_aspect(const Region& region, float aspect) {
    float width = region.width, height = width / aspect;
    if (height > region.height) {
        height = region.height;
        width = height * aspect;
    }
    width = std::max(std::round(width), 1.f);
    height = std::max(std::round(height), 1.f);
    return {std::round(region.x + (region.width - width) / 2), std::round(region.y + (region.height - height) / 2), width, height};
}

} // namespace blush
