// Builds the light tree for sampling many lights (shading/light_tree.h).
#pragma once

#include "shading/light_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Position and emission bounds of a light.
struct LightBounds {
    Vec3d low{0, 0, 0}, high{0, 0, 0};
    Vec3d axis{0, 0, -1}; // unit
    double theta_o = 0;   // half angle of the cone of its normals; pi: all directions
    double cos_o = 1;     // its cosine, set by build_light_tree
    double theta_e = 0;   // emission angle beyond a normal
    double power = 0;
    bool two_sided = false;
    int32_t light = 0;
};

struct LightTreeTable {
    std::vector<LightTreeNode> nodes;
    std::vector<uint32_t> trails;
    std::vector<int32_t> depths;

    // Valid until the table changes; null if empty.
    LightTree tables() const { return {nodes.empty() ? nullptr : nodes.data(), trails.data(), depths.data()}; }
    size_t memory_bytes() const {
        return nodes.capacity() * sizeof(LightTreeNode) + trails.capacity() * sizeof(uint32_t) + depths.capacity() * sizeof(int32_t);
    }
};

// With fewer lights, sampling by power alone is faster than traversal.
// With more, building the tree would take longer than an edit may.
constexpr int64_t min_lights_for_a_tree = 32, max_lights_for_a_tree = 1 << 15;

// Top-down build; splits by the surface area orientation heuristic (Conty Estevez and Kulla 2018). Lights without power or with a
// non-finite position are omitted. `light_count`: number of all lights, including those outside the tree.
LightTreeTable build_light_tree(std::vector<LightBounds> lights, int32_t light_count);

// Updates the selection powers, powers[i] (>= 0) for light i, of the tree's lights. Bounds and splits stay as built.
void set_light_tree_powers(LightTreeTable& table, std::span<const double> powers);

} // namespace blush
