// The lines that show a light's size, cone and direction in the world. Pure.
#pragma once

#include "ui/projection.h"

#include <vector>

namespace blush {

// How long lines are that have no length of their own, as those of a cone, for a light that many metres along the view axis.
inline double outline_reach(const Projection& projection, double distance) { return projection.height_at(distance) * 0.16; }

struct WorldLine {
    Vec3d from, to;
};

// Of the light that a node carries. What has a size is drawn in it. A ball's outline faces the eye.
std::vector<WorldLine> light_outline(const Scene& scene, Id<Node> node, const Light& light, const Projection& projection, double reach);

} // namespace blush
