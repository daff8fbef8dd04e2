// Selection of one of several lights for a receiver: at the root, among the children of the light tree and the distant lights, with a path
// in each lane; then down the tree (light_tree.h).
#pragma once

#include "shading/light_tree.h"

namespace blush::inline BLUSH_ISA {

// Importances of the root's children, then of the distant lights.
static_assert(max_tree_children + max_distant_lights <= max_visibility_lights);
template <class F> struct RootImportances {
    F of[max_tree_children + max_distant_lights];
    Mask<F> like[max_tree_children], afar[max_tree_children]; // of the root's children
    F sum;
};
template <class F> void find_root_importances(const LightTree& tree, const TreeReceiver<F>& to, RootImportances<F>& root) {
    F near = F(0.f), distant = F(0.f), groups = F(0.f);
    for (int k = 0; k < tree.root_count; ++k) {
        const ChildImportance<F> c = child_importance<F>(child_bounds<F>(tree.nodes[0], k), to);
        root.of[k] = c.value;
        root.like[k] = c.like;
        root.afar[k] = c.afar;
    }
    F* const of_distant = root.of + tree.root_count;
    for (int k = 0; k < tree.distant_count; ++k) {
        const DistantLight& light = tree.distant[k];
        const F cosine = dot(to.normal, splat<F>(light.direction)) + F(light.sin_angle);
        of_distant[k] = light.power * select(to.all_sides, F(1.f), min(max(cosine, F(0.f)), F(1.f)));
    }
    if (tree.visibility.factors)
        apply_visibility<F>(tree.visibility, to.position, to.normal, root.of, tree.root_count + tree.distant_count);
    for (int k = 0; k < tree.root_count; ++k) near = near + root.of[k];
    root.sum = near;
    if (tree.distant_count == 0) return;
    for (int k = 0; k < tree.distant_count; ++k) {
        distant = distant + of_distant[k];
        groups = groups + select(of_distant[k] > F(0.f), F(1.f), F(0.f));
    }
    groups = groups + select(near > F(0.f), F(1.f), F(0.f));
    const F even = even_root_share * (near + distant) / max(groups, F(1.f));
    const F of_near = (1.f - even_root_share) + min(F(even / select(near > F(0.f), near, F(infinity))), F(1e30f));
    root.sum = F(0.f);
    for (int k = 0; k < tree.root_count; ++k) {
        root.of[k] = root.of[k] * of_near;
        root.sum = root.sum + root.of[k];
    }
    for (int k = 0; k < tree.distant_count; ++k) {
        of_distant[k] = select(of_distant[k] > F(0.f), F(of_distant[k] * (1.f - even_root_share) + even), F(0.f));
        root.sum = root.sum + of_distant[k];
    }
}

template <class F> struct TreeSample {
    Int<F> light;  // -1: all distant lights
    F probability; // 0: no light of the tree can illuminate the receiver
    F remainder;   // uniform in [0, 1), independent of the light
};

// Children of the root that are nodes or meshes, in the lanes of `below`.
template <class F> struct RootChild {
    Int<F> chosen;
    Mask<F> like, afar, below;
};
// Selects a light below a child of the root.
template <class F, class Fetch> TreeSample<F> pick_below(const LightTree& tree, const Receiver<F>& to, const RootChild<F>& root,
                                                         TreeSample<F> sample, const UInt<F>& random, const Fetch& fetch) {
    // Most meshes that are alike or far away are children of the root: no traversal.
    const Int<F> child = gather(tree.nodes->child, root.chosen);
    const Mask<F> at_mesh = root.below && as_mask(child < 0);
    const Int<F> entry = select(at_mesh, Int<F>(~child), Int<F>(0));
    MeshPick<F> pick{select(at_mesh, gather_field(tree.entries, &LightTreeEntry::mesh, entry), Int<F>(0)), sample.probability,
                     sample.remainder, random};
    sample.light = select(at_mesh, gather_field(tree.entries, &LightTreeEntry::light, entry), sample.light);
    Mask<F> in_mesh = at_mesh && root.like;
    Mask<F> by_patch = Mask<F>(false);
    LeafRange<F> among{UInt<F>(0u), UInt<F>(0u)};
    if (any(at_mesh)) {
        by_patch = at_mesh && !root.like && root.afar && as_mask(gather_field(tree.meshes, &MeshLightTree::has_patches, pick.mesh) != 0);
        among.end = gather_field(tree.meshes, &MeshLightTree::leaf_count, pick.mesh);
        in_mesh = in_mesh || by_patch;
    }
    if (const unsigned others = bits(Mask<F>(root.below && !in_mesh))) {
        const ReceiverLanes<F> receivers(to);
        const unsigned like_bits = bits(root.like), afar_bits = bits(root.afar);
        alignas(64) int32_t lights[width<F>], meshes[width<F>], patch_lanes[width<F>];
        alignas(64) float probabilities[width<F>], remainders[width<F>];
        alignas(64) uint32_t randoms[width<F>], begins[width<F>], ends[width<F>];
        store(lights, sample.light);
        store(probabilities, sample.probability);
        store(remainders, sample.remainder);
        store(meshes, select(in_mesh, pick.mesh, Int<F>(-1)));
        store(patch_lanes, select(by_patch, Int<F>(1), Int<F>(0)));
        store(randoms, random);
        store(begins, among.begin);
        store(ends, among.end);
        for_each_lane(others, [&](int i) {
            const TreePick one = pick_below_root(tree, receivers[i], lane(root.chosen, i), like_bits >> i & 1, afar_bits >> i & 1,
                                                 {0, probabilities[i], remainders[i], randoms[i]});
            lights[i] = one.light;
            probabilities[i] = one.probability;
            remainders[i] = one.remainder;
            randoms[i] = one.random;
            meshes[i] = one.mesh;
            patch_lanes[i] = one.mesh >= 0 && one.among.begin == one.among.end;
            begins[i] = one.among.begin;
            ends[i] = one.among.end;
        });
        sample = {load<Int<F>>(lights), load<F>(probabilities), load<F>(remainders)};
        const Int<F> mesh = load<Int<F>>(meshes);
        in_mesh = as_mask(mesh >= 0);
        by_patch = as_mask(load<Int<F>>(patch_lanes) != 0);
        pick = {max(mesh, Int<F>(0)), sample.probability, sample.remainder, load<UInt<F>>(randoms)};
        among = {load<UInt<F>>(begins), load<UInt<F>>(ends)};
    }
    if (!any(in_mesh)) return sample;
    if (const unsigned lanes = bits(by_patch)) {
        MeshPick<F> with_patch = pick;
        const LeafRange<F> leaves = pick_patch<F>(tree.meshes, to.position, lanes, with_patch);
        among = {select(by_patch, leaves.begin, among.begin), select(by_patch, leaves.end, among.end)};
        pick.probability = select(by_patch, with_patch.probability, pick.probability);
        pick.remainder = select(by_patch, with_patch.remainder, pick.remainder);
        pick.random = select(by_patch, with_patch.random, pick.random);
    }
    const Mask<F> found = in_mesh && pick.probability > F(0.f);
    const TrianglePick<F> one = pick_by_power<F>(tree.meshes, sample.light, pick, among, bits(found), fetch);
    sample.light = select(found, one.light, sample.light);
    sample.probability = select(in_mesh, select(found, one.probability, F(0.f)), sample.probability);
    sample.remainder = select(found, one.remainder, sample.remainder);
    return sample;
}

// Traverses by `u` in [0, 1), which has 24 bits, and by more random bits. `fetch(light)`: starts to load what will be read of a light.
template <class F, class Fetch> TreeSample<F> sample_tree(const LightTree& tree, const Receiver<F>& to, const F& u,
                                                          const UInt<F>& random_bits, const Mask<F>& active, const Fetch& fetch) {
    RootImportances<F> root;
    find_root_importances<F>(tree, tree_receiver<F>(to.position, to.normal), root);
    // Selects the last child with non-zero importance whose range begins at or below the random number.
    const F at = u * root.sum;
    Int<F> chosen = 0, light = 0;
    F begin = F(0.f), importance = F(0.f), passed = F(0.f);
    Mask<F> is_like = Mask<F>(false), is_afar = Mask<F>(false), is_below = Mask<F>(false);
    for (int k = 0; k < tree.root_count + tree.distant_count; ++k) {
        const Mask<F> here = root.of[k] > F(0.f) && passed <= at;
        begin = select(here, passed, begin);
        importance = select(here, root.of[k], importance);
        passed = passed + root.of[k];
        if (k < tree.root_count) {
            chosen = select(here, Int<F>(k), chosen);
            is_like = select(here, root.like[k], is_like);
            is_afar = select(here, root.afar[k], is_afar);
        }
        const int32_t its_light = k < tree.root_count ? tree.root_lights[k] : tree.distant[k - tree.root_count].light;
        light = select(here, Int<F>(its_light), light);
        is_below = select(here, Mask<F>(k < tree.root_count && its_light < 0), is_below);
    }
    const Mask<F> lit = active && importance > F(0.f);
    light = select(lit, light, Int<F>(0));
    const UInt<F> random = pcg_hash(random_bits);
    const F within = (at - begin + unit_float<F>(random) * (root.sum * 0x1p-24f)) / max(importance, F(1e-37f));
    const F probability = select(lit, F(importance / max(root.sum, F(1e-37f))), F(0.f));
    const F remainder = min(max(within, F(0.f)), F(one_minus_epsilon));
    const Mask<F> below = lit && is_below;
    if (!any(below)) return {light, probability, remainder};
    return pick_below(tree, to, {chosen, is_like, is_afar, below}, {light, probability, remainder}, random, fetch);
}

// Probability that sample_tree selects `light`: a distant light where `slot` >= 0, else of entry ~slot.
template <class F>
F tree_probability(const LightTree& tree, const Receiver<F>& to, const Int<F>& slot, const Int<F>& light, const Mask<F>& active) {
    const Mask<F> near = active && as_mask(slot < 0);
    Mask<F> there = active;
    Int<F> taken = slot + tree.root_count;
    if (any(near)) {
        const UInt<F> trail = gather_field(tree.entries, &LightTreeEntry::trail, select(near, Int<F>(~slot), Int<F>(0)));
        there = there && !(near && as_mask(trail == UInt<F>(no_trail)));
        taken = select(near, to_signed(UInt<F>(trail & uint32_t(max_tree_children - 1))), taken);
    }
    if (!any(there)) return F(0.f);
    RootImportances<F> root;
    find_root_importances<F>(tree, tree_receiver<F>(to.position, to.normal), root);
    F importance = F(0.f);
    Mask<F> like = Mask<F>(false), afar = Mask<F>(false), is_below = Mask<F>(false);
    for (int k = 0; k < tree.root_count + tree.distant_count; ++k) {
        const Mask<F> here = as_mask(taken == k);
        importance = select(here, root.of[k], importance);
        if (k >= tree.root_count) continue;
        like = select(here, root.like[k], like);
        afar = select(here, root.afar[k], afar);
        is_below = select(here, Mask<F>(tree.root_lights[k] < 0), is_below);
    }
    const Mask<F> lit = there && importance > F(0.f);
    const F of_child = select(lit, F(importance / max(root.sum, F(1e-37f))), F(0.f));
    const unsigned below = bits(Mask<F>(lit && is_below)), like_bits = bits(like), afar_bits = bits(afar);
    if (!below) return of_child;
    const ReceiverLanes<F> receivers(to);
    alignas(64) float probabilities[width<F>];
    store(probabilities, of_child);
    for_each_lane(below, [&](int i) {
        probabilities[i] = probabilities[i] * probability_below_root(tree, receivers[i], tree.entries[~lane(slot, i)], lane(light, i),
                                                                     like_bits >> i & 1, afar_bits >> i & 1);
    });
    return load<F>(probabilities);
}

} // namespace blush::inline BLUSH_ISA
