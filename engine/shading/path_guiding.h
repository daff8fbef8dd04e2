// Path guiding: diffuse surfaces sample more directions from which caustics arrive than cosine sampling does. By cell of a grid over the
// receivers, and by the side that they face, a quadtree over the sphere of directions has been learned from photons (Jensen 1995,
// "Importance Driven Path Tracing Using the Photon Map"; Mueller, Gross and Novak 2017, "Practical Path Guiding for Efficient
// Light-Transport Simulation"). Where nothing has been learned, directions into casters of caustics are sampled more often
// (caustic_guiding.h).
//
// Directions are sampled from the mixture with the cosine (one-sample model, Veach 1997, section 9.2.4): the expectation is the same
// whatever has been learned, and path weights grow at most by 1 / (1 - max_guided_share).
#pragma once

#include "core/math.h"
#include "shading/caustic_guiding.h"
#include "shading/receiver_grid.h"

#include <cstdint>

namespace blush {

// Directions are points of the unit square: azimuth and height, so that equal areas are equal solid angles. Each node of a quadtree
// halves both; its quadrants are numbered 2 * upper + right.
constexpr int guiding_levels = 8;

struct GuidingTables {
    const int32_t* roots = nullptr; // by cell and side: node; -1: nothing has been learned; null: nowhere
    const float* guided = nullptr;  // by node, if it is a root: share of guided samples, at most max_guided_share
    const float* shares = nullptr;  // four a node: probabilities of its quadrants
    const int32_t* nodes = nullptr; // four a node: of its quadrants; -1: directions are uniform there
    ReceiverGrid grid;

    bool operator==(const GuidingTables&) const = default;
};

// How diffuse surfaces sample directions.
struct GuideTables {
    CausticCasterTables casters;
    GuidingTables learned;

