// Builds the tree that many lights are drawn from (shading/light_tree.h).
#pragma once

#include "shading/light_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Where a light is and where it shines.
struct LightBounds {
    Vec3d low{0, 0, 0}, high{0, 0, 0};
    Vec3d axis{0, 0, -1};        // unit
    double theta_o = 0;          // half angle of the cone of its normals; pi: all directions
    double theta_e = 0;          // how far from a normal it still shines
    double power = 0;
    bool two_sided = false;
    int32_t light = 0;
};

struct LightTreeTable {
    std::vector<LightTreeNode> nodes;
    std::vector<uint32_t> trails;
    std::vector<int32_t> depths;

    // Valid until the table changes; none if it is empty.
    LightTree tables() const { return {nodes.empty() ? nullptr : nodes.data(), trails.data(), depths.data()}; }
    size_t memory_bytes() const {
        return nodes.capacity() * sizeof(LightTreeNode) + trails.capacity() * sizeof(uint32_t) + depths.capacity() * sizeof(int32_t);
    }
};

// Fewer lights than these are drawn by power alone: descending would cost more than it saves. With more than those, building would take
// longer than an edit may.
constexpr int64_t fewest_lights_for_a_tree = 32, most_lights_for_a_tree = 1 << 15;

// Top down, each node split where the surface area orientation heuristic says (Conty Estevez and Kulla 2018). Lights without power, or
// whose place is no finite number, are left out. `light_count`: of all lights, those in the tree and others.
LightTreeTable build_light_tree(std::vector<LightBounds> lights, int32_t light_count);

// Draws the tree's lights as if light i had powers[i] (>= 0). What the nodes bound and how they are split stays as it was built.
void weigh_light_tree(LightTreeTable& table, std::span<const double> powers);

} // namespace blush
