// Expands area lights into emissive meshes, which is all that the kernels handle.
#pragma once

#include "render/compile/deformed_meshes.h"
#include "render/compile/tangent_meshes.h"
#include "scene/scene.h"

namespace blush {

// Set in ids made by expansion; without this bit they are the id of the light's node.
constexpr uint32_t expanded_id_bit = 0x80000000u;

// Cache of the meshes that expansion made last time.
struct ExpandedMeshes {
    TangentMeshes tangents;
    DeformedMeshes bent;
};

// Returns the scene with solo (scene/shining.h) and its pose (scene/pose.h) applied and every enabled rectangle and disk light
// replaced by an emissive mesh below its node. A disk becomes a polygon of the same area with disk_corners() corners. With the
// most corners, area sampling is identical and the flux differs from the circle's by less than a millionth, and kernels need no
// special case. With a light mix, disabled lights keep a black mesh. Meshes that need tangents get them
// (render/tangent_meshes.h), and deforming meshes are deformed (render/bent_meshes.h). `known` caches meshes between calls.
Scene expand_area_lights(const Scene& scene, ExpandedMeshes* known = nullptr);
// Maximal number of polygon corners of disk lights. A disk takes a hundred bytes of a file, but each corner is a light of 250
// bytes: with many disks the number is reduced, down to six, so that all together stay below max_mesh_lights.
constexpr int max_disk_corners = 96;
int disk_corners(const Scene& scene);
// True for light types that are expanded into a mesh.
bool is_area_light(const Light& light);
// The light whose mesh a node of the expanded scene is; nullptr: an ordinary node.
const Light* light_of_expanded_mesh(const Scene& expanded, Id<Node> node);
// Linear RGB times intensity: colour, temperature and intensity of a light in its own unit.
Vec3 light_emission(const Light& light);

} // namespace blush
