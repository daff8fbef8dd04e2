#include "ui/lights/light_presence.h"

#include "scene/lights/light_rig.h"

namespace blush {
namespace {

// True if nothing is muted and nothing is solo.
Scene all_on(Scene scene) {
    const Table<Light> lights = scene.lights;
    for (auto [id, light] : lights) {
        light.enabled = true;
        light.solo = false;
        scene.lights.set(id, light);
    }
    const Table<Material> materials = scene.materials;
    for (auto [id, material] : materials) {
        material.emits = true;
        material.solo = false;
        scene.materials.set(id, material);
    }
    scene.environment.solo = false;
    return scene;
}

} // namespace

bool LightPresence::in(const Scene& scene) {
    const bool same = has_light_ && scene.nodes.shares_storage(nodes_) && scene.lights.shares_storage(lights_) &&
                      scene.materials.shares_storage(materials_) && scene.meshes.shares_storage(meshes_) &&
                      scene.scene_selection == scene_selection_ && scene.environment == environment_;
    if (same) return *has_light_;
    nodes_ = scene.nodes;
    lights_ = scene.lights;
    materials_ = scene.materials;
    meshes_ = scene.meshes;
    scene_selection_ = scene.scene_selection;
    environment_ = scene.environment;
    return *(has_light_ = has_light(all_on(scene)));
}

} // namespace blush
