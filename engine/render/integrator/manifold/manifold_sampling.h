// Manifold sampling: connects rough surfaces to points of lights through chains of mirrors and smooth glass (Zeltner, Georgiev and
// Jakob 2020, "Specular Manifold Sampling for Rendering High-Frequency Caustics and Glints", there the unbiased variant). So caustics are
// found that neither NEE nor light paths can connect: those on the bottom of a pool that is seen through its water.
//
// For a point of a surface and a point of a light, Newton's method looks for a direction whose chain of specular events leads to the light
// (Hanika, Droske and Fascione 2015, "Manifold Next Event Estimation"). Here the unknown is the direction, two numbers however long the
// chain is: the chain is traced together with its derivatives by them (specular_chain.h). A solution of determinant |d target / d
// direction| J carries f cos T L / (p J). The probability to find it from a random seed is unknown, but the number of further seeds until
// it is found again is an unbiased estimate of its inverse (Booth 2007, "Unbiased Monte Carlo Estimation of the Reciprocal of an
// Integral").
//
// Paths that meet such a light by chance share it (manifold_hits.h). What light paths sample, too, is left to them: paths whose first
// vertex they can connect to the camera.
//
// Blended surfaces are no events: chains pass them, and their transmittance dims the light. They stop paths by chance, so what these find
// is dimmed as well, in the mean. All densities leave it out.
#pragma once

#include "render/integrator/manifold/walk_rays.h"

