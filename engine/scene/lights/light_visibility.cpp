#include "scene/lights/light_visibility.h"

#include <algorithm>

namespace blush {
namespace {

bool has_solo_material(const Scene& scene, const Node& node) {
    const Mesh* mesh = scene.meshes.find(node.mesh);
    return mesh && std::ranges::any_of(mesh->parts, [&](const MeshPart& part) {
               const Material* m = scene.materials.find(part.material);
               return m && m->solo && has_emission(*m);
           });
}

bool some_emission_is_muted(const Scene& scene) {
    return std::ranges::any_of(scene.materials, [](const auto& entry) { return !entry.value.emits; });
}

void apply_to_materials(Scene& scene, bool some_solo) {
    const Table<Material> materials = scene.materials;
    for (auto [id, material] : materials) {
        if (material.emissive == Vec3{0, 0, 0}) continue;
        if (!material.emits || (some_solo && !material.solo)) material.emissive_strength = 0;
        material.emits = true;
        material.solo = false;
        scene.materials.set(id, material);
    }
}

} // namespace

bool any_solo(const Scene& scene) {
    const Environment& e = scene.environment;
    if (e.solo && e.kind != Environment::Kind::none) return true;
    // Checks the few records first: most scenes need no pass over the many nodes.
    const auto solo = [](const auto& entry) { return entry.value.solo; };
    const bool lights = std::ranges::any_of(scene.lights, solo), materials = std::ranges::any_of(scene.materials, solo);
    return (lights || materials) && std::ranges::any_of(scene.nodes, [&](const auto& entry) {
               const Light* light = lights ? scene.lights.find(entry.value.light) : nullptr;
               return (light && light->solo) || (materials && has_solo_material(scene, entry.value));
           });
}

Scene with_solo_applied(const Scene& scene) {
    const bool some_solo = any_solo(scene);
    if (!some_solo && !some_emission_is_muted(scene)) return scene;
    Scene applied = scene;
    apply_to_materials(applied, some_solo);
    if (!some_solo) return applied;
    // Intensity 0 instead of no environment, so that its importance map stays valid for when solo ends.
    if (!scene.environment.solo) applied.environment.intensity = 0;
    applied.environment.solo = false;
    for (auto [id, light] : scene.lights) {
        light.enabled = emits_light(light, true);
        light.solo = false;
        applied.lights.set(id, light);
    }
    return applied;
}

} // namespace blush
