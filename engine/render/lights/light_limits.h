// Limits of the number of emitters, so that a small file cannot fill the memory with lights.
#pragma once

#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace blush {

// Limit of sampled emissive triangles, because instances of an emissive mesh multiply a small file. The remaining ones (of
// objects with the most triangles) are found by BSDF sampling only, with full weight: unbiased, but with more noise.
constexpr int64_t max_mesh_lights = int64_t(1) << 20;

// Maximal number of polygon corners of disk lights. A disk takes a hundred bytes of a file, but each corner is a light of 250
// bytes: with many disks the number is reduced, down to six, so that all together stay below max_mesh_lights.
constexpr int max_disk_corners = 96;
inline constexpr std::array disk_corner_choices{max_disk_corners, 48, 24, 12, 6};
// One of disk_corner_choices, for all disks of the scene. `nodes`: those with lights (expanded_lights.h).
int disk_corners(const Scene& scene, const std::vector<Id<Node>>& nodes);

} // namespace blush