namespace blush::inline BLUSH_ISA {

constexpr int max_walk_iterations = 20;
constexpr float least_scale = 1.f / 16; // of a Newton step
// For the pilot, over that of solutions: light of zero-size lights that nothing else finds has no variance, but is missing, and this error
// squared is the variance of so many samples.
constexpr float unfound_density = 1.f / 64;

// Density of emission of a solution (emission_density).
template <Features S, class F> F solution_emission(const SceneTables& scene, const EmissionTables& emission, const ManifoldColumns& c,
                                                   const Walk<F>& w, const Mask<F>& active) {
    const Mask<F> infinite = as_mask((gather(c.kind, w.index) & int32_t(receiver_infinite)) != 0);
    const Vec<F> position = select<F>(infinite, w.ray.position, load3<F>(c.target, w.index));
    const auto point =
        emission_point<S, F>(scene, gather(c.light, w.index), position, load3<F>(c.target_normal, w.index), w.ray.direction, active);
    return emission_density<F>(emission, point, active);
}

// Density of a solution over that of light paths to its light vertex (light_vertices.h): m^2. `pdf`: of the direction, with the cosine at
// the vertex.
template <Features S, class F> [[gnu::noinline]] F over_light_vertices(const SceneTables& scene, const ManifoldColumns& c, const Walk<F>& w,
                                                                       const F& pdf, const F& cosine, const Mask<F>& active) {
    const F by_light = solution_emission<S, F>(scene, scene.light_vertices.emission, c, w, active) * cosine;
    return min(F(pdf / max(by_light, F(1e-30f))), F(1e30f));
}
// MIS weight of manifold sampling beside light vertices, and of the hits that share its light.
template <Features S, class F> F beside_light_vertices(const SceneTables& scene, const ManifoldColumns& c, const Walk<F>& w, const F& pdf,
                                                       const F& cosine, const Mask<F>& active) {
    if (scene.light_vertices.empty()) return F(1.f);
    const F arrival = gather(c.arrival, w.index);
    const Mask<F> shared = active && arrival > F(0.f);
    if (!any(shared)) return F(1.f);
    const F ratio = over_light_vertices<S, F>(scene, c, w, pdf, cosine, shared);
    return select(shared, 1.f - light_vertex_weight<F>(scene, arrival, ratio), F(1.f));
}

// Density of light paths with the same vertices over that of the camera path to the receiver (path_chain.h): 1/sr.
template <Features S, class F> F density_of_light_paths(const SceneTables& scene, const ManifoldColumns& c, const Walk<F>& w,
                                                        const ReceiverBsdf<F>& at, const Mask<F>& active) {
    const F emitted = solution_emission<S, F>(scene, scene.emission, c, w, active) * at.reverse;
    return min(F(gather(c.light_ratio, w.index) * emitted * clamped_cosine<F>(load3<F>(c.ng, w.index), w.direction)), F(1e30f));
}
// MIS weight of manifold sampling beside light paths, and of the hits that share its light. `pdf`: of the direction.
template <Features S, class F> [[gnu::noinline]] F beside_shared_light_paths(const SceneTables& scene, const ManifoldColumns& c,
                                                                             const Walk<F>& w, const ReceiverBsdf<F>& at, const F& pdf,
                                                                             const Mask<F>& active) {
    const Mask<F> shared = active && as_mask((gather(c.kind, w.index) & int32_t(receiver_shares)) != 0);
    if (!any(shared)) return F(1.f);
    const F by_walks = max(F(pdf * walk_weight), F(1e-30f));
    return select(shared, by_walks / (by_walks + density_of_light_paths<S, F>(scene, c, w, at, shared)), F(1.f));
}

// For the pilot: density with which paths of the camera and light paths together sample the direction of a solution; the probabilities of
// the chain's events are left out, which are near 1 or weight little light. 0 for lights of zero size that light paths do not find.
template <Features S, class F> [[gnu::noinline]] F density_without(const SceneTables& scene, const ManifoldColumns& c, const Walk<F>& w,
                                                                   const ReceiverBsdf<F>& at, const Mask<F>& active) {
    const GuideTables& guides = scene.manifolds.guides_without;
    const auto guide = direction_guide_at<F>(guides, load3<F>(c.origin, w.index), load3<F>(c.ns, w.index), active && at.lambertian);
    const F by_hits = guided_pdf<F>(guides, guide, w.direction, at.pdf);
    const F density = select(of_zero_size<F>(c, w), F(0.f), by_hits);
    if (scene.emission.empty()) return density;
    return density + density_of_light_paths<S, F>(scene, c, w, at, active);
}

// Light that has come to the path of a slot through a chain.
struct ChainLight {
    int slot;
    int32_t light; // record
    double r, g, b;
};
// Adds it, but for its strategy. `scatterings`: those from the camera to the light.
inline void add_chained(const KernelContext& context, TileScratch& scratch, const ChainLight& l, int scatterings) {
    if (scratch.groups) scratch.groups->add(context.scene->groups.of_light[l.light], l.slot, l.r, l.g, l.b);
    if (scratch.bounces) return add_chained_light(*scratch.bounces, scatterings, l.slot, l.r, l.g, l.b);
    scratch.r[l.slot] += l.r;
    scratch.g[l.slot] += l.g;
    scratch.b[l.slot] += l.b;
}

// Adds the light of a solution to its path, whose vertex is that of `bounce`: the receiver, or the light that was hit.
inline void add_chain_light(const KernelContext& context, TileScratch& scratch, int k, int trials, int bounce) {
    ManifoldColumns& c = *scratch.manifolds;
    const int slot = c.slot[k];
    if (c.measures) {
        const float light = luminance(Vec3{c.found.x[k], c.found.y[k], c.found.z[k]}) * float(trials);
        c.base_moment[slot] += light * c.base[k];
        c.own_moment[slot] += light * light;
        if (c.kind[k] & receiver_shares) c.shared_saving += double(light * c.base[k]) - double(light * light);
        ++c.solutions;
    }
    const double r = double(c.found.x[k]) * trials, g = double(c.found.y[k]) * trials, b = double(c.found.z[k]) * trials;
    const bool hit = c.kind[k] & receiver_hit;
    if (scratch.strategies && hit) add_hit_by_strategy(*scratch.strategies, slot, r, g, b);
    if (scratch.strategies && !hit) add_by_strategy(*scratch.strategies, FoundBy::manifold, slot, r, g, b);
    const int scatterings = hit ? bounce : bounce + 1 + (c.root_chain[k] >> chain_count_shift);
    add_chained(context, scratch, {slot, c.light[k], r, g, b}, scatterings);
}

// The same where trials have ended without finding the solution again.
template <class F>
void add_ended_light(const KernelContext& context, TileScratch& scratch, const Walk<F>& w, int bounce, const Mask<F>& ended) {
    const ManifoldColumns& c = *scratch.manifolds;
    const Mask<F> hit = as_mask((gather(c.kind, w.index) & int32_t(receiver_hit)) != 0);
    const Int<F> times = select(hit, Int<F>(1), w.trials);
    for_each_lane(bits(ended), [&](int k) { add_chain_light(context, scratch, lane(w.index, k), lane(times, k), bounce); });
}

// What becomes of walks in one round.
template <class F> struct WalkRound {
    Mask<F> active;
    Mask<F> alive;            // goes on
    Mask<F> begins;           // with a new seed
    Mask<F> missed;           // of these: a trial has failed
    Mask<F> ends, failed;     // the chain is complete; it cannot be continued
    Mask<F> explored;         // of those that end: the surface behind their chain was met, too
    Int<F> part = Int<F>(-1); // of the event
};

// Solutions carry light if nothing is between the last surface and the light, times `share` behind blended surfaces.
template <class F> void take_arrivals(ManifoldColumns& c, const Hit<F>& hit, const F& share, Walk<F>& w, WalkRound<F>& round) {
    const Mask<F> arriving = round.active && as_mask(w.state == int32_t(arrives));
    if (!any(arriving)) return;
    const Mask<F> infinite = as_mask((gather(c.kind, w.index) & int32_t(receiver_infinite)) != 0);
    const F distance = dot(load3<F>(c.target, w.index) - w.ray.position, w.ray.direction);
    const Mask<F> beyond = !infinite && hit.t >= before_target<F>(c, w.index, distance);
    const Mask<F> lit = arriving && share > F(0.f) && (beyond || as_mask(hit.geometry < 0));
    if (c.blended) put3<F>(c.found, w.index, load3<F>(c.found, w.index) * share, bits(lit));
    w.trials = select(lit, Int<F>(1), w.trials);
    round.alive = round.alive && (!arriving || lit);
    round.begins = round.begins || lit;
}

// The lanes of `taken` pass the event; the chain of exploring ones grows by it.
template <class F>
void pass_event(const DifferentialRay<F>& behind, const SpecularEvent<F>& event, const Mask<F>& taken, const Mask<F>& explore, Walk<F>& w) {
    const auto set = [&](Vec<F>& a, const Vec<F>& b) { a = select<F>(taken, b, a); };
    set(w.ray.position, behind.position);
    set(w.ray.direction, behind.direction);
    set(w.ray.position_u, behind.position_u);
    set(w.ray.position_v, behind.position_v);
    set(w.ray.direction_u, behind.direction_u);
    set(w.ray.direction_v, behind.direction_v);
    set(w.transmittance, w.transmittance * event.transmittance);
    Int<F> place = Int<F>(1);
    for (int i = 0; i < max_chain_events; ++i) place = select(as_mask(w.events > i), Int<F>(place << 1), place);
    w.chain = select(taken && explore && event.refracts, Int<F>(w.chain | place), w.chain);
    w.events = select(taken, Int<F>(w.events + 1), w.events);
}

// The first event of a path at a dispersive solid gives it the colour of its wavelength (dispersion.h).
template <class F>
void disperse_event(ManifoldColumns& c, const Walk<F>& w, const Int<F>& wavelength, const Mask<F>& taken, SpecularEvent<F>& event) {
    const Mask<F> before = as_mask((gather(c.kind, w.index) & int32_t(receiver_dispersed)) != 0) ||
                           (as_mask(w.events > 0) && as_mask(gather(c.dispersed, w.index) != 0));
    const Vec<F> color = wavelength_at<F>(wavelength).rgb;
    event.transmittance = select<F>(event.disperses && !before, event.transmittance * color, event.transmittance);
    put_int<F>(c.dispersed, w.index, select(before || event.disperses, Int<F>(1), Int<F>(0)), bits(taken));
}

// The events at the hits of walks that trace their chain.
template <Features S, class F>
void take_events(const KernelContext& context, ManifoldColumns& c, const Hit<F>& hit, const F& share, Walk<F>& w, WalkRound<F>& round) {
    const Mask<F> chained = round.active && !as_mask(w.state == int32_t(arrives));
    const Mask<F> explore = chained && as_mask(w.state == int32_t(explores));
    const Mask<F> met = chained && as_mask(hit.geometry >= 0) && !as_mask(hit.instance == sphere_instance);
    if (!any(chained)) return;
    const Int<F> events_in_chain = w.chain >> chain_count_shift;
    Mask<F> passed = Mask<F>(false);
    if (any(met)) {
        Int<F> bit = w.chain; // shifted by the events so far
        for (int i = 0; i < max_chain_events; ++i) bit = select(as_mask(w.events > i), Int<F>(bit >> 1), bit);
        UInt<F> random = gather(c.random, w.index);
        const F u = next_random<F>(random);
        for_each_lane(bits(explore && met), [&](int k) { c.random[lane(w.index, k)] = lane(random, k); });
        DifferentialRay<F> behind = w.ray;
        Int<F> wavelength = Int<F>(0);
        if constexpr (S.has(Feature::dispersion)) wavelength = gather(c.wavelength, w.index);
        auto event =
            specular_event<S, F>(*context.scene, context.settings, hit, as_mask((bit & 1) != 0), explore, u, wavelength, met, behind);
        passed = met && event.valid;
        if constexpr (S.has(Feature::dispersion)) disperse_event<F>(c, w, wavelength, passed, event);
        round.part = event.part;
        pass_event<F>(behind, event, passed, explore, w);
        if (c.blended) put<F>(c.blended->passed, w.index, gather(c.blended->passed.data, w.index) * share, bits(passed));
    }
    // The chain of an exploring walk ends before the first surface without an event.
    const Mask<F> explored = explore && !passed, empty = as_mask(w.events == 0);
    round.failed = (chained && !explore && !passed) || (explored && empty) || (explore && as_mask(w.events > max_chain_events));
    round.explored = explored && !round.failed;
    round.ends = round.explored || (passed && !explore && as_mask(w.events == events_in_chain));
    w.chain = select(explored, Int<F>(w.chain | (w.events << chain_count_shift)), w.chain);
    w.state = select(round.explored, Int<F>(solves), w.state);
}

template <class F> F cos_at_light(const ManifoldColumns& c, const Walk<F>& w) {
    const Int<F> kind = gather(c.kind, w.index);
    const Mask<F> faces_all = as_mask((kind & int32_t(receiver_infinite | receiver_zero_size)) != 0),
                  two_sided = as_mask((kind & int32_t(receiver_two_sided)) != 0);
    const F cosine = -dot(load3<F>(c.target_normal, w.index), w.ray.direction);
    return select(faces_all, F(1.f), select(two_sided, abs(cosine), max(cosine, F(0.f))));
}
template <class F> Mask<F> of_zero_size(const ManifoldColumns& c, const Walk<F>& w) {
    return as_mask((gather(c.kind, w.index) & int32_t(receiver_zero_size)) != 0);
}

template <class F> F cosine_at_receiver(const ManifoldColumns& c, const Walk<F>& w) {
    return max(dot(w.direction, load3<F>(c.ns, w.index)), F(0.f));
}

// Hits of paths whose chain has been traced: they get all their light, none, or trials decide.
template <Features S, class F>
void weigh_hits(const KernelContext& context, TileScratch& scratch, int bounce, const Mask<F>& retraced, Walk<F>& w, WalkRound<F>& round) {
    ManifoldColumns& c = *scratch.manifolds;
    const ChainEnd<F> end = end_of_chain<F>(c, w);
    const F density = gather(c.density, w.index) * end.determinant / max(cos_at_light<F>(c, w), F(1e-20f));
    const unsigned lanes = bits(retraced);
    const Mask<F> solved = retraced && round.ends && end.valid;
    if (c.traced != ManifoldColumns::Traced::hits) {
        LightVertexColumns& v = *scratch.light_vertices;
        const Int<F> slot = gather(c.slot, w.index);
        const F ratio = c.traced == ManifoldColumns::Traced::light_vertices
                            ? over_light_vertices<S, F>(*context.scene, c, w, density, cosine_at_receiver<F>(c, w), solved)
                            : F(density / max(gather(v.pdf, slot), F(1e-20f)));
        put<F>(v.ratio, slot, ratio, bits(solved));
        // Paths that meet the light keep all of it there.
        put_int<F>(v.chain, slot, Int<F>(0), lanes & ~bits(solved));
        round.alive = round.alive && !retraced;
        return;
    }
    const ReceiverBsdf<F> at = receiver_bsdf<S, F>(context, c.at, w.index, load3<F>(c.ns, w.index), w.direction, retraced);
    const HitShare<F> share = share_of_hits<F>(at.pdf, density);
    const F beside = beside_light_vertices<S, F>(*context.scene, c, w, density, at.cosine, solved) *
                     beside_shared_light_paths<S, F>(*context.scene, c, w, at, density, solved);
    put3<F>(c.found, w.index, load3<F>(c.found, w.index) * beside, lanes);
    if (c.measures) {
        const F without = density_without<S, F>(*context.scene, c, w, at, retraced);
        put<F>(c.base, w.index, luminance(load3<F>(c.found, w.index)) * at.pdf / max(without, F(1e-20f)), lanes);
    }
    put<F>(c.same, w.index, end.same, lanes);
    put<F>(c.coin, w.index, share.coin, lanes);
    UInt<F> random = gather(c.random, w.index);
    const F u = next_random<F>(random);
    for_each_lane(lanes, [&](int k) { c.random[lane(w.index, k)] = lane(random, k); });
    // Chains of paths that cannot be traced again have no solution.
    const Mask<F> all = retraced && (!round.ends || !end.valid || u >= share.kept), tried = retraced && !all && share.coin > F(0.f);
    for_each_lane(bits(all), [&](int k) { add_chain_light(context, scratch, lane(w.index, k), 1, bounce); });
    w.trials = select(tried, Int<F>(1), w.trials);
    round.alive = round.alive && (!retraced || tried);
    round.begins = round.begins || tried;
}

// Keeps the solutions of the lanes of `solved` that carry light; the others end.
template <Features S, class F> void keep_solutions(const KernelContext& context, ManifoldColumns& c, const ChainEnd<F>& end, int bounce,
                                                   const Mask<F>& solved, Walk<F>& w, WalkRound<F>& round) {
    const ReceiverBsdf<F> at = receiver_bsdf<S, F>(context, c.at, w.index, load3<F>(c.ns, w.index), w.direction, solved);
    const F facing = cos_at_light<F>(c, w);
    const F pdf = gather(c.density, w.index) * end.determinant / max(facing, F(1e-20f)); // of the direction
    const F by_paths = select(of_zero_size<F>(c, w), F(0.f), at.pdf);
    const HitShare<F> share = share_of_hits<F>(by_paths, pdf);
    Vec<F> found = load3<F>(c.reflected, w.index) * load3<F>(c.emission, w.index) * w.transmittance * at.f_cos * (1.f / pdf);
    found = select<F>(facing > F(0.f), found, splat<F>(0.f));
    if constexpr (S.has(Feature::clearcoat)) found = found * through_clearcoat(gather(c.clearcoat, w.index), facing);
    if constexpr (S.has(Feature::light_profiles))
        found = found * emission_profile<F>(*context.scene, gather(c.light, w.index), -w.ray.direction, solved);
    const Mask<F> short_enough = as_mask((w.events + bounce) < context.settings.max_bounces);
    const F passed = c.blended ? gather(c.blended->passed.data, w.index) : F(1.f);
    Mask<F> carries = solved && dot(w.direction, load3<F>(c.ng, w.index)) > F(0.f) && has_light(found) && passed > F(0.f) && short_enough;
    if constexpr (S.has(Feature::links)) {
        const LinkTables& links = context.scene->links;
        if (links.lit_sets)
            carries = carries && is_lit<F>(links, select(carries, gather(c.light, w.index), Int<F>(0)), round.part, carries);
    }
    const unsigned lanes = bits(carries);
    put3<F>(c.root, w.index, w.direction, lanes);
    const F beside = beside_light_vertices<S, F>(*context.scene, c, w, pdf, at.cosine, carries) *
                     beside_shared_light_paths<S, F>(*context.scene, c, w, at, pdf, carries);
    put3<F>(c.found, w.index, found * (passed * share.kept * beside), lanes);
    put<F>(c.same, w.index, end.same, lanes);
    put<F>(c.coin, w.index, share.coin, lanes);
    put_int<F>(c.root_chain, w.index, w.chain, lanes);
    if (c.measures) {
        const F density = density_without<S, F>(*context.scene, c, w, at, carries);
        const F least = select(of_zero_size<F>(c, w), pdf * unfound_density, F(1e-20f));
        put<F>(c.base, w.index, luminance(found) * pdf / max(density, least), lanes);
    }
    w.state = select(carries, Int<F>(arrives), w.state);
    round.alive = round.alive && (!solved || carries);
}

// Walks that have converged: the first of a receiver has a solution, later ones have found it again or not.
template <Features S, class F> void converge(const KernelContext& context, TileScratch& scratch, const ChainEnd<F>& end, int bounce,
                                             const Mask<F>& converged, Walk<F>& w, WalkRound<F>& round) {
    ManifoldColumns& c = *scratch.manifolds;
    const Mask<F> again = converged && as_mask(w.trials > 0), solved = converged && !again;
    const Vec<F> off = w.direction - load3<F>(c.root, w.index);
    const Mask<F> same = again && as_mask(w.chain == gather(c.root_chain, w.index)) && dot(off, off) <= gather(c.same, w.index);
    // The light of a hit is that of manifold sampling then.
    const Mask<F> solution = same && as_mask((gather(c.kind, w.index) & int32_t(receiver_hit)) == 0);
    for_each_lane(bits(solution), [&](int k) { add_chain_light(context, scratch, lane(w.index, k), lane(w.trials, k), bounce); });
    round.alive = round.alive && !same;
    round.missed = round.missed || (again && !same);
    if (any(solved)) keep_solutions<S, F>(context, c, end, bounce, solved, w, round);
}

// Newton's method where chains have ended or failed: takes the next step, or half of the last one if it has led away.
template <Features S, class F>
void take_steps(const KernelContext& context, TileScratch& scratch, int bounce, Walk<F>& w, WalkRound<F>& round) {
    const Mask<F> retraced = (round.ends || round.failed) && as_mask(w.state == int32_t(retraces));
    if (any(retraced)) weigh_hits<S, F>(context, scratch, bounce, retraced, w, round);
    const Mask<F> traced = (round.ends || round.failed) && !retraced;
    if (!any(traced)) return;
    ManifoldColumns& c = *scratch.manifolds;
    const ChainEnd<F> end = end_of_chain<F>(c, w);
    const unsigned lanes = bits(traced);
    const Int<F> iterations = gather(c.iterations, w.index) + 1;
    const F best_error = gather(c.best_error, w.index), tolerance = gather(c.tolerance, w.index);
    const Mask<F> first = as_mask(iterations == 1);
    const Mask<F> better = traced && round.ends && end.valid && (first || end.error < best_error);
    const Vec<F> best = select<F>(better, w.direction, load3<F>(c.best, w.index));
    const F step_u = select(better, end.step_u, gather(c.step_u, w.index)), step_v = select(better, end.step_v, gather(c.step_v, w.index));
    const F scale = select(better, F(1.f), gather(c.scale, w.index) * 0.5f);
    put_int<F>(c.iterations, w.index, iterations, lanes);
    put3<F>(c.best, w.index, best, lanes);
    put<F>(c.best_error, w.index, select(better, end.error, best_error), lanes);
    put<F>(c.step_u, w.index, step_u, lanes);
    put<F>(c.step_v, w.index, step_v, lanes);
    put<F>(c.scale, w.index, scale, lanes);

    // Walks that have just explored take a step first: round.part is not of their chain.
    const Mask<F> converged = better && end.error <= tolerance && !round.explored;
    const Mask<F> fails =
        traced && !converged && ((!better && (first || scale < F(least_scale))) || as_mask(iterations >= max_walk_iterations));
    if (any(converged)) converge<S, F>(context, scratch, end, bounce, converged, w, round);
    // Without a solution the receiver gets no light from this point; a failed trial is followed by the next.
    const Mask<F> tries = fails && as_mask(w.trials > 0);
    round.alive = round.alive && (!fails || tries);
    round.missed = round.missed || tries;
    const Mask<F> steps = traced && !converged && !fails;
    w.direction = select<F>(steps, stepped<F>(best, step_u, step_v, scale), w.direction);
    begin_chain<F>(c, w, steps);
}

// Advances walks by the hits of their rays; `share`: of their light that is left there. Returns the lanes that go on.
template <Features S, class F> [[gnu::noinline, gnu::flatten]] Mask<F> advance_walks(const KernelContext& context, TileScratch& scratch,
                                                                                     const Int<F>& index, const Hit<F>& hit, const F& share,
                                                                                     int bounce, const Mask<F>& active) {
    ManifoldColumns& c = *scratch.manifolds;
    Walk<F> w = load_walk<F>(c, index);
    const Mask<F> none = Mask<F>(false);
    WalkRound<F> round{active, active, none, none, none, none, none};
    const Mask<F> arrived = as_mask(w.state == int32_t(arrives));
    take_arrivals<F>(c, hit, share, w, round);
    round.active = active && !arrived;
    take_events<S, F>(context, c, hit, share, w, round);
    take_steps<S, F>(context, scratch, bounce, w, round);
    const Mask<F> begins = (round.begins || round.missed) && round.alive;
    if (any(begins)) {
        const Mask<F> ended = begin_walks<F>(*context.scene, c, w, begins, round.missed);
        add_ended_light<F>(context, scratch, w, bounce, ended);
        round.alive = round.alive && !ended;
    }
    const Mask<F> cut = round.alive && as_mask(w.trials >= max_trials(c));
    if (any(cut)) {
        c.cut += count(cut);
        if (!c.measures) scratch.truncated_paths += count(cut);
        add_ended_light<F>(context, scratch, w, bounce, cut);
    }
    if (c.measures) c.shared_rays += count(active && as_mask((gather(c.kind, w.index) & int32_t(receiver_shares)) != 0));
    const Mask<F> alive = round.alive && !cut;
    store_walk<F>(c, w, bits(alive));
    return alive;
}

// Advances the walks of `live` receivers, which ManifoldColumns::live lists, until all have ended. Overwrites `rays`.
template <Features S, class F> void run_walks(const KernelContext& context, TileScratch& scratch, PathQueue& rays, int bounce, int live) {
    ManifoldColumns& c = *scratch.manifolds;
    while (live > 0) {
        for (int k = 0; k < live; k += width<F>) {
            const Int<F> index = live_walks<F>(c, k, live);
            const Vec<F> origin = load3<F>(c.position, index), direction = load3<F>(c.ray, index);
            store(rays.ox + k, origin.x);
            store(rays.oy + k, origin.y);
            store(rays.oz + k, origin.z);
            store(rays.dx + k, direction.x);
            store(rays.dy + k, direction.y);
            store(rays.dz + k, direction.z);
        }
        scratch.bounce_rays += live;
        trace_walks<F>(context, c, rays, live, scratch.hits);
        int kept = 0;
        for (int k = 0; k < live; k += width<F>) {
            const Mask<F> active = as_mask(iota<F>() + k < live);
            const Int<F> index = live_walks<F>(c, k, live);
            const F share = c.blended ? load<F>(c.blended->share + k) : F(1.f);
            const Mask<F> alive = advance_walks<S, F>(context, scratch, index, load_hit<F>(scratch.hits, k), share, bounce, active);
            compress(c.live + kept, index, bits(alive));
            kept += count(alive);
        }
        live = kept;
    }
}

// Runs the walks of the queued receivers, as begin(walk, lanes) starts them. Overwrites `rays`.
template <Features S, class F, class Begin>
void run_receivers(const KernelContext& context, TileScratch& scratch, PathQueue& rays, int bounce, const Begin& begin) {
    ManifoldColumns& c = *scratch.manifolds;
    if (context.scene->blends != bool(c.blended)) c.blended = context.scene->blends ? std::make_unique<WalkTransmittance>() : nullptr;
    for (int k = 0; k < c.size; k += width<F>) {
        const Mask<F> active = as_mask(iota<F>() + k < c.size);
        Walk<F> w = load_walk<F>(c, select(active, Int<F>(iota<F>() + k), Int<F>(0)));
        w.trials = Int<F>(0);
        begin(w, active);
        store_walk<F>(c, w, bits(active));
        store(c.live + k, w.index);
    }
    run_walks<S, F>(context, scratch, rays, bounce, c.size);
    c.size = 0;
}
// Queues the chain of a light vertex as that of a hit.
inline void queue_light_vertex(ManifoldHitColumns& hits, const LightVertexColumns& v, int slot) {
    const int k = hits.size++;
    hits.slot[k] = slot;
    hits.light[k] = v.light[slot];
    hits.chain[k] = v.chain[slot];
    hits.wavelength[k] = v.wavelength[slot];
    hits.random[k] = 0;
    copy3(hits.target, k, v.target, slot);
    copy3(hits.emitted, k, v.reflected, slot);
    copy3(hits.start.origin, k, v.origin, slot);
    copy3(hits.start.ns, k, v.ns, slot);
    copy3(hits.start.direction, k, v.wi, slot);
    hits.start.ratio[k] = hits.start.arrival[k] = 0;
    hits.start.at.geometry[k] = -1; // its BSDF is not asked for
}

// Traces the chains of the queued hits again.
template <Features S, class F> void retrace_hits(const KernelContext& context, TileScratch& scratch, PathQueue& rays, int bounce) {
    ManifoldColumns& c = *scratch.manifolds;
    add_hit_receivers<S, F>(*context.scene, c);
    c.hits.size = 0;
    run_receivers<S, F>(context, scratch, rays, bounce, [&](Walk<F>& w, const Mask<F>& active) {
        w.direction = load3<F>(c.root, w.index);
        w.chain = gather(c.root_chain, w.index);
        w.state = Int<F>(retraces);
        begin_chain<F>(c, w, active);
    });
}

// The same for light vertices: sets LightVertexColumns::ratio; the chain becomes 0 where it has no solution.
template <Features S, class F>
void retrace_light_vertices(const KernelContext& context, TileScratch& scratch, PathQueue& rays, ManifoldColumns::Traced traced) {
    ManifoldColumns& c = *scratch.manifolds;
    if (c.hits.size == 0) return;
    c.traced = traced;
    retrace_hits<S, F>(context, scratch, rays, 0);
    c.traced = ManifoldColumns::Traced::hits;
}

// Adds the light of chains: that which reaches the queued receivers, then that of the hits. Overwrites `rays`.
template <Features S, class F> void sample_manifolds(const KernelContext& context, TileScratch& scratch, PathQueue& rays, int bounce) {
    ManifoldColumns& c = *scratch.manifolds;
    run_receivers<S, F>(context, scratch, rays, bounce,
                        [&](Walk<F>& w, const Mask<F>& active) { begin_walks<F>(*context.scene, c, w, active, Mask<F>(false)); });
    if (c.hits.size > 0) retrace_hits<S, F>(context, scratch, rays, bounce);
}

} // namespace blush::inline BLUSH_ISA
