// What an artist does to a scene, in steps too small to change what it costs.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace blush::bench {

struct EditKind {
    std::string name;                                  // "light", "material", "camera", "object"
    std::function<void(Scene& scene, int step)> apply; // every step gives another scene
};

// Those that the scene has something for. A scene that is lit by its surfaces or its environment alone has those as its light.
std::vector<EditKind> edits_of(const Scene& scene);

} // namespace blush::bench
