// Meshes whose material has come to need tangents, or others, as rays meet them.
#pragma once

#include "scene/scene.h"

#include <map>
#include <utility>

namespace blush {

// What was made last time, so that what needs the same again is the same geometry and need not be built anew.
class TangentMeshes {
public:
    // Gives parts that need tangents and have none, or such as were made for another UV set (scene/tangents.h), those that they would have
    // been imported with, had their material been in the file as it is. Those that came with a mesh stay.
    void provide(Scene& scene);

private:
    using Key = std::pair<uint64_t, int>; // serial of a geometry, UV set
    std::map<Key, GeometryPtr> known_;
};

} // namespace blush
