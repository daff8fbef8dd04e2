// The walks of manifold sampling (manifold_sampling.h): where they begin, and Newton's step at the end of their chain.
#pragma once

#include "render/integrator/manifold/manifold_hits.h"
#include "render/integrator/manifold/specular_chain.h"

namespace blush::inline BLUSH_ISA {

// Explores: draws the events of its chain by chance; solves: Newton's method for a known chain; arrives: has a solution, whose last leg is
// traced; retraces: the chain of a path, for its derivatives.
enum WalkState : int32_t { explores, solves, arrives, retraces };

// Share of walks that begin with a random direction,
constexpr float random_share = 0.05f;
// also where the region has no seed for the light.
constexpr float random_share_without = 0.5f;
constexpr int seed_candidates = 6;
constexpr float longest_step = 0.3f; // radians
// More trials than these are cut off: of images and of pilots.
constexpr int max_manifold_trials = 1 << 14, max_measured_trials = 1 << 10;

template <class F> void put(float* column, const Int<F>& i, const F& value, unsigned lanes) {
    for_each_lane(lanes, [&](int k) { column[lane(i, k)] = lane(value, k); });
}
template <class F> void put_int(int32_t* column, const Int<F>& i, const Int<F>& value, unsigned lanes) {
    for_each_lane(lanes, [&](int k) { column[lane(i, k)] = lane(value, k); });
}
template <class F> void put3(Columns3& c, const Int<F>& i, const Vec<F>& value, unsigned lanes) {
    put<F>(c.x, i, value.x, lanes);
    put<F>(c.y, i, value.y, lanes);
    put<F>(c.z, i, value.z, lanes);
}

// A walk while it is in registers.
template <class F> struct Walk {
    Int<F> index; // of its receiver
    Vec<F> direction;
    Int<F> chain, events, state, trials;
    DifferentialRay<F> ray;
    Vec<F> transmittance;
};
template <class F> Walk<F> load_walk(const ManifoldColumns& c, const Int<F>& index) {
    return {index,
            load3<F>(c.direction, index),
            gather(c.chain, index),
            gather(c.events, index),
            gather(c.state, index),
            gather(c.trials, index),
            {load3<F>(c.position, index), load3<F>(c.ray, index), load3<F>(c.position_u, index), load3<F>(c.position_v, index),
             load3<F>(c.ray_u, index), load3<F>(c.ray_v, index)},
            load3<F>(c.transmittance, index)};
}
template <class F> void store_walk(ManifoldColumns& c, const Walk<F>& w, unsigned lanes) {
    put3<F>(c.direction, w.index, w.direction, lanes);
    put_int<F>(c.chain, w.index, w.chain, lanes);
    put_int<F>(c.events, w.index, w.events, lanes);
    put_int<F>(c.state, w.index, w.state, lanes);
    put_int<F>(c.trials, w.index, w.trials, lanes);
    put3<F>(c.position, w.index, w.ray.position, lanes);
    put3<F>(c.ray, w.index, w.ray.direction, lanes);
    put3<F>(c.position_u, w.index, w.ray.position_u, lanes);
    put3<F>(c.position_v, w.index, w.ray.position_v, lanes);
    put3<F>(c.ray_u, w.index, w.ray.direction_u, lanes);
    put3<F>(c.ray_v, w.index, w.ray.direction_v, lanes);
    put3<F>(c.transmittance, w.index, w.transmittance, lanes);
}

// Begins the chain for a new direction.
template <class F> void begin_chain(ManifoldColumns& c, Walk<F>& w, const Mask<F>& lanes) {
    const Basis<F> turns = basis_around(w.direction);
    const auto set = [&](Vec<F>& a, const Vec<F>& b) { a = select<F>(lanes, b, a); };
    set(w.ray.position, load3<F>(c.origin, w.index));
    set(w.ray.direction, w.direction);
    set(w.ray.position_u, splat<F>(0.f));
    set(w.ray.position_v, splat<F>(0.f));
    set(w.ray.direction_u, turns.s);
    set(w.ray.direction_v, turns.t);
    set(w.transmittance, splat<F>(1.f));
    w.events = select(lanes, Int<F>(0), w.events);
    if (c.blended) put<F>(c.blended->passed, w.index, F(1.f), bits(lanes));
}

// A vector in a random direction: half of them into the hemisphere, half towards the casters.
template <class F> Vec<F> random_start(const ManifoldTables& t, const Vec<F>& origin, const Vec<F>& ns, UInt<F>& random) {
    const F u = next_random<F>(random), v = next_random<F>(random), choice = next_random<F>(random), depth = next_random<F>(random);
    const Vec<F> around = basis_around(ns).to_world(sample_cosine_hemisphere(u, v));
    if (t.casters.count == 0) return around;
    const Int<F> caster = min(to_int(F(choice * (2.f * float(t.casters.count)))), Int<F>(2 * t.casters.count - 1));
    const Mask<F> aims = as_mask(caster >= t.casters.count);
    const Int<F> k = select(aims, Int<F>(caster - t.casters.count), Int<F>(0));
    const Vec<F> center = gather_field3<F>(t.casters.spheres, &CasterSphere::center, k);
    const F radius = gather_field(t.casters.spheres, &CasterSphere::radius, k);
    return select<F>(aims, center + sample_cone(F(2.f), u, v) * (radius * sqrt(depth)) - origin, around);
}

// A pilot gives up soon.
inline int max_trials(const ManifoldColumns& c) { return c.measures ? max_measured_trials : max_manifold_trials; }

// Begins walks at new seeds, where `missed` after a failed trial. Trials that begin with the seed of another chain than the solution's fail
// at once. Returns the lanes that end instead (manifold_hits.h).
template <class F> Mask<F> begin_walks(const SceneTables& scene, ManifoldColumns& c, Walk<F>& w, const Mask<F>& lanes, Mask<F> missed) {
    const ManifoldTables& t = scene.manifolds;
    UInt<F> random = gather(c.random, w.index);
    const Int<F> own_first = gather(c.first_seed, w.index), own = gather(c.seeds, w.index), root_chain = gather(c.root_chain, w.index);
    const Vec<F> origin = load3<F>(c.origin, w.index), ns = load3<F>(c.ns, w.index);
    const Int<F> all_first = gather_field(t.regions, &ManifoldRegion::first, Int<F>(0)),
                 all = gather_field(t.regions, &ManifoldRegion::count, Int<F>(0));
    const F coin = gather(c.coin, w.index);
    Mask<F> open = lanes, ended = Mask<F>(false);
    // Each lane has its own numbers, however long others take.
    UInt<F> drawn = random;
    while (any(open)) {
        const Mask<F> ends = next_random<F>(drawn) < coin; // drawn in every lane: && of scalar masks skips its right side
        ended = ended || (open && missed && ends);
        open = open && !ended;
        w.trials = select(open && missed, Int<F>(w.trials + 1), w.trials);
        const Mask<F> has_own = as_mask(own > 0);
        const Mask<F> at_random = next_random<F>(drawn) < select(has_own, F(random_share), F(random_share_without));
        const Int<F> count = select(has_own, own, all);
        // The nearest of several: caustics have sharp edges, where few seeds of the region have the right chain.
        Int<F> seed = Int<F>(0);
        F nearest = F(infinity);
        for (int i = 0; i < seed_candidates; ++i) {
            const Int<F> candidate =
                select(has_own, own_first, all_first) + min(to_int(F(next_random<F>(drawn) * to_float(count))), Int<F>(count - 1));
            const Vec<F> off = gather_field3<F>(t.seeds, &ManifoldSeed::position, candidate) - origin;
            const F d2 = dot(off, off);
            seed = select(d2 < nearest, candidate, seed);
            nearest = min(d2, nearest);
        }
        // Near a caster the seed's direction is nearer to the solution's than its point.
        const Vec<F> target = gather_field3<F>(t.seeds, &ManifoldSeed::target, seed);
        const Mask<F> parallel = next_random<F>(drawn) < F(0.5f);
        Vec<F> to = target - select<F>(parallel, gather_field3<F>(t.seeds, &ManifoldSeed::position, seed), origin);
        to = select<F>(at_random, random_start<F>(t, origin, ns, drawn), to);
        w.direction = select<F>(open, to / sqrt(max(dot(to, to), F(1e-30f))), w.direction);
        w.state = select(open, select(at_random, Int<F>(explores), Int<F>(solves)), w.state);
        w.chain = select(open, select(at_random, Int<F>(0), gather_field(t.seeds, &ManifoldSeed::chain, seed)), w.chain);
        missed = as_mask(w.trials > 0) && !at_random && as_mask(w.chain != root_chain);
        random = select(open, drawn, random);
        open = open && missed && as_mask(w.trials < max_trials(c));
    }
    for_each_lane(bits(lanes), [&](int k) { c.random[lane(w.index, k)] = lane(random, k); });
    put_int<F>(c.iterations, w.index, Int<F>(0), bits(lanes));
    begin_chain<F>(c, w, lanes);
    return ended;
}

// Where the ray behind the chain passes its target, and the derivatives.
template <class F> struct ChainEnd {
    F error;             // distance, metres; at infinity radians
    F step_u, step_v;    // Newton's step of the direction
    F determinant, same; // |d target / d direction|; squared length of a turn that moves the end by the tolerance
    Mask<F> valid;       // the target is ahead
};
template <class F> ChainEnd<F> end_of_chain(const ManifoldColumns& c, const Walk<F>& w) {
    const Mask<F> infinite = as_mask((gather(c.kind, w.index) & int32_t(receiver_infinite)) != 0);
    const Vec<F> target = load3<F>(c.target, w.index);
    const Vec<F> to = select<F>(infinite, target, target - w.ray.position);
    const F distance = dot(to, w.ray.direction);
    const Basis<F> across = basis_around(w.ray.direction);
    const auto moved = [&](const Vec<F>& position, const Vec<F>& direction) {
        return select<F>(infinite, direction, position + direction * distance);
    };
    const Vec<F> u = moved(w.ray.position_u, w.ray.direction_u), v = moved(w.ray.position_v, w.ray.direction_v);
    const F r1 = dot(to, across.s), r2 = dot(to, across.t);
    const F m11 = dot(u, across.s), m12 = dot(v, across.s), m21 = dot(u, across.t), m22 = dot(v, across.t);
    const F det = m11 * m22 - m12 * m21, inverse = 1.f / det;
    ChainEnd<F> end;
    end.error = sqrt(r1 * r1 + r2 * r2);
    end.step_u = (m22 * r1 - m12 * r2) * inverse;
    end.step_v = (m11 * r2 - m21 * r1) * inverse;
    end.determinant = abs(det);
    const F tolerance = 4.f * gather(c.tolerance, w.index);
    end.same = tolerance * tolerance * ((m11 * m11 + m12 * m12 + m21 * m21 + m22 * m22) * (inverse * inverse));
    end.valid = distance > F(0.f) && is_finite(F(end.step_u + end.step_v)) && is_finite(end.error) && end.determinant > F(0.f);
    return end;
}

// The direction of a step from the best one.
template <class F> Vec<F> stepped(const Vec<F>& best, const F& u, const F& v, const F& scale) {
    const Basis<F> turns = basis_around(best);
    const F limited = scale * min(F(1.f), F(longest_step) / max(sqrt(u * u + v * v), F(1e-20f)));
    return normalize(best + turns.s * (u * limited) + turns.t * (v * limited));
}

} // namespace blush::inline BLUSH_ISA
