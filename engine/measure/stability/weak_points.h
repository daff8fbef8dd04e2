// Numerical weak points of renderers, which the cases of the battery test.
#pragma once

#include <span>
#include <string_view>

namespace blush::stability {

// Numbers of the weak points that cases name.
enum WeakPointNumber {
    leaving_surfaces = 1,
    far_away = 2,
    scales = 3,
    shadow_ends = 4,
    grazing_angles = 5,
    smooth_limit = 6,
    towards_vacuum = 7,
    not_numbers = 8,
    accumulation = 10,
    random_numbers = 11,
    densities = 12,
    no_area = 13,
    frames = 14,
    closed_rooms = 15,
    dynamic_range = 16,
    small_angles = 17,
    importance_maps = 18,
    transparency = 19,
    nested_solids = 20,
    critical_angle = 21,
    output_range = 22,
    determinism = 24,
};

struct WeakPoint {
    int number;
    std::string_view name;
    std::string_view remedy; // the remedy used here, with its source
};

std::span<const WeakPoint> weak_points();
// By number; empty for 0.
const WeakPoint& weak_point(int number);

} // namespace blush::stability
