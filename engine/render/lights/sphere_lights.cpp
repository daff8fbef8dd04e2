#include "render/lights/sphere_lights.h"

#include "core/math.h"
#include "scene/affine.h"
#include "scene/world_transforms.h"

#include <cmath>

namespace blush {

bool is_sphere_light(const Light& light) {
    switch (light.kind) {
    case Light::Kind::sphere: return true;
    case Light::Kind::point:
    case Light::Kind::spot: return light.radius > 0;
    case Light::Kind::sun:
    case Light::Kind::rectangle:
    case Light::Kind::disk: return false;
    }
    return false;
}

std::vector<SphereLight> list_sphere_lights(const Scene& scene, const std::vector<Id<Node>>& nodes) {
    std::vector<SphereLight> spheres;
    WorldTransforms transforms(scene);
    for (const Id<Node> id : nodes) {
        const Node& node = *scene.nodes.find(id);
        const Light* light = scene.lights.find(node.light);
        if (!is_sphere_light(*light) || !transforms(id).visible) continue;
        if (!light->enabled && scene.mix.grouping == LightMix::Grouping::none) continue;
        const Affined& world = transforms(id).world_from_node;
        const double radius = double(light->radius) * std::cbrt(std::abs(determinant(world)));
        if (!is_finite(world) || !(radius > 0) || !std::isfinite(radius)) continue;
        spheres.push_back({id, node.light, world.t, radius, light->visible_to_camera});
    }
    return spheres;
}

} // namespace blush
