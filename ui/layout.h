// Where the regions of the window lie: menu above, status below, side panels, and docks beside and below the viewport.
#pragma once

#include <optional>

namespace blush {

struct Region {
    float x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Region&) const = default;
    bool contains(float px, float py) const { return px >= x && px < x + width && py >= y && py < y + height; }
};

// Widths of the side panels in units of the font size, so that they mean the same on every display.
struct Splitters {
    float outliner = 13;
    float inspector = 21;
    bool operator==(const Splitters&) const = default;
};

constexpr Splitters no_side_panels{0, 0};

// The sides of the viewport that instruments open on.
enum class DockSide { right, bottom };

// Width of the right dock and height of the bottom one, in units of the font size.
struct DockSizes {
    float right = 25, bottom = 17;
    bool operator==(const DockSizes&) const = default;
};

// What takes its place from the picture.
struct Beside {
    bool right = false, bottom = false; // docks that hold something
    DockSizes docks = {};
    float strip = 0, time = 0; // pixels of height below the picture; 0: there is none
};

struct Layout {
    Region outliner, viewport, inspector, status;
    Region room;                                 // of the viewport while docks and strip are closed: the image has its size at all times
    Region strip, time, right_dock, bottom_dock; // of no size where there is none
};

// Regions of a window of width x height pixels below a menu bar. Side panels give way before the viewport gets narrower than it can be
// used, docks and strip before it gets flatter. The bottom dock is as wide as the room, the right one ends above it.
Layout lay_out(float width, float height, float menu_height, float status_height, float font_size, const Splitters& splitters,
               const Beside& beside = {});

// Is there room for a dock on the right that can be read, beside a viewport that can be used? Else the bottom dock holds its tabs.
bool has_right_dock(const Region& room, float font_size);

// The splitters after dragging the bar on the outliner's right (inspector's left) edge to `x` pixels, kept within sensible limits.
Splitters drag_outliner(Splitters splitters, float x, float font_size);
Splitters drag_inspector(Splitters splitters, float x, float width, float font_size);
// The same for the right dock's left edge and the bottom dock's upper edge; what they cannot have in this window they do not get.
DockSizes drag_right_dock(DockSizes sizes, float x, const Layout& layout, float font_size);
DockSizes drag_bottom_dock(DockSizes sizes, float y, const Layout& layout, float font_size);

// Where an instrument that is dropped at (x, y) docks: on a dock's tabs, or at the edge that an absent dock would be at.
std::optional<DockSide> dock_at(const Layout& layout, float x, float y, float font_size);

// The largest rectangle of the given aspect (width / height) inside a region, centred, on whole pixels.
Region fit_aspect(const Region& region, float aspect);

} // namespace blush
