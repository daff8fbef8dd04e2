// Table of caustic casters: bounding spheres of specular objects,
// towards which diffuse surfaces sample directions (shading/focus.h).
#pragma once

#include "render/object_list.h"
#include "scene/scene.h"
#include "shading/focus.h"

#include <cstdint>
#include <map>
#include <vector>

namespace blush {

// True for smooth or nearly smooth mirrors and glass, whose caustics NEE rarely or never finds.
bool focuses(const Material& material);

// Bounding sphere of a geometry, in object space.
struct PayloadBall {
    Vec3d center{0, 0, 0};
    double radius = 0;
};
PayloadBall ball_around(const Geometry& geometry);

// Builds the list without reading all vertices at each edit: caches the spheres of geometries.
class FocusTable {
public:
    static constexpr size_t most_balls = 8; // the largest ones; every diffuse vertex loops over all of them

    // `objects` in their traced form; positions are relative to `origin`. Empty if `wanted` is false.
    void build(const Scene& scene, const std::vector<SceneObject>& objects, const Vec3d& origin, bool wanted);
    FocusTables tables() const { return {balls_.data(), int32_t(balls_.size())}; }
    const std::vector<FocusBall>& balls() const { return balls_; }

private:
    std::vector<FocusBall> balls_;
    std::map<uint64_t, PayloadBall> by_serial_;
};

} // namespace blush
