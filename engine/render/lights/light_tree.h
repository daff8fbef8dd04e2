// Builds the light tree for sampling many lights (shading/light_tree.h).
#pragma once

#include "core/parallel.h"
#include "shading/light_tree.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace blush {

// Position and emission bounds of a light, or of several.
struct LightBounds {
    Vec3 low{0, 0, 0}, high{0, 0, 0};
    // All lights are within `margin` of these points: the corners of a triangle, else three times the centre.
    std::array<Vec3, 3> corners{};
    double margin = 0;
    Vec3 axis{0, 0, -1}; // unit
    float theta_o = 0;   // half angle of the cone of its normals; pi: all directions
    float theta_e = 0;   // emission angle beyond a normal
    bool two_sided = false;
    double power = 0;
};

// A tree over lights, which are its items.
struct LightTreeShape {
    std::vector<LightTreeNode> nodes; // depth first; empty: no item
    std::vector<int32_t> items;       // by leaf
    std::vector<uint32_t> trails;     // by item; no_trail: not in the tree
};

// Top-down build; splits by the surface area orientation heuristic (Conty Estevez and Kulla 2018). Items without power or with
// non-finite bounds are omitted. The result does not depend on `workers`.
LightTreeShape build_light_tree(std::span<const LightBounds> items, const Workers& workers);

// Sets the selection powers: powers[i] (>= 0) for child ~i, a leaf. Bounds and splits stay as built.
void set_light_tree_powers(std::vector<LightTreeNode>& nodes, std::span<const double> powers);

// The tree of a mesh with many emissive triangles, which are its items.
class MeshTree {
public:
    // `triangles` with powers relative to each other. Not empty: some triangle has power.
    MeshTree(std::span<const LightBounds> triangles, const Workers& workers);
    MeshTree(const MeshTree&) = delete;
    MeshTree& operator=(const MeshTree&) = delete;

    bool empty() const { return shape_.nodes.empty(); }
    // For kernels; valid as long as this object.
    const MeshLightTree& tables() const { return tables_; }
    // Of all triangles, with their total power.
    const LightBounds& bounds() const { return bounds_; }
    size_t memory_bytes() const;

private:
    void tabulate_directions(std::span<const LightBounds> triangles, std::span<const double> powers, const Workers& workers);

    LightTreeShape shape_;
    std::vector<uint32_t> thresholds_;
    std::vector<int32_t> leaves_, guide_;
    std::unique_ptr<MeshPatches> patches_; // null: none
    LightBounds bounds_;
    MeshLightTree tables_{};
};

// The tree of the scene.
struct LightTreeTable {
    std::vector<LightTreeNode> nodes; // a negative child is ~index of its entry
    std::vector<LightTreeEntry> entries;
    std::vector<std::shared_ptr<const MeshTree>> meshes; // of the entries
    std::vector<MeshLightTree> mesh_tables;              // theirs
    std::vector<int32_t> root_lights;                    // by child of the root: its light; -1: a node or a mesh
    std::vector<DistantLight> distant;                   // at most max_distant_lights

    bool empty() const { return nodes.empty() && distant.empty(); }
    // Adds a mesh for an entry; its index.
    int32_t add_mesh(const std::shared_ptr<const MeshTree>& mesh);
    // Fills root_lights.
    void find_root_lights();
    // Valid until the table changes.
    LightTree tables() const;
    size_t memory_bytes() const;
};

// The share of samples that are distributed uniformly over all lights, and within a mesh over its triangles (defensive mixture,
// Hesterberg 1995): a light that is weak in the whole scene may be the only one in a room. Other lights lose at most this share.
constexpr double uniform_share = 1.0 / 64;
// Meshes with fewer emissive triangles have no tree of their own: their triangles are leaves of the scene's tree.
constexpr int64_t min_triangles_for_a_tree = 32;
// Meshes with fewer emissive triangles have no table for distant receivers, which takes 64 KiB: at most 256 bytes a triangle.
constexpr int64_t min_triangles_for_patches = 256;

} // namespace blush
