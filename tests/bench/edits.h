// Typical edits, in steps small enough to keep the render cost.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace blush::bench {

struct EditKind {
    std::string name;                                  // "light", "material", "camera", "object", "environment"
    std::function<void(Scene& scene, int step)> apply; // each step gives a different scene
};

// The kinds that the scene supports. If a scene is lit only by surfaces or its environment, those are its light.
std::vector<EditKind> edits_of(const Scene& scene);

} // namespace blush::bench
