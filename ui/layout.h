// Where the window's regions lie: outliner left, viewport centre, inspector right, menu above, status below.
#pragma once

namespace blush {

struct Region {
    float x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Region&) const = default;
};

// Widths of the side panels in units of the font size, so that they mean the same on every display.
struct Splitters {
    float outliner = 13;
    float inspector = 21;
    bool operator==(const Splitters&) const = default;
};

constexpr Splitters no_side_panels{0, 0};

struct Layout {
    Region outliner, viewport, inspector, status;
    Region time; // below the viewport; of no height if there is none
};

// Regions of a window of width x height pixels below a menu bar. Side panels give way before the viewport gets narrower than it can be
// used.
Layout lay_out(float width, float height, float menu_height, float status_height, float font_size, const Splitters& splitters,
              float time_height = 0);

// The splitters after dragging the bar on the outliner's right (inspector's left) edge to `x` pixels, kept within sensible limits.
Splitters drag_outliner(Splitters splitters, float x, float font_size);
Splitters drag_inspector(Splitters splitters, float x, float width, float font_size);

// The largest rectangle of the given aspect (width / height) inside a region, centred, on whole pixels.
Region fit_aspect(const Region& region, float aspect);

} // namespace blush
