#include "render/lights/missing_light.h"

#include "render/materials/material_factors.h"
#include "render/materials/smoothness.h"
#include "scene/world_transforms.h"

#include <algorithm>
#include <string>

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

// Transmits light, and has lobes with a density.
bool is_rough_and_transmits(const Material& m) {
    return is_translucent(m) || (transmits(m) && (!is_smooth(m) || m.transmission < 1 || m.transmission_texture.texture));
}

} // namespace

SmoothSurfaces smooth_surfaces(const Scene& scene, const std::vector<Id<Material>>& used) {
    SmoothSurfaces surfaces;
    for (const Id<Material> id : used) {
        const Material* m = scene.materials.find(id);
        if (!m) continue;
        surfaces.rough_transmission |= is_rough_and_transmits(*m);
        if (is_smooth_by_texture(*m)) continue;
        const Smoothness smoothness = smoothness_of(*m);
        surfaces.mirror |= smoothness.is_mirror > 0;
        surfaces.glass |= smoothness.is_glass > 0;
    }
    return surfaces;
}

int count_zero_size_lights(const Scene& scene, const std::vector<Id<Node>>& nodes) {
    WorldTransforms transforms(scene);
    return int(std::ranges::count_if(nodes, [&](Id<Node> id) {
        const Light* light = scene.lights.find(scene.nodes.find(id)->light);
        return light->enabled && light->intensity > 0 && !has_size(*light) && transforms(id).visible;
    }));
}

std::string missing_light(const Scene& scene, const std::vector<Id<Node>>& nodes, const SmoothSurfaces& surfaces, CausticFinders finders) {
    if (!surfaces.mirror || count_zero_size_lights(scene, nodes) == 0) return {};
    std::string which;
    if (finders == CausticFinders::none)
        which = std::string("that of point, spot and sun lights of zero size, ") +
                (surfaces.glass ? "through smooth glass or by reflection in smooth surfaces" : "by reflection in smooth surfaces");
    else if (finders == CausticFinders::manifolds)
        which = "caustics of point, spot and sun lights of zero size that";
    else
        which = std::string("caustics of point, spot and sun lights of zero size, where they are seen ") +
                (surfaces.glass ? "through smooth glass or in smooth surfaces" : "in smooth surfaces");
    if (finders == CausticFinders::light_paths_and_manifolds) which += " and";
    if (finders == CausticFinders::manifolds || finders == CausticFinders::light_paths_and_manifolds) {
        if (surfaces.rough_transmission) which += " are on rough glass or translucent surfaces, or";
        which += " come by way of more than six surfaces, or by partial reflections within glass";
    }
    return "some light cannot be found: " + which + "; give these lights a radius or an angle, or the material some roughness";
}

} // namespace blush
