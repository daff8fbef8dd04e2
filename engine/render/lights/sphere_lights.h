// Lights that are intersected and sampled as exact spheres: sphere lights,
// and point and spot lights with a radius. NEE samples them by solid angle.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace blush {

struct SphereLight {
    Id<Node> node;
    Id<Light> light;
    Vec3d center;  // world space
    double radius; // metres: the light's own, scaled by its node as volumes are, by the cube root of the determinant
    bool visible_to_camera;
    bool operator==(const SphereLight&) const = default;
};

// Enabled and visible ones in node order; with a light mix also disabled ones, as black spheres. Lights without a radius or with
// a non-finite position are omitted. `nodes`: those with lights (expanded_lights.h).
std::vector<SphereLight> list_sphere_lights(const Scene& scene, const std::vector<Id<Node>>& nodes);
// True for light types that are sphere lights.
bool is_sphere_light(const Light& light);

} // namespace blush
