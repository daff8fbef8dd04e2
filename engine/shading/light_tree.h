// Light tree: traverses a tree of lights towards those that matter to a receiver (Conty Estevez
// and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"). Each sample
// selects one light, without splitting. Instead a node has up to sixteen children: one choice
// among four levels of a binary tree costs twice as much as descending them, and is more accurate.
//
// Only lights at finite distance are in the tree. It is one slot next to the suns and the environment, selected by power.
#pragma once

#include "core/sampler.h"

#include <cstdint>

namespace blush {

// A node has up to 2^tree_branch_bits children; this many trail bits select one of them.
constexpr int tree_branch_bits = 4, max_tree_children = 1 << tree_branch_bits;

// Bounds of the lights below a node: position, and the cone of their emission.
struct LightTreeNode {
    Vec3 center, half;  // of the box of their positions
    float radius;       // of the sphere around it
    Vec3 axis;          // of the cone of their normals
    float sin_o, cos_o; // of its half angle
    float cos_e;        // of the emission angle beyond the normals
    float power;        // sum of their selection powers
    int32_t two_sided;  // some of them are
    int32_t children;   // index of the first child (children are consecutive), -1: a leaf
    int32_t child_count;
    int32_t light; // of a leaf
};

struct LightTree {
    const LightTreeNode* nodes = nullptr; // the first is the root; null: there is no tree
    const uint32_t* trails = nullptr;     // by light: the path from the root, tree_branch_bits for each level, the root's lowest
    const int32_t* depths = nullptr;      // by light: levels above its leaf, -1: not in the tree
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// The point to be lit: lights below the horizon of `normal` do not contribute. A zero normal receives from all sides.
template <class F> struct Receiver { Vec<F> position, normal; };

// Cosine of max(0, a - b), of angles in [0, pi].
template <class F> F cos_of_difference(const F& sin_a, const F& cos_a, const F& sin_b, const F& cos_b) {
    return select(cos_a > cos_b, F(1.f), cos_a * cos_b + sin_a * sin_b);
}
template <class F> F sin_of(const F& cosine) { return sqrt(max(F(0.f), 1.f - cosine * cosine)); }

// Approximate irradiance of the node's lights at the receiver, up to a factor; 0 only if exact.
template <class F> F light_importance(const LightTreeNode* nodes, const Int<F>& node, const Receiver<F>& to) {
    const auto field = [&](float LightTreeNode::*f) { return gather_field(nodes, f, node); };
    const Vec<F> away = to.position - gather_field3<F>(nodes, &LightTreeNode::center, node);
    const F radius = field(&LightTreeNode::radius), r2 = radius * radius;
    const F d2 = max(dot(away, away), F(1e-30f));
    const Vec<F> w = away / sqrt(d2);
    // The cone of the node's bounding sphere as seen by the receiver; from inside, all directions are possible.
    const F sin2_b = r2 / d2;
    const Mask<F> within = sin2_b >= F(1.f);
    const F cos_b = select(within, F(-1.f), sqrt(max(F(0.f), 1.f - sin2_b))), sin_b = select(within, F(0.f), sqrt(min(sin2_b, F(1.f))));

    F cos_w = dot(gather_field3<F>(nodes, &LightTreeNode::axis, node), w);
    cos_w = select(as_mask(gather_field(nodes, &LightTreeNode::two_sided, node) != 0), abs(cos_w), cos_w);
    const F cos_x = cos_of_difference(sin_of(cos_w), cos_w, field(&LightTreeNode::sin_o), field(&LightTreeNode::cos_o));
    const F cos_p = cos_of_difference(sin_of(cos_x), cos_x, sin_b, cos_b);
    const Mask<F> shines = cos_p > field(&LightTreeNode::cos_e);

    // The part of the box above the receiver's horizon: its share, mean height and distance. Bounding it by a sphere would rate a
    // ceiling of lights seen at a grazing angle as if it were overhead.
    const Mask<F> all_sides = dot(to.normal, to.normal) <= F(0.f);
    const F mean = -dot(to.normal, away), spread = dot(abs(to.normal), gather_field3<F>(nodes, &LightTreeNode::half, node));
    const F reach = max(F(0.f), mean + spread);
    const Mask<F> cut = !all_sides && mean < spread;
    const F share = select(cut, reach / max(2.f * spread, F(1e-30f)), F(1.f));
    const F height = select(cut, 0.5f * reach, mean);
    const F lit2 = max(select(cut, d2 - mean * mean + height * height, d2), F(1e-30f));
    const F lit_r2 = select(cut, max(r2 - spread * spread + height * height, F(0.f)), r2);
    const F facing = select(all_sides, F(1.f), min(height / sqrt(lit2), F(1.f)));
    // Inside the bounds, the distance is clamped to a fraction of the node's size.
    const F importance = field(&LightTreeNode::power) * max(cos_p, F(0.f)) * share * facing / max(lit2, 0.05f * lit_r2);
    return select(shines, importance, F(0.f));
}

// The importances of a node's children, and their sum; 0 for missing children.
template <class F> struct ChildImportances { F of[max_tree_children], sum; };
template <class F>
ChildImportances<F> importances_of(const LightTree& tree, const Int<F>& first, const Int<F>& count, const Receiver<F>& to) {
    ChildImportances<F> c;
    c.sum = F(0.f);
    for (int k = 0; k < max_tree_children; ++k) {
        c.of[k] = F(0.f);
        const Mask<F> there = as_mask(count > k);
        if (!any(there)) continue;
        c.of[k] = select(there, light_importance<F>(tree.nodes, select(there, Int<F>(first + k), Int<F>(0)), to), F(0.f));
        c.sum = c.sum + c.of[k];
    }
    return c;
}

template <class F> struct TreeSample {
    Int<F> light;
    F probability; // 0: no light of the tree can illuminate the receiver
    F remainder;   // uniform in [0, 1), independent of the light
};

// Traverses by `u` in [0, 1), which has 24 bits. At each level the remainder of u is refilled from `bits`, because its digits
// would be used up after some levels.
template <class F>
TreeSample<F> sample_tree(const LightTree& tree, const Receiver<F>& to, const F& u, const UInt<F>& bits, const Mask<F>& active) {
    Int<F> node = 0;
    F probability = F(1.f), rest = u;
    UInt<F> random = bits;
    Int<F> first = select(active, gather_field(tree.nodes, &LightTreeNode::children, node), Int<F>(-1));
    while (any(as_mask(first >= 0))) {
        const Mask<F> inner = as_mask(first >= 0);
        const Int<F> count = select(inner, gather_field(tree.nodes, &LightTreeNode::child_count, node), Int<F>(0));
        const ChildImportances<F> c = importances_of<F>(tree, first, count, to);
        const Mask<F> lit = c.sum > F(0.f);
        // Selects the last child with non-zero importance whose range begins at or below the random number.
        const F at = rest * c.sum;
        Int<F> chosen = 0;
        F begin = F(0.f), importance = F(0.f), passed = F(0.f);
        for (int k = 0; k < max_tree_children; ++k) {
            const Mask<F> here = c.of[k] > F(0.f) && (passed <= at);
            chosen = select(here, Int<F>(k), chosen);
            begin = select(here, passed, begin);
            importance = select(here, c.of[k], importance);
            passed = passed + c.of[k];
        }
        random = pcg_hash(random);
        const F within = (at - begin + unit_float<F>(random) * (c.sum * 0x1p-24f)) / max(importance, F(1e-37f));
        probability = select(inner, select(lit, probability * (importance / select(lit, c.sum, F(1.f))), F(0.f)), probability);
        rest = select(inner, min(max(within, F(0.f)), F(one_minus_epsilon)), rest);
        node = select(inner && lit, Int<F>(first + chosen), node);
        first = select(inner && lit, gather_field(tree.nodes, &LightTreeNode::children, node), Int<F>(-1));
    }
    return {gather_field(tree.nodes, &LightTreeNode::light, node), probability, rest};
}

// Probability that sample_tree selects `light`; 0 for lights outside the tree.
template <class F> F tree_probability(const LightTree& tree, const Receiver<F>& to, const Int<F>& light, const Mask<F>& active) {
    UInt<F> trail = gather(tree.trails, light);
    const Int<F> depth = select(active, gather(tree.depths, light), Int<F>(-1));
    Int<F> node = 0;
    F probability = select(as_mask(depth >= 0), F(1.f), F(0.f));
    for (int level = 0; any(as_mask(depth > level)); ++level) {
        const Mask<F> inner = as_mask(depth > level);
        const Int<F> first = select(inner, gather_field(tree.nodes, &LightTreeNode::children, node), Int<F>(0));
        const Int<F> count = select(inner, gather_field(tree.nodes, &LightTreeNode::child_count, node), Int<F>(0));
        const ChildImportances<F> c = importances_of<F>(tree, first, count, to);
        const Int<F> taken = to_signed(UInt<F>(trail & uint32_t(max_tree_children - 1)));
        F importance = F(0.f);
        for (int k = 0; k < max_tree_children; ++k) importance = select(as_mask(taken == k), c.of[k], importance);
        const Mask<F> lit = c.sum > F(0.f);
        probability = select(inner, select(lit, probability * (importance / select(lit, c.sum, F(1.f))), F(0.f)), probability);
        node = select(inner, Int<F>(first + taken), node);
        trail = trail >> tree_branch_bits;
    }
    return probability;
}

} // namespace blush::inline BLUSH_ISA
