// Light meter: a point on a surface where irradiance is measured.
#pragma once

#include "core/vec.h"
#include "scene/scene.h"

#include <string>

namespace blush {

struct LightMeter {
    std::string name;
    Id<Node> node = {};     // attached to this node; none: fixed in the world
    Vec3 position{0, 0, 0}; // in the node's coordinates
    Vec3 normal{0, 1, 0};   // of the surface there, in the node's coordinates, unit length
    float clearance = 0;    // world metres above the surface, against rounding errors
    bool operator==(const LightMeter&) const = default;
};
constexpr size_t max_light_meters = 100;

// A meter in world space: metres, and the unit normal of the transformed surface.
struct PlacedMeter {
    Vec3d position;
    Vec3d normal;
};
// World position and normal of a meter. A meter whose node was removed is treated as one without node.
PlacedMeter placed(const Scene& scene, const LightMeter& meter);
// A meter at a world position, attached to a node.
LightMeter meter_on(const Scene& scene, Id<Node> node, const Vec3d& position, const Vec3d& normal, std::string name);

} // namespace blush
