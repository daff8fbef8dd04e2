// Area lights as what rays understand: meshes that emit.
#pragma once

#include "render/bent_meshes.h"
#include "render/tangent_meshes.h"
#include "scene/scene.h"

namespace blush {

// Ids at or above this one are made by lowering; without the bit they are those of the light's node.
constexpr uint32_t lowered_bit = 0x80000000u;

// What lowering made of meshes last time.
struct LoweredMeshes {
    TangentMeshes tangents;
    BentMeshes bent;
};

// The same scene with solo (scene/shining.h) and its pose (scene/pose.h) applied and every rectangle and disk that shines replaced by an emissive mesh below its node. A
// disk becomes a polygon of disk_corners() corners and the same area. With the most: sampling either by area is the same, its light differs from the circle's by less
// than a millionth of the flux, and kernels need not know of it. Where lights are mixed, those that are off keep a body that is black.
// Meshes that need tangents have them (render/tangent_meshes.h), and those that bend are bent (render/bent_meshes.h): what `known` has made
// already is not made again.
Scene lower_area_lights(const Scene& scene, LoweredMeshes* known = nullptr);
// Corners of the polygons that stand for disks. A disk takes a hundred bytes of a file, but each corner a light of 250 bytes: of disks without number
// they are fewer, so that all have no more than most_mesh_lights together, and six at least.
constexpr int most_disk_corners = 96;
int disk_corners(const Scene& scene);
// The light is one that lowering turns into a mesh.
bool is_area_light(const Light& light);
// The light whose body a node of the lowered scene is; nullptr: an ordinary node.
const Light* light_of_body(const Scene& lowered, Id<Node> node);
// Linear RGB times intensity: colour, temperature and intensity of a light in its own unit.
Vec3 light_emission(const Light& light);

} // namespace blush
