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

// The tree of a mesh.
struct MeshLightTree {
    const LightTreeNode* nodes;
    const uint32_t* thresholds; // by leaf: make_thresholds of the powers
    const int32_t* triangles;   // by leaf
    const uint32_t* trails;     // by triangle: the path from the root, tree_branch_bits for each level, the root's lowest; no_trail
    const int32_t* leaves;      // by triangle
    uint32_t leaf_count;
    // The mesh seen from afar; null: it is not large. By direction from the centre and by patch: make_thresholds of what the patch gives.
    // A patch has the leaves whose thresholds are in [i, i + 1) / mesh_patches.
    const uint32_t* patch_thresholds;
    const uint32_t* patch_begins; // first leaf by patch, and the number of leaves
    Vec3 center;
};
constexpr int direction_cells = 16, patch_bits = 6, mesh_patches = 1 << patch_bits; // cells along each side of the octahedral map

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
    const MeshLightTree* mesh; // null: a light
    int32_t light;             // of a mesh: that of its first triangle
    uint32_t trail;            // in the scene's tree
};

struct LightTree {
    const LightTreeNode* nodes = nullptr; // of the scene's tree, the first is the root
    const LightTreeEntry* entries = nullptr;
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
    Mask<V> afar; // they look alike except for their normals: the table by direction of the receiver (patch_thresholds) is accurate enough
};
// They look alike if the least factor of distance, receiver's cosine and emission is at least this share of the largest.
constexpr float like_share = 0.3f, afar_share = 0.1f;

