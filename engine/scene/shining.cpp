#include "scene/shining.h"

#include <algorithm>

namespace blush {
namespace {

// Intensity 0 instead of no environment: its importance map stays and is there again when solo ends.
void blacken_what_is_no_light(Scene& scene) {
    scene.environment.intensity = 0;
    const Table<Material> materials = scene.materials;
    for (auto [id, material] : materials) {
        if (material.emissive == Vec3{0, 0, 0}) continue;
        material.emissive_strength = 0;
        scene.materials.set(id, material);
    }
}

} // namespace

bool any_solo(const Scene& scene) {
    // Few lights, many nodes: most scenes are answered without looking at the latter.
    if (std::ranges::none_of(scene.lights, [](const auto& entry) { return entry.value.solo; })) return false;
    return std::ranges::any_of(scene.nodes, [&](const auto& entry) {
        const Light* light = scene.lights.find(entry.value.light);
        return light && light->solo;
    });
}

Scene with_solo_applied(const Scene& scene) {
    if (!any_solo(scene)) return scene;
    Scene applied = scene;
    blacken_what_is_no_light(applied);
    for (auto [id, light] : scene.lights) {
        light.enabled = shines(light, true);
        light.solo = false;
        applied.lights.set(id, light);
    }
    return applied;
}

} // namespace blush
