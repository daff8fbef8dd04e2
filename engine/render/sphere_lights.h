// The lights that are spheres to rays: spheres, and points and spots with a radius. They are no meshes but what they are, and sampled by
// the solid angle that they fill.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace blush {

struct SphereLight {
    Id<Node> node;
    Id<Light> light;
    Vec3d center;  // world space
    double radius; // metres: the light's own, scaled by its node as volumes are, to the cube root of the determinant
    bool visible_to_camera;
    bool operator==(const SphereLight&) const = default;
};

// Enabled and visible ones - where lights are mixed those that are off too, as black bodies - in node order. One without a radius, or whose place is no finite number, gives no light and is left out.
std::vector<SphereLight> list_sphere_lights(const Scene& scene);
// The light is one of them.
bool is_sphere_light(const Light& light);

} // namespace blush