// Approximate irradiance of the child's lights at the receiver, up to a factor; 0 only if exact.
template <class V> ChildImportance<V> child_importance(const ChildBounds<V>& b, const TreeReceiver<V>& to) {
    const Vec<V> away = to.position - b.center;
    const V d2 = max(dot(away, away), V(1e-30f)), d = sqrt(d2), over_d = 1.f / d;
    // The cone of the child's bounding sphere as seen by the receiver; from inside, all directions are possible.
    const V ratio = min(V(b.radius * over_d), V(1.f));
    const Mask<V> within = ratio >= V(1.f);
    const V sin_b = select(within, V(0.f), ratio), cos_b = select(within, V(-1.f), sqrt(V(1.f - ratio * ratio)));

    V cos_w = dot(b.axis, away) * over_d;
    cos_w = float_from_bits(Int<V>(float_bits(cos_w) & b.sides));
    const V sin_w = sqrt(max(V(0.f), V(1.f - cos_w * cos_w)));
    // Angle to the nearest normal: max(0, w - o); then to the nearest direction: max(0, x - b).
    const Mask<V> in_cone = cos_w > b.cos_o;
    const V cos_x = select(in_cone, V(1.f), V(cos_w * b.cos_o + sin_w * b.sin_o));
    const V sin_x = select(in_cone, V(0.f), max(V(0.f), V(sin_w * b.cos_o - cos_w * b.sin_o)));
    const V cos_p = select(cos_x > cos_b, V(1.f), V(cos_x * cos_b + sin_x * sin_b));
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

    // Angle to the farthest direction, w + o + b.
    const V cos_f = (cos_w * b.cos_o - sin_w * b.sin_o) * cos_b - (sin_w * b.cos_o + cos_w * b.sin_o) * sin_b;
    const V near = lowest * ((1.f - sin_b) * (1.f - sin_b)), far = highest * ((1.f + sin_b) * (1.f + sin_b));
    const Mask<V> shaped = b.cos_e >= V(0.02f), may_turn = b.cos_o <= V(0.f) || cos_w <= V(0.f); // the sum of angles may exceed pi

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

// A light of the tree for one receiver; or, on the way to it, what has been selected so far.
struct TreePick {
    int32_t light = 0;
    float probability = 0, remainder = 0;
};

// The leaves of a child.
struct LeafRange {
    uint32_t begin, end;
};
inline LeafRange leaves_of(const LightTreeNode& node, int k) { return {k ? node.leaf_end[k - 1] : node.first_leaf, node.leaf_end[k]}; }
// Where the share of a mesh's leaf begins, of 2^32.
inline uint64_t threshold_of(const MeshLightTree& mesh, uint32_t leaf) {
    return leaf < mesh.leaf_count ? uint64_t(mesh.thresholds[leaf]) : uint64_t(1) << 32;
}

// Selects one of the leaves in `among` in proportion to power, with `u` in [0, 1) (24 bits) and more random bits.
inline TreePick pick_by_power(const LightTreeEntry& entry, const LeafRange& among, float probability, float u, uint32_t random) {
    const MeshLightTree& mesh = *entry.mesh;
    const uint64_t low = threshold_of(mesh, among.begin), total = threshold_of(mesh, among.end) - low;
    const uint64_t number = uint64_t(u * 0x1p24f) << 40 | uint64_t(pcg_hash(random)) << 8;
    const auto product = (unsigned __int128)number * total;
    const uint64_t at = low + uint64_t(product >> 64);
    // The last leaf that begins at or below the number.
    uint32_t leaf = among.begin, count = among.end - among.begin;
    while (count > 1) {
        const uint32_t half = count / 2;
        leaf = mesh.thresholds[leaf + half] <= at ? leaf + half : leaf;
        count -= half;
    }
    const uint64_t begin = threshold_of(mesh, leaf), share = threshold_of(mesh, leaf + 1) - begin;
    const float within = (float(int64_t(at - begin)) + float(int64_t(uint64_t(product) >> 40)) * 0x1p-24f) / float(int64_t(share));
    return {entry.light + mesh.triangles[leaf], probability * (float(int64_t(share)) / float(int64_t(total))),
            min(within, one_minus_epsilon)};
}

// The cell of the octahedral map (Meyer et al. 2010) that contains the direction of `v`.
inline int direction_cell(const Vec3& v) {
    const float scale = 1.f / (abs(v.x) + abs(v.y) + abs(v.z)), x = v.x * scale, y = v.y * scale;
    const float fold_x = x < 0.f ? abs(y) - 1.f : 1.f - abs(y), fold_y = y < 0.f ? abs(x) - 1.f : 1.f - abs(x);
    const auto cell = [](float c) { return min(max(to_int((0.5f * c + 0.5f) * float(direction_cells)), 0), direction_cells - 1); };
    return cell(v.z < 0.f ? fold_x : x) + direction_cells * cell(v.z < 0.f ? fold_y : y);
}
// Thresholds of the mesh's patches for a receiver at `position`.
inline const uint32_t* patches_towards(const MeshLightTree& mesh, const Vec3& position) {
    return mesh.patch_thresholds + direction_cell(position - mesh.center) * mesh_patches;
}
// The end of patch i wraps to 0 if it is the last.
inline uint32_t patch_share(const uint32_t* patches, uint32_t i) {
    return (i + 1 < uint32_t(mesh_patches) ? patches[i + 1] : 0u) - patches[i];
}

// A triangle of a mesh that is seen from afar.
inline TreePick pick_by_direction(const LightTreeEntry& entry, const Vec3& position, const TreePick& so_far, uint32_t random) {
    const uint32_t* patches = patches_towards(*entry.mesh, position);
    random = pcg_hash(random);
    const uint32_t number = uint32_t(so_far.remainder * 0x1p24f) << 8 | random >> 24;
    // The last patch whose threshold is at or below the number; the first is 0.
    int reached = 0;
    for (int k = 0; k < mesh_patches; k += width<Wide>) reached += count(as_mask(load<WideUInt>(patches + k) <= WideUInt(number)));
    const auto patch = uint32_t(reached - 1);
    const LeafRange leaves{entry.mesh->patch_begins[patch], entry.mesh->patch_begins[patch + 1]};
    const uint32_t share = patch_share(patches, patch);
    if (leaves.begin == leaves.end || share == 0) return {};
    const float within = (float(int64_t(number - patches[patch])) + float(int64_t(random & 0xffffffu)) * 0x1p-24f) / float(int64_t(share));
    return pick_by_power(entry, leaves, so_far.probability * (float(int64_t(share)) * 0x1p-32f), min(within, one_minus_epsilon), random);
}

// Traverses from the `chosen` child of the root. At each level the remainder is refilled from `random`, because its digits would be used
// up after some levels.
[[gnu::noinline]] inline TreePick pick_below_root(const LightTree& tree, const Receiver<float>& receiver, int chosen, bool like, bool afar,
                                                  TreePick pick, uint32_t random) {
    const LightTreeNode* node = tree.nodes;
    const LightTreeEntry* entry = nullptr;
    const TreeReceiver<Wide> to = tree_receiver<Wide>(splat<Wide>(receiver.position), splat<Wide>(receiver.normal));
    for (;;) {
        const int32_t child = node->child[chosen];
        if (child >= 0) {
            if (like && entry) return pick_by_power(*entry, leaves_of(*node, chosen), pick.probability, pick.remainder, random);
            node += child;
        } else if (entry) {
            pick.light = entry->light + entry->mesh->triangles[~child];
            return pick;
        } else {
            entry = tree.entries + ~child;
            pick.light = entry->light;
            if (!entry->mesh) return pick;
            if (like) return pick_by_power(*entry, {0, entry->mesh->leaf_count}, pick.probability, pick.remainder, random);
            if (afar && entry->mesh->patch_begins) return pick_by_direction(*entry, receiver.position, pick, random);
            node = entry->mesh->nodes;
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
        random = pcg_hash(random);
        const float within = (at - ends[chosen] + unit_float<float>(random) * (sum * 0x1p-24f)) / importances[chosen];
        pick.probability = pick.probability * (importances[chosen] / sum);
        pick.remainder = min(max(within, 0.f), one_minus_epsilon);
        like = c.like >> chosen & 1;
        afar = c.afar >> chosen & 1;
    }
}

// Probability of `light`, of that entry, if the root's child towards it is chosen.
[[gnu::noinline]] inline float probability_below_root(const LightTree& tree, const Receiver<float>& receiver, const LightTreeEntry& entry,
                                                      int32_t light, bool like, bool afar) {
    const MeshLightTree* mesh = entry.mesh;
    const int32_t triangle = light - entry.light;
    const uint32_t mesh_trail = mesh ? mesh->trails[triangle] : 0;
    if (mesh_trail == no_trail) return 0;
    const auto by_power = [&](const LeafRange& among) {
        const auto leaf = uint32_t(mesh->leaves[triangle]);
        const uint64_t share = threshold_of(*mesh, leaf + 1) - threshold_of(*mesh, leaf);
        return float(int64_t(share)) / float(int64_t(threshold_of(*mesh, among.end) - threshold_of(*mesh, among.begin)));
    };
    const TreeReceiver<Wide> to = tree_receiver<Wide>(splat<Wide>(receiver.position), splat<Wide>(receiver.normal));
    const LightTreeNode* node = tree.nodes;
    uint32_t trail = entry.trail;
    float probability = 1;
    for (bool in_mesh = false;;) {
        int taken = int(trail & (max_tree_children - 1));
        const int32_t child = node->child[taken];
        trail >>= tree_branch_bits;
        if (child >= 0) {
            if (like && in_mesh) return probability * by_power(leaves_of(*node, taken));
            node += child;
        } else {
            if (in_mesh || !mesh) return probability;
            if (like) return probability * by_power({0, mesh->leaf_count});
            if (afar && mesh->patch_begins) {
                const uint32_t patch = mesh->thresholds[mesh->leaves[triangle]] >> (32 - patch_bits);
                const uint32_t share = patch_share(patches_towards(*mesh, receiver.position), patch);
                return probability * (float(int64_t(share)) * 0x1p-32f) *
                       by_power({mesh->patch_begins[patch], mesh->patch_begins[patch + 1]});
            }
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
