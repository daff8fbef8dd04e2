// Meshes that have got a material that needs tangents, as rays meet them.
#pragma once

#include "scene/scene.h"

#include <map>
#include <utility>

namespace blush {

// What was made last time, so that what needs the same again is the same geometry and need not be built anew.
class TangentMeshes {
public:
    // Gives parts that need tangents and have none (scene/tangents.h) those that they would have been imported with, had their material needed
    // them in the file.
    void provide(Scene& scene);

private:
    using Key = std::pair<uint64_t, int>; // serial of a geometry, UV set
    std::map<Key, GeometryPtr> known_;
};

} // namespace blush
