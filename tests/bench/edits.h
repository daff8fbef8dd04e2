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
// Edits after which directions that were learned before may be of use: some of those above, another colour of the light, a light that
// moves or turns, the move of something that focuses light.
std::vector<EditKind> edits_after_learning(const Scene& scene);

} // namespace blush::bench
