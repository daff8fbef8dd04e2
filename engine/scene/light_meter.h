// A place on a surface where the light that falls on it is measured.
#pragma once

#include "core/vec.h"
#include "scene/scene.h"

#include <string>

namespace blush {

struct LightMeter {
    std::string name;
    Id<Node> node = {};     // moves with it; none: fixed in the world
    Vec3 position{0, 0, 0}; // in the node's coordinates
    Vec3 normal{0, 1, 0};   // of the surface there, in the node's coordinates, unit length
    float clearance = 0;    // metres in the world that it is off the surface: what rounding needs
    bool operator==(const LightMeter&) const = default;
};
constexpr size_t most_light_meters = 100;

// A meter in the world: metres, and the unit normal of the surface as it is turned and scaled.
struct PlacedMeter {
    Vec3d position;
    Vec3d normal;
};
// Of a meter whose node is gone, as if it had none.
PlacedMeter placed(const Scene& scene, const LightMeter& meter);
// The meter at a place in the world, bound to a node.
LightMeter meter_on(const Scene& scene, Id<Node> node, const Vec3d& position, const Vec3d& normal, std::string name);

} // namespace blush
