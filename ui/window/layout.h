// Rectangles of the window's regions: menu on top, status bar at the bottom, side panels, and docks to the right of and below the
// viewport.
#pragma once

#include <optional>

namespace blush {

struct Region {
    float x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Region&) const = default;
    bool contains(float px, float py) const { return px >= x && px < x + width && py >= y && py < y + height; }
};

// Widths of the side panels in font sizes, so that they scale with the display.
struct Splitters {
    float outliner = 13;
    float inspector = 21;
    bool operator==(const Splitters&) const = default;
};

constexpr Splitters no_side_panels{0, 0};

// The sides of the viewport where instruments can dock.
enum class DockSide { right, bottom };

// Width of the right dock and height of the bottom one, in font sizes.
struct DockSizes {
    float right = 25, bottom = 17;
    bool operator==(const DockSizes&) const = default;
};

// Areas around the image that reduce its space.
struct ViewportInsets {
    bool right = false, bottom = false; // docks that have content
    DockSizes docks = {};
    float strip = 0, time = 0; // heights below the image, pixels; 0: hidden
};

struct Layout {
    Region outliner, viewport, inspector, status;
    Region room;                                 // viewport without docks and strip; defines the image size
    Region strip, time, right_dock, bottom_dock; // empty if hidden
};

// Regions of a window of width x height pixels below a menu bar. To keep the viewport usable, side panels shrink before it gets
// too narrow, docks and strip before it gets too flat. The bottom dock is as wide as the room; the right dock ends above it.
Layout lay_out(float width, float height, float menu_height, float status_height, float font_size, const Splitters& splitters,
               const ViewportInsets& beside = {});

// True if there is room for a usable dock to the right of a usable viewport. Otherwise the bottom dock has its tabs.
bool has_right_dock(const Region& room, float font_size);

// The splitters after dragging the outliner's right (inspector's left) edge to `x` pixels, clamped to sensible limits.
Splitters drag_outliner(Splitters splitters, float x, float font_size);
Splitters drag_inspector(Splitters splitters, float x, float width, float font_size);
// The same for the right dock's left edge and the bottom dock's upper edge; clamped to what fits into this window.
DockSizes drag_right_dock(DockSizes sizes, float x, const Layout& layout, float font_size);
DockSizes drag_bottom_dock(DockSizes sizes, float y, const Layout& layout, float font_size);

// The dock for an instrument dropped at (x, y): over a dock's tabs, or at the edge of a dock that is hidden.
std::optional<DockSide> dock_at(const Layout& layout, float x, float y, float font_size);

// The largest rectangle of the given aspect ratio (width / height) inside a region, centred, in whole pixels.
Region fit_aspect(const Region& region, float aspect);

} // namespace blush
