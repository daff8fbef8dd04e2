// Expands area lights into emissive meshes, which is all that the kernels handle.
#pragma once

#include "render/compile/deformed_meshes.h"
#include "render/compile/tangent_meshes.h"
#include "scene/scene.h"

namespace blush {

// Cache of the meshes that expansion made last time.
struct ExpandedMeshes {
    TangentMeshes tangents;
    DeformedMeshes bent;
};

// Returns the scene with solo (light_visibility.h) and its pose (posed_scene.h) applied and every enabled rectangle and disk light
// replaced by an emissive mesh below its node (expanded_lights.h). A disk becomes a polygon of the same area with disk_corners()
// corners (light_limits.h). With the most corners, area sampling is identical and the flux differs from the circle's by less than
// a millionth, and kernels need no special case. With a light mix, disabled lights keep a black mesh. Meshes that need tangents
// get them (tangent_meshes.h), and deforming meshes are deformed (deformed_meshes.h). `known` caches meshes between calls.
Scene expand_area_lights(const Scene& scene, ExpandedMeshes* known = nullptr);

} // namespace blush
