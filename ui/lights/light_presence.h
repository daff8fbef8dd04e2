// Whether the scene has any light, muted or not. Recomputed only if a relevant table has changed.
#pragma once

#include "scene/scene.h"

#include <optional>

namespace blush {

class LightPresence {
public:
    bool in(const Scene& scene);

private:
    Table<Node> nodes_;
    Table<Light> lights_;
    Table<Material> materials_;
    Table<Mesh> meshes_;
    SceneSelection scene_selection_;
    Environment environment_;
    std::optional<bool> has_light_;
};

} // namespace blush
