// The objects that focus light, as balls that matte surfaces aim at (shading/focus.h).
#pragma once

#include "render/object_list.h"
#include "scene/scene.h"
#include "shading/focus.h"

#include <cstdint>
#include <map>
#include <vector>

namespace blush {

// A mirror or glass, smooth or nearly so: light leaves it in directions that connections have never or rarely.
bool focuses(const Material& material);

// A ball around all vertices of a payload, in its own space.
struct PayloadBall {
    Vec3d center{0, 0, 0};
    double radius = 0;
};
PayloadBall ball_around(const Geometry& geometry);

// Lists them without looking at every vertex at every edit: the balls of payloads are kept.
class FocusTable {
public:
    static constexpr size_t most_balls = 8; // every surface point looks at all: the largest

    // `objects` as rays meet them; positions are about `origin`. No balls where `wanted` is false.
    void build(const Scene& scene, const std::vector<SceneObject>& objects, const Vec3d& origin, bool wanted);
    FocusTables tables() const { return {balls_.data(), int32_t(balls_.size())}; }
    const std::vector<FocusBall>& balls() const { return balls_; }

private:
    std::vector<FocusBall> balls_;
    std::map<uint64_t, PayloadBall> by_serial_;
};

} // namespace blush
