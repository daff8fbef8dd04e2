// Triangles of a mesh with many emissive triangles, selected without a traversal of its tree (light_tree.h): by power among some of its
// leaves, or, seen from afar, by a table of what its patches give towards the receiver. With a path in each lane, whatever their meshes.
#pragma once

#include "core/distribution.h"
#include "core/math.h"

#include <cstdint>

namespace blush {

struct LightTreeNode;

// A mesh of at least min_triangles_for_patches triangles that emit to all sides, seen from afar.
constexpr int direction_cells = 16, patch_bits = 6, mesh_patches = 1 << patch_bits; // cells along each side of the octahedral map
struct alignas(64) MeshPatches {
    uint32_t thresholds[direction_cells * direction_cells][mesh_patches]; // by direction from the centre: what the patches give
    // First leaf by patch, and the number of leaves: a patch has the leaves whose thresholds are in [i, i + 1) / mesh_patches.
    uint32_t begins[mesh_patches + 1];
};

// Numbers behind the thresholds, so that a register may be loaded from the last.
constexpr int threshold_padding = 16;

// The tree of a mesh.
struct MeshLightTree {
    const uint32_t* thresholds = nullptr; // by leaf: make_thresholds of the powers; padded
    const int32_t* triangles = nullptr;   // by leaf
    const int32_t* guide = nullptr;       // make_guide of the thresholds
    const MeshPatches* patches = nullptr; // null: none
    const LightTreeNode* nodes = nullptr;
    const uint32_t* trails = nullptr; // by triangle: the path from the root, tree_branch_bits for each level, the root's lowest; no_trail
    const int32_t* leaves = nullptr;  // by triangle
    uint32_t leaf_count = 0;
    int32_t guide_shift = 0; // 32 - its bits
    int32_t has_patches = 0;
    Vec3 center{0, 0, 0};
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

static_assert(width<Wide> <= threshold_padding);

// Where the share of a leaf begins, of 2^32, which wraps to 0.
inline uint32_t threshold_of(const MeshLightTree& mesh, uint32_t leaf) { return leaf < mesh.leaf_count ? mesh.thresholds[leaf] : 0u; }

// Leaves [begin, end).
template <class F> struct LeafRange { UInt<F> begin, end; };

// A number of 32 bits as a share of 2^32.
template <class F> F share_of(const UInt<F>& x) {
    return to_float(to_signed(UInt<F>(x >> 8))) * 0x1p-24f + to_float(to_signed(UInt<F>(x & 255u))) * 0x1p-32f;
}
// The same for what is between two thresholds: 0 is 2^32.
template <class F> F threshold_share(const UInt<F>& difference) {
    return select(as_mask(difference == UInt<F>(0u)), F(1.f), share_of<F>(difference));
}

// A mesh, and what has been selected so far.
template <class F> struct MeshPick {
    Int<F> mesh;
    F probability, remainder;
    UInt<F> random;
    // The remainder as 32 random bits.
    UInt<F> number() const { return (to_unsigned(to_int(F(remainder * 0x1p24f))) << 8) | (random >> 24); }
};
template <class F> struct TrianglePick {
    Int<F> light;
    F probability, remainder;
};

// Selects one of the leaves `among` in proportion to power. Memory is read lane by lane: that is faster than gathers. `first_light`: of
// the meshes; `fetch(light)`: starts to load what will be read of a light.
template <class F, class Fetch> TrianglePick<F> pick_by_power(const MeshLightTree* meshes, const Int<F>& first_light, MeshPick<F> pick,
                                                              const LeafRange<F>& among, unsigned lanes, const Fetch& fetch) {
    alignas(64) int32_t mesh[width<F>], light[width<F>];
    alignas(64) uint32_t number[width<F>], more[width<F>], first[width<F>], end[width<F>];
    alignas(64) uint32_t total[width<F>]{}, offset[width<F>]{}, fraction[width<F>]{}, share[width<F>]{};
    pick.random = pcg_hash(pick.random);
    store(mesh, pick.mesh);
    store(light, first_light);
    store(number, pick.number());
    store(more, UInt<F>(pick.random << 8));
    store(first, among.begin);
    store(end, among.end);
    for_each_lane(lanes, [&](int i) {
        const MeshLightTree& m = meshes[mesh[i]];
        const uint32_t low = threshold_of(m, first[i]);
        total[i] = threshold_of(m, end[i]) - low;
        // 64 random bits times the total, 0: 2^32, and the fraction below it.
        const auto product = (unsigned __int128)(uint64_t(number[i]) << 32 | more[i]) * (uint64_t(total[i] - 1) + 1);
        const uint32_t at = low + uint32_t(product >> 64);
        fraction[i] = uint32_t(uint64_t(product) >> 40);
        // The last leaf that begins at or below the number.
        uint32_t leaf = uint32_t(m.guide[at >> m.guide_shift]), passed = 0;
        do {
            passed = uint32_t(count(as_mask(load<WideUInt>(m.thresholds + leaf) <= WideUInt(at))));
            leaf += passed;
        } while (passed == uint32_t(width<Wide>) && leaf < m.leaf_count);
        leaf = min(leaf, m.leaf_count) - 1;
        light[i] += m.triangles[leaf];
        fetch(light[i]);
        offset[i] = at - m.thresholds[leaf];
        share[i] = threshold_of(m, leaf + 1) - m.thresholds[leaf];
    });
    const F of_leaf = threshold_share<F>(load<UInt<F>>(share));
    const F within = share_of<F>(load<UInt<F>>(offset)) + to_float(to_signed(load<UInt<F>>(fraction))) * 0x1p-56f;
    return {load<Int<F>>(light), pick.probability * (of_leaf / threshold_share<F>(load<UInt<F>>(total))),
            min(within / of_leaf, F(one_minus_epsilon))};
}
// Probability that pick_by_power selects `leaf`.
inline float power_probability(const MeshLightTree& mesh, uint32_t leaf, const LeafRange<float>& among) {
    const auto share = [&](uint32_t begin, uint32_t end) {
        return threshold_share<float>(threshold_of(mesh, end) - threshold_of(mesh, begin));
    };
    return share(leaf, leaf + 1) / share(among.begin, among.end);
}

// The cell of the octahedral map (Meyer et al. 2010) that contains the direction of `v`.
template <class F> Int<F> direction_cell(const Vec<F>& v) {
    const F scale = 1.f / (abs(v.x) + abs(v.y) + abs(v.z)), x = v.x * scale, y = v.y * scale;
    const F fold_x = select(x < F(0.f), abs(y) - 1.f, 1.f - abs(y)), fold_y = select(y < F(0.f), abs(x) - 1.f, 1.f - abs(x));
    const auto cell = [](const F& c) {
        return min(max(to_int(F((0.5f * c + 0.5f) * float(direction_cells))), Int<F>(0)), Int<F>(direction_cells - 1));
    };
    const Mask<F> lower = v.z < F(0.f);
    return cell(select(lower, fold_x, x)) + cell(select(lower, fold_y, y)) * direction_cells;
}

// The end of patch i wraps to 0 if it is the last.
inline uint32_t patch_share(const uint32_t* row, uint32_t i) { return (i + 1 < uint32_t(mesh_patches) ? row[i + 1] : 0u) - row[i]; }

// Selects a patch of a mesh that is seen from afar; the probability is 0 if it is empty.
template <class F> LeafRange<F> pick_patch(const MeshLightTree* meshes, const Vec<F>& position, unsigned lanes, MeshPick<F>& pick) {
    alignas(64) int32_t mesh[width<F>], cell[width<F>];
    alignas(64) uint32_t number[width<F>], offset[width<F>]{}, share[width<F>]{}, begin[width<F>]{}, end[width<F>]{};
    pick.random = pcg_hash(pick.random);
    store(mesh, pick.mesh);
    store(cell, direction_cell<F>(position - gather_field3<F>(meshes, &MeshLightTree::center, pick.mesh)));
    store(number, pick.number());
    for_each_lane(lanes, [&](int i) {
        const MeshPatches& patches = *meshes[mesh[i]].patches;
        const uint32_t* const row = patches.thresholds[cell[i]];
        // The last patch whose threshold is at or below the number; the first is 0.
        int reached = 0;
        for (int k = 0; k < mesh_patches; k += width<Wide>) reached += count(as_mask(load<WideUInt>(row + k) <= WideUInt(number[i])));
        const int patch = reached - 1;
        share[i] = patch_share(row, uint32_t(patch));
        offset[i] = number[i] - row[patch];
        begin[i] = patches.begins[patch];
        end[i] = patches.begins[patch + 1];
    });
    const UInt<F> first = load<UInt<F>>(begin), last = load<UInt<F>>(end), given = load<UInt<F>>(share);
    const Mask<F> empty = as_mask(first == last) || as_mask(given == UInt<F>(0u));
    const F of_patch = threshold_share<F>(given);
    const F within = share_of<F>(load<UInt<F>>(offset)) + to_float(to_signed(UInt<F>(pick.random & 0xffffffu))) * 0x1p-56f;
    pick.probability = select(empty, F(0.f), F(pick.probability * of_patch));
    pick.remainder = min(within / of_patch, F(one_minus_epsilon));
    return {first, last};
}
// Probability that pick_patch and pick_by_power select `leaf`.
inline float patch_probability(const MeshLightTree& mesh, const Vec3& position, uint32_t leaf) {
    const uint32_t patch = mesh.thresholds[leaf] >> (32 - patch_bits);
    const uint32_t share = patch_share(mesh.patches->thresholds[direction_cell<float>(position - mesh.center)], patch);
    const uint32_t* const leaves = mesh.patches->begins + patch;
    return share == 0 ? 0 : threshold_share<float>(share) * power_probability(mesh, leaf, {leaves[0], leaves[1]});
}

} // namespace blush::inline BLUSH_ISA
