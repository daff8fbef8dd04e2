// Adds tangents to meshes whose material needs them after an edit, for rendering.
#pragma once

#include "scene/scene.h"

#include <map>
#include <utility>

namespace blush {

// Caches the results, so that unchanged needs keep the same geometry and BVH.
class TangentMeshes {
public:
    // Gives parts that need tangents and have none, or have them for another UV set (scene/geometry/tangents.h), the tangents that import
    // would have made for their current material. Tangents stored in the file are kept.
    void provide(Scene& scene);

private:
    using Key = std::pair<uint64_t, int>; // serial of a geometry, UV set
    std::map<Key, GeometryPtr> known_;
};

} // namespace blush
