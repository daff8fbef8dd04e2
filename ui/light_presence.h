// Whether the scene has any light, looked up again only when a table that tells has changed.
#pragma once

#include "scene/shining.h"

#include <optional>

namespace blush {

class LightPresence {
public:
    bool in(const Scene& scene) {
        const bool same = has_light_ && scene.nodes.shares_storage(nodes_) && scene.lights.shares_storage(lights_) &&
                          scene.materials.shares_storage(materials_) && scene.meshes.shares_storage(meshes_) &&
                          scene.staging == staging_ && scene.environment == environment_;
        if (same) return *has_light_;
        nodes_ = scene.nodes;
        lights_ = scene.lights;
        materials_ = scene.materials;
        meshes_ = scene.meshes;
        staging_ = scene.staging;
        environment_ = scene.environment;
        return *(has_light_ = has_light(scene));
    }

private:
    Table<Node> nodes_;
    Table<Light> lights_;
    Table<Material> materials_;
    Table<Mesh> meshes_;
    Staging staging_;
    Environment environment_;
    std::optional<bool> has_light_;
};

} // namespace blush
