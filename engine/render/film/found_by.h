// The strategies that find light, each with planes of its own in a film (strategy planes).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace blush {

enum class FoundBy {
    camera_hit,   // the ray of a path from the camera meets the light
    guided,       // the same, the share of path guiding in the density of the direction
    nee,          // next event estimation
    manifold,     // manifold sampling
    light_vertex, // connection to a light vertex
    light_path,   // a light path reaches the camera; only splats
};
constexpr int found_by_count = 6, path_strategies = 5; // path_strategies: without light paths

// In layers and files.
constexpr std::array<std::string_view, size_t(found_by_count)> found_by_names{"camera_hit", "guided",       "nee",
                                                                              "manifold",   "light_vertex", "light_path"};

} // namespace blush
