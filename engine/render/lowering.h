// Area lights as what rays understand: meshes that emit.
#pragma once

#include "scene/scene.h"

namespace blush {

// Ids at or above this one are made by lowering; without the bit they are those of the light's node.
constexpr uint32_t lowered_bit = 0x80000000u;

// The same scene with every enabled rectangle, disk and sphere, and every point light with a radius, replaced by an emissive mesh below its
// node. A point of radius r and intensity I has the radiance I / (pi r^2), so that it lights a distant surface as without its size. The
// polygons that stand for a disk and a ball have their flux.
Scene lower_area_lights(const Scene& scene);
// The light is one that lowering turns into a mesh.
bool is_area_light(const Light& light);
// Linear RGB times intensity: colour, temperature and intensity of a light in its own unit.
Vec3 light_emission(const Light& light);

} // namespace blush
