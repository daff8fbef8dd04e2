// Light tree: traverses a tree of lights towards those that matter to a receiver (Conty Estevez and Kulla 2018, "Importance
// Sampling of Many Lights with Adaptive Tree Splitting"). Each sample selects one light, without splitting. Instead a node has up
// to sixteen children: one choice among four levels of a binary tree costs less than descending them, and is more accurate.
//
// There are two levels. Each mesh with many emissive triangles has a tree of its own, which does not depend on the intensity of its
// emission. The tree of the scene has those meshes and all other lights as leaves. Inside a mesh the traversal ends early: where all
// triangles below a child look nearly alike from the receiver, one of them is selected by power. A large mesh that is far away needs no
// traversal at all: a table says by the direction of the receiver how much each part of the mesh contributes.
//
// The root is the same for all paths: its children are evaluated one after the other, with a path in each lane. Below the root it is
// the other way round: the children of one node fill the lanes, for one path after the other. So bounds are read without gathers.
//
// Lights at infinity, suns and the environment, are selected beside the children of the root, by their irradiance at the receiver.
#pragma once

#include "core/block.h"
#include "core/sampler.h"
#include "shading/light_visibility.h"
#include "shading/mesh_light_tree.h"

#include <cstdint>

namespace blush {

// A node has up to 2^tree_branch_bits children; this many trail bits select one of them.
constexpr int tree_branch_bits = 4, max_tree_children = 1 << tree_branch_bits;
constexpr uint32_t no_trail = ~0u; // of a light that is not in the tree

// Bounds of the lights below each child: position, and the cone of their emission. Power 0: there is no such child.
struct alignas(64) LightTreeNode {
    float center[3][max_tree_children], half[3][max_tree_children]; // of the box of their positions
    float radius[max_tree_children];                                // of a sphere around its centre that contains them, too
    float axis[3][max_tree_children];                               // of the cone of their normals
    float sin_o[max_tree_children], cos_o[max_tree_children];       // of its half angle
    float cos_e[max_tree_children];                                 // of the emission angle beyond the normals
    float power[max_tree_children];                                 // sum of their selection powers
    int32_t sides[max_tree_children];     // bits of the cosine to the cone's axis that are kept: without the sign if some are two-sided
    int32_t child[max_tree_children];     // > 0: its node, counted from this one; < 0: ~ the number of the leaf
    uint32_t leaf_end[max_tree_children]; // the child has leaves from leaf_end of the child before it, or first_leaf
    uint32_t first_leaf;
};

// A light at infinity; or all of them, if there are many.
struct DistantLight {
    Vec3 direction;  // unit, towards a sun; zero: the environment or all lights
    float sin_angle; // sine of a sun's angular radius; else 1
    float power;     // pi times the irradiance on a surface that faces it; for the tree's powers see build_light_table
    int32_t light;   // its record; -1: all of them
};
constexpr int max_distant_lights = 16;

// A leaf of the scene's tree: a light or a mesh.
struct LightTreeEntry {
    int32_t mesh;   // index into LightTree::meshes; -1: a light
    int32_t light;  // of a mesh: that of its first triangle
    uint32_t trail; // in the scene's tree
};

struct LightTree {
    const LightTreeNode* nodes = nullptr; // of the scene's tree, the first is the root
    const LightTreeEntry* entries = nullptr;
    const MeshLightTree* meshes = nullptr;
    const int32_t* root_lights = nullptr; // by child of the root: its light; -1: a node or a mesh
    const DistantLight* distant = nullptr;
    int32_t root_count = 0, distant_count = 0; // of the root's children, which is 0 without nodes
    LightVisibilityGrid visibility;

    bool empty() const { return root_count + distant_count == 0; }
};
// The share of samples that is distributed evenly over {the tree, each distant light} where they can illuminate the receiver
// (defensive mixture, Hesterberg 1995): the others may be occluded.
constexpr float even_root_share = 1.f / 64;

} // namespace blush

