#include "render/lights/missing_light.h"

#include "render/materials/material_factors.h"
#include "scene/world_transforms.h"
#include "shading/microfacet.h"

#include <algorithm>

namespace blush {
namespace {

bool has_size(const Light& light) {
    switch (light.kind) {
    case Light::Kind::point:
    case Light::Kind::spot: return light.radius > 0;
    case Light::Kind::sun: return light.angle_radians > 0;
    default: return true;
    }
}

bool has_zero_size_light(const Scene& scene) {
    WorldTransforms placements(scene);
    return std::ranges::any_of(scene.nodes, [&](const auto& entry) {
        const auto& [id, node] = entry;
        const Light* light = node.light ? scene.lights.find(node.light) : nullptr;
        return light && light->enabled && light->intensity > 0 && !has_size(*light) && placements(id).visible;
    });
}

bool is_smooth(const Material& m) { return reflects(m) && unit(m.roughness) < smooth_roughness; }

} // namespace

std::string missing_light(const Scene& scene, const std::vector<Id<Material>>& used) {
    bool glass = false, mirror = false; // all smooth surfaces also reflect
    for (const Id<Material> id : used) {
        const Material* m = scene.materials.find(id);
        if (!m || !is_smooth(*m)) continue;
        glass |= transmits(*m) && !is_thin(*m);
        mirror = true;
    }
    if (!mirror || !has_zero_size_light(scene)) return {};
    const char* by = glass ? "through smooth glass or by reflection in smooth surfaces" : "by reflection in smooth surfaces";
    return std::string("some light cannot be found: that of point, spot and sun lights of zero size, ") + by +
           "; give these lights a radius or an angle, or the material some roughness";
}

} // namespace blush
