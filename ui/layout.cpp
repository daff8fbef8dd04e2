#include "ui/layout.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr float narrowest_panel = 10, widest_panel = 45, narrowest_viewport = 16; // font sizes

} // namespace

Layout lay_out(float width, float height, float menu_height, float status_height, float font_size, const Splitters& splitters,
              float time_height) {
    float left = std::round(splitters.outliner * font_size), right = std::round(splitters.inspector * font_size);
    const float available = std::max(width - narrowest_viewport * font_size, 0.f);
    if (left + right > available) {
        const float shrink = available / (left + right);
        left = std::floor(left * shrink);
        right = std::floor(right * shrink);
    }
    const float body = std::max(height - menu_height - status_height, 1.f);
    Layout l;
    l.outliner = {0, menu_height, left, body};
    const float row = std::min(time_height, body - 1);
    l.viewport = {left, menu_height, std::max(width - left - right, 1.f), body - row};
    l.time = {left, menu_height + body - row, l.viewport.width, row};
    l.inspector = {width - right, menu_height, right, body};
    l.status = {0, menu_height + body, width, status_height};
    return l;
}

Splitters drag_outliner(Splitters splitters, float x, float font_size) {
    splitters.outliner = std::clamp(x / font_size, narrowest_panel, widest_panel);
    return splitters;
}

Splitters drag_inspector(Splitters splitters, float x, float width, float font_size) {
    splitters.inspector = std::clamp((width - x) / font_size, narrowest_panel, widest_panel);
    return splitters;
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