namespace blush::inline BLUSH_ISA {

// The point to be lit: lights below the horizon of `normal` do not contribute. A zero normal receives from all sides.
template <class F> struct Receiver { Vec<F> position, normal; };

template <class V> struct TreeReceiver {
    Vec<V> position, normal, abs_normal;
    Mask<V> all_sides;
};
template <class V> TreeReceiver<V> tree_receiver(const Vec<V>& position, const Vec<V>& normal) {
    return {position, normal, abs(normal), dot(normal, normal) <= V(0.f)};
}

// The row of one child in all lanes, or those of several children.
template <class V> struct ChildBounds {
    Vec<V> center, half, axis;
    V radius, sin_o, cos_o, cos_e, power;
    Int<V> sides;
};
template <class V> ChildBounds<V> child_bounds(const LightTreeNode& node, int k) {
    const auto in_all_lanes = [&](const auto& row) { return V(row[k]); };
    const auto vector = [&](const float(&r)[3][max_tree_children]) { return Vec<V>{V(r[0][k]), V(r[1][k]), V(r[2][k])}; };
    return {vector(node.center),       vector(node.half),        vector(node.axis),
            in_all_lanes(node.radius), in_all_lanes(node.sin_o), in_all_lanes(node.cos_o),
            in_all_lanes(node.cos_e),  in_all_lanes(node.power), Int<V>(node.sides[k])};
}
// The children from k on, one in each lane.
inline ChildBounds<Wide> children_bounds(const LightTreeNode& node, int k) {
    const auto row = [&](const float* r) { return load<Wide>(r + k); };
    const auto rows = [&](const float(&r)[3][max_tree_children]) { return Vec<Wide>{row(r[0]), row(r[1]), row(r[2])}; };
    return {rows(node.center), rows(node.half), rows(node.axis),
            row(node.radius),  row(node.sin_o), row(node.cos_o),
            row(node.cos_e),   row(node.power), load<WideInt>(node.sides + k)};
}

// A child as seen by a receiver.
template <class V> struct ChildImportance {
    V value;
    Mask<V> lit;  // it is positive
    Mask<V> like; // its lights look nearly alike: selection by power is good enough
    Mask<V> afar; // they look alike except for their normals: the table by direction of the receiver (MeshPatches) is accurate enough
};
// They look alike if the least factor of distance, receiver's cosine and emission is at least this share of the largest.
constexpr float like_share = 0.3f, afar_share = 0.1f;

// Approximate irradiance of the child's lights at the receiver, up to a factor; 0 only if exact.
template <class V> ChildImportance<V> child_importance(const ChildBounds<V>& b, const TreeReceiver<V>& to) {
    const Vec<V> away = to.position - b.center;
    const V d2 = max(dot(away, away), V(1e-30f)), d = sqrt(d2), over_d = 1.f / d;
    const V ratio = min(V(b.radius * over_d), V(1.f));
    const Mask<V> within = ratio >= V(1.f); // all directions are possible
    const V sin_b = select(within, V(0.f), ratio);

    V cos_w = dot(b.axis, away) * over_d;
    cos_w = float_from_bits(Int<V>(float_bits(cos_w) & b.sides));
    const Mask<V> in_cone = cos_w > b.cos_o, may_turn = b.cos_o <= V(0.f) || cos_w <= V(0.f); // the sum of angles may exceed pi
    V cos_p = V(1.f), cos_f = V(0.f);                                                         // cos_f only where not may_turn
    if (!all(in_cone && may_turn)) {
        // The cone of the child's bounding sphere as seen by the receiver.
        const V cos_b = select(within, V(-1.f), sqrt(V(1.f - ratio * ratio)));
        const V sin_w = sqrt(max(V(0.f), V(1.f - cos_w * cos_w)));
        // Angle to the nearest normal: max(0, w - o); then to the nearest direction: max(0, x - b).
        const V cos_x = select(in_cone, V(1.f), V(cos_w * b.cos_o + sin_w * b.sin_o));
        const V sin_x = select(in_cone, V(0.f), max(V(0.f), V(sin_w * b.cos_o - cos_w * b.sin_o)));
        cos_p = select(cos_x > cos_b, V(1.f), V(cos_x * cos_b + sin_x * sin_b));
        // Angle to the farthest direction, w + o + b.
        cos_f = (cos_w * b.cos_o - sin_w * b.sin_o) * cos_b - (sin_w * b.cos_o + cos_w * b.sin_o) * sin_b;
    }
    const Mask<V> emits = cos_p > b.cos_e;

    // The part of the bounds above the receiver's horizon: its share, mean height and distance. Without the box, a ceiling of lights
    // seen at a grazing angle would be rated as if it were overhead; without the sphere, so would a spherical
    // mesh by a receiver on its own surface.
    const V mean = -dot(to.normal, away), spread = min(dot(to.abs_normal, b.half), b.radius);
    V facing = select(to.all_sides, V(1.f), min(V(mean * over_d), V(1.f))), lit2 = d2;
    const V lowest = select(to.all_sides, V(1.f), V(mean - spread)), highest = select(to.all_sides, V(1.f), max(V(0.f), V(mean + spread)));
    const Mask<V> cut = lowest < V(0.f);
    if (any(cut)) {
        const V share = highest / max(V(2.f * spread), V(1e-30f)), height = 0.5f * highest;
        lit2 = select(cut, max(V(d2 - mean * mean + height * height), V(1e-30f)), lit2);
        facing = select(cut, V(share * min(V(height / sqrt(lit2)), V(1.f))), facing);
    }
    // Inside the bounds, the distance is clamped to a fraction of the child's size.
    const V importance = b.power * max(cos_p, V(0.f)) * facing / max(lit2, V(0.05f * (b.radius * b.radius)));

    const V near = lowest * ((1.f - sin_b) * (1.f - sin_b)), far = highest * ((1.f + sin_b) * (1.f + sin_b));
    const Mask<V> shaped = b.cos_e >= V(0.02f);

    ChildImportance<V> c;
    c.lit = emits && importance > V(0.f);                       // not if NaN
    c.value = select(c.lit, min(importance, V(1e36f)), V(0.f)); // their sum is finite
    c.afar = !shaped && !within && near >= afar_share * far;
    c.like = !shaped && !may_turn && !within && cos_f * near >= like_share * (cos_p * far);
    return c;
}

// The children of a node as seen by one receiver, the same in all lanes.
struct ChildImportances {
    Block of;
    unsigned lit = 0, like = 0, afar = 0; // bits by child
};
inline ChildImportances importances_of(const LightTreeNode& node, const TreeReceiver<Wide>& to) {
    ChildImportances all;
    for (int k = 0; k < block_registers; ++k) {
        const int first = k * width<Wide>;
        const ChildImportance<Wide> c = child_importance<Wide>(children_bounds(node, first), to);
        all.of.v[k] = c.value;
        all.lit |= bits(c.lit) << first;
        all.like |= bits(c.like) << first;
        all.afar |= bits(c.afar) << first;
    }
    return all;
}

// The leaves of a child.
inline LeafRange<float> leaves_of(const LightTreeNode& node, int k) {
    return {k ? node.leaf_end[k - 1] : node.first_leaf, node.leaf_end[k]};
}

// A light of the tree for one receiver; or, on the way to it, what has been selected so far.
struct TreePick {
    int32_t light = 0; // of a mesh: that of its first triangle
    float probability = 0, remainder = 0;
    uint32_t random = 0;
    // >= 0: the mesh whose triangle is still to be selected, by power among these leaves; if there are none, by patch.
    int32_t mesh = -1;
    LeafRange<float> among{0, 0};
};

// Traverses from the `chosen` child of the root. At each level the remainder is refilled from `random`, because its digits would be used
// up after some levels.
[[gnu::noinline, gnu::flatten]] inline TreePick pick_below_root(const LightTree& tree, const Receiver<float>& receiver, int chosen,
                                                                bool like, bool afar, TreePick pick) {
    const LightTreeNode* node = tree.nodes;
    const MeshLightTree* mesh = nullptr;
    const TreeReceiver<Wide> to = tree_receiver<Wide>(splat<Wide>(receiver.position), splat<Wide>(receiver.normal));
    const auto in_mesh = [&](int32_t index, const LeafRange<float>& among) {
        pick.mesh = index;
        pick.among = among;
        return pick;
    };
    for (int32_t index = -1;;) {
        const int32_t child = node->child[chosen];
        if (child >= 0) {
            if (like && mesh) return in_mesh(index, leaves_of(*node, chosen));
            node += child;
        } else if (mesh) {
            pick.light = pick.light + mesh->triangles[~child];
            return pick;
        } else {
            const LightTreeEntry& entry = tree.entries[~child];
            pick.light = entry.light;
            index = entry.mesh;
            if (index < 0) return pick;
            mesh = tree.meshes + index;
            if (like) return in_mesh(index, {0, mesh->leaf_count});
            if (afar && mesh->has_patches) return in_mesh(index, {0, 0});
            node = mesh->nodes;
        }
        const ChildImportances c = importances_of(*node, to);
        if (!c.lit) return {};
        // Selects the last child with non-zero importance whose range begins at or below the random number.
        alignas(64) float importances[block_size], ends[block_size + 1];
        store(importances, c.of);
        ends[0] = 0;
        store(ends + 1, prefix_sums(c.of));
        const float sum = ends[block_size], at = pick.remainder * sum;
        unsigned reached = 0;
        for (int k = 0; k < block_registers; ++k)
            reached |= bits(WideMask(load<Wide>(ends + k * width<Wide>) <= Wide(at))) << (k * width<Wide>);
        chosen = int(std::bit_width(reached & c.lit)) - 1;
        pick.random = pcg_hash(pick.random);
        const float within = (at - ends[chosen] + unit_float<float>(pick.random) * (sum * 0x1p-24f)) / importances[chosen];
        pick.probability = pick.probability * (importances[chosen] / sum);
        pick.remainder = min(max(within, 0.f), one_minus_epsilon);
        like = c.like >> chosen & 1;
        afar = c.afar >> chosen & 1;
    }
}

// Probability of `light`, of that entry, if the root's child towards it is chosen.
[[gnu::noinline, gnu::flatten]] inline float probability_below_root(const LightTree& tree, const Receiver<float>& receiver,
                                                                    const LightTreeEntry& entry, int32_t light, bool like, bool afar) {
    const MeshLightTree* mesh = entry.mesh < 0 ? nullptr : tree.meshes + entry.mesh;
    const int32_t triangle = light - entry.light;
    const uint32_t mesh_trail = mesh ? mesh->trails[triangle] : 0;
    if (mesh_trail == no_trail) return 0;
    const uint32_t leaf = mesh ? uint32_t(mesh->leaves[triangle]) : 0;
    const TreeReceiver<Wide> to = tree_receiver<Wide>(splat<Wide>(receiver.position), splat<Wide>(receiver.normal));
    const LightTreeNode* node = tree.nodes;
    uint32_t trail = entry.trail;
    float probability = 1;
    for (bool in_mesh = false;;) {
        int taken = int(trail & (max_tree_children - 1));
        const int32_t child = node->child[taken];
        trail >>= tree_branch_bits;
        if (child >= 0) {
            if (like && in_mesh) return probability * power_probability(*mesh, leaf, leaves_of(*node, taken));
            node += child;
        } else {
            if (in_mesh || !mesh) return probability;
            if (like) return probability * power_probability(*mesh, leaf, {0, mesh->leaf_count});
            if (afar && mesh->has_patches) return probability * patch_probability(*mesh, receiver.position, leaf);
            in_mesh = true;
            node = mesh->nodes;
            trail = mesh_trail;
        }
        const ChildImportances c = importances_of(*node, to);
        taken = int(trail & (max_tree_children - 1));
        if (!(c.lit >> taken & 1)) return 0;
        alignas(64) float importances[block_size], ends[block_size];
        store(importances, c.of);
        store(ends, prefix_sums(c.of));
        probability = probability * (importances[taken] / ends[block_size - 1]);
        like = c.like >> taken & 1;
        afar = c.afar >> taken & 1;
    }
}

// The receivers lane by lane.
template <class F> struct ReceiverLanes {
    float rows[6][width<F>];
    explicit ReceiverLanes(const Receiver<F>& to) {
        store(rows[0], to.position.x);
        store(rows[1], to.position.y);
        store(rows[2], to.position.z);
        store(rows[3], to.normal.x);
        store(rows[4], to.normal.y);
        store(rows[5], to.normal.z);
    }
    Receiver<float> operator[](int i) const { return {{rows[0][i], rows[1][i], rows[2][i]}, {rows[3][i], rows[4][i], rows[5][i]}}; }
};

} // namespace blush::inline BLUSH_ISA