    bool empty() const { return casters.count == 0 && !learned.roots; }
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Sides that receivers face: the axis nearest to their normal, and its sign.
constexpr int guiding_sides = 6;
template <class F> Int<F> guiding_cell(const ReceiverGrid& grid, const Vec<F>& position, const Vec<F>& normal) {
    const Vec<F> a = abs(normal);
    const Mask<F> is_x = a.x >= a.y && a.x >= a.z, is_y = a.y >= a.z;
    const Int<F> axis = select(is_x, Int<F>(0), select(is_y, Int<F>(2), Int<F>(4)));
    const F along = select(is_x, normal.x, select(is_y, normal.y, normal.z));
    return receiver_cell<F>(grid, position) * guiding_sides + axis + select(along < F(0.f), Int<F>(1), Int<F>(0));
}

// Position in the unit square of directions.
template <class F> Vec2T<F> guiding_point(const Vec<F>& direction) {
    const auto clamped = [](const F& x) { return min(max(x, F(0.f)), F(one_minus_epsilon)); };
    return {clamped(atan2_turns(direction.x, direction.z) + 0.5f), clamped(0.5f * direction.y + 0.5f)};
}

// Density over the unit square of sample_learned_direction, in the lanes of `active`.
template <class F> F learned_density(const GuidingTables& table, const Int<F>& root, const Vec<F>& direction, const Mask<F>& active) {
    Vec2T<F> at = guiding_point<F>(direction);
    F density = F(1.f);
    Int<F> node = select(active, root, Int<F>(0));
    Mask<F> open = active;
    for (int level = 0; level < guiding_levels && any(open); ++level) {
        at = {at.x * 2.f, at.y * 2.f};
        const Mask<F> right = at.x >= F(1.f), upper = at.y >= F(1.f);
        at = {select(right, at.x - 1.f, at.x), select(upper, at.y - 1.f, at.y)};
        const Int<F> quadrant = node * 4 + select(upper, Int<F>(2), Int<F>(0)) + select(right, Int<F>(1), Int<F>(0));
        density = select(open, density * (4.f * gather(table.shares, quadrant)), density);
        const Int<F> below = gather(table.nodes, quadrant);
        open = open && as_mask(below >= 0);
        node = select(open, below, node);
    }
    return density;
}

// A unit direction; u, v in [0, 1). Each level consumes a part of them (hierarchical sample warping, Clarberg et al. 2005, "Wavelet
// Importance Sampling"), so well-distributed points stay well distributed.
template <class F> Vec<F> sample_learned_direction(const GuidingTables& table, const Int<F>& root, F u, F v, const Mask<F>& active) {
    // Splits [0, 1) at `share`: true above; `x` becomes the position in its part.
    const auto split = [](F& x, const F& share) {
        const Mask<F> above = x >= share;
        const F position = select(above, x - share, x) / max(select(above, 1.f - share, share), F(1e-30f));
        x = min(max(position, F(0.f)), F(one_minus_epsilon));
        return above;
    };
    F x = F(0.f), y = F(0.f), size = F(1.f);
    Int<F> node = select(active, root, Int<F>(0));
    Mask<F> open = active;
    for (int level = 0; level < guiding_levels && any(open); ++level) {
        const Int<F> first = node * 4;
        const F low_left = gather(table.shares, first), low_right = gather(table.shares, Int<F>(first + 1));
        const F high_left = gather(table.shares, Int<F>(first + 2)), high_right = gather(table.shares, Int<F>(first + 3));
        F next_u = u, next_v = v;
        const Mask<F> upper = split(next_v, low_left + low_right);
        const F left = select(upper, high_left, low_left), both = left + select(upper, high_right, low_right);
        const Mask<F> right = split(next_u, left / max(both, F(1e-30f)));
        u = select(open, next_u, u);
        v = select(open, next_v, v);
        size = select(open, 0.5f * size, size);
        x = x + select(open && right, size, F(0.f));
        y = y + select(open && upper, size, F(0.f));
        const Int<F> below = gather(table.nodes, Int<F>(first + select(upper, Int<F>(2), Int<F>(0)) + select(right, Int<F>(1), Int<F>(0))));
        open = open && as_mask(below >= 0);
        node = select(open, below, node);
    }
    const F height = 2.f * min(F(y + size * v), F(one_minus_epsilon)) - 1.f;
    const F radius = sqrt(max(F(0.f), F(1.f - height * height)));
    const SinCos<F> azimuth = sincos_turns(F(x + size * u - 0.5f));
    return {radius * azimuth.sin, height, radius * azimuth.cos};
}

// How one diffuse surface samples directions.
template <class F> struct DirectionGuide {
    CausticGuide<F> casters;
    Mask<F> learned;
    Int<F> root;
    F share; // of guided samples
};

// `lambertian`: lanes whose surface is Lambertian; others are not guided.
template <class F>
DirectionGuide<F> direction_guide_at(const GuideTables& tables, const Vec<F>& from, const Vec<F>& normal, const Mask<F>& lambertian) {
    DirectionGuide<F> guide{{from, normal, F(0.f), F(0.f)}, Mask<F>(false), Int<F>(0), F(0.f)};
    if (tables.learned.roots) {
        const Int<F> cell = guiding_cell<F>(tables.learned.grid, from, normal), root = gather(tables.learned.roots, cell);
        guide.learned = lambertian && as_mask(root >= 0);
        guide.root = select(guide.learned, root, Int<F>(0));
        guide.share = select(guide.learned, gather(tables.learned.guided, guide.root), F(0.f));
    }
    const Mask<F> by_casters = lambertian && !guide.learned;
    if (tables.casters.count > 0 && any(by_casters)) guide.casters = caustic_guide_at<F>(tables.casters, from, normal, by_casters);
    guide.share = select(guide.learned, guide.share, guide.casters.share);
    return guide;
}

// Mixture pdf of a unit direction, where the BSDF alone has `pdf`.
template <class F> F guided_pdf(const GuideTables& tables, const DirectionGuide<F>& guide, const Vec<F>& direction, const F& pdf) {
    F result = pdf;
    if (any(guide.casters.share > F(0.f))) result = caster_pdf<F>(tables.casters, guide.casters, direction, pdf);
    if (!any(guide.learned)) return result;
    const F learned = learned_density<F>(tables.learned, guide.root, direction, guide.learned) * (0.25f * inv_pi);
    return select(guide.learned, (1.f - guide.share) * pdf + guide.share * learned, result);
}

// Samples a direction for lanes with share > 0; u, v and `choice`, which selects a caster, in [0, 1).
template <class F>
Vec<F> sample_guided_direction(const GuideTables& tables, const DirectionGuide<F>& guide, const F& choice, const F& u, const F& v) {
    Vec<F> to{F(0.f), F(0.f), F(1.f)};
    if (any(guide.casters.share > F(0.f))) to = sample_caster_direction<F>(tables.casters, guide.casters, choice, u, v);
    if (!any(guide.learned)) return to;
    return select<F>(guide.learned, sample_learned_direction<F>(tables.learned, guide.root, u, v, guide.learned), to);
}

} // namespace blush::inline BLUSH_ISA
