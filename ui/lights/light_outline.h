// Lines that show a light's size, cone and direction in the world. Pure.
#pragma once

#include "ui/viewport/projection.h"

#include <vector>

namespace blush {

// Length of lines without a physical length, such as those of a cone, for a light at this depth in metres.
inline double outline_reach(const Projection& projection, double distance) { return projection.height_at(distance) * 0.16; }

struct WorldLine {
    Vec3d from, to;
};

// Lines for the light of a node, at its true size. The outline of a sphere faces the viewer.
std::vector<WorldLine> light_outline(const Scene& scene, Id<Node> node, const Light& light, const Projection& projection, double reach);

} // namespace blush
