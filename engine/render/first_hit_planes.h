// First hits of the camera's rays: what is seen, without its light.
#pragma once

#include "core/vec.h"

#include <memory>
#include <span>

namespace blush {

// A pinhole or orthographic camera in world space, for images of the whole film.
struct WorldCamera {
    Vec3d position{0, 0, 0};
    Vec3 right, up, forward; // right and up scaled so that the image spans [-1, 1] in both
    bool orthographic = false;
    bool operator==(const WorldCamera&) const = default;
};

// Views of planes in other memory, top row first.
struct FirstHitPlanes {
    int width = 0, height = 0;
    std::span<const Vec3> albedo, normal; // [0, 1]; world space, 0 on a miss
    std::span<const float> depth;         // metres along the ray; 0 on a miss
    std::shared_ptr<const void> memory;   // keeps what the views point to; null: the caller does
    WorldCamera camera = {};
};
using FirstHitPlanesPtr = std::shared_ptr<const FirstHitPlanes>;

} // namespace blush
