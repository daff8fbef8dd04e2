// Path::chain: the specular events of a path that manifold sampling (manifold_sampling.h) may find, too, and which strategies have their
// light where light paths (light_paths.h) could carry it as well:
//   - Manifold sampling alone if no light path can connect to the camera, as the path's first vertex is a mirror or glass.
//   - Both (MIS) if the path sees the chain's rough surface by a mirror or glass behind its first vertex, as a wall above a pool sees the
//     bottom. Light paths find that way back by chance alone, but samples of manifold sampling are not bounded where caustics have folds.
//   - Light paths alone for all other chains; and for those of lights of zero size, as there no path of the camera finds a chain for which
//     walks have no seed.
//
// A chain's solution has the density d among directions. A camera path has reached its rough surface x with the density a, and light
// paths with the same vertices have the density b a, with b from the density of emission and Path::light_ratio. Manifold sampling and the
// hits that share its light have the weight k d / (k d + b), light paths the rest: the balance heuristic (Veach 1997, section 9.2), but for
// the probability that a walk finds the solution, which is not known. Weights add up to 1 for any densities that both strategies agree on,
// so light paths trace their chain again from x.
#pragma once

#include "render/integrator/path.h"
#include "shading/manifold_seeds.h"

namespace blush::inline BLUSH_ISA {

// Path::chain has in its low byte 1 behind a surface that chains begin at, and 1 more for each event; from bit 8 on, the events
// (shading/manifold_seeds.h); and three flags.
constexpr int32_t chain_length_mask = 0xff, chain_first_event = 0x100, chain_events_mask = 0xff00;
constexpr int32_t shares_chains = 1 << 16;     // light that comes by chains belongs to both strategies, as above
constexpr int32_t lit_by_chain = 1 << 17;      // of light paths: their first rough surface was reached by a chain
constexpr int32_t begins_lambertian = 1 << 18; // the chain begins at a Lambertian surface, which connects to light vertices
constexpr int32_t chain_flags = shares_chains | lit_by_chain;

constexpr float walk_weight = 1.f; // k above

template <class F> Int<F> chain_length(const Int<F>& chain) { return (chain & chain_length_mask) - 1; }
template <class F> Mask<F> chain_begins(const Int<F>& chain) { return as_mask((chain & chain_length_mask) == 1); }
// The events as a number (shading/manifold_seeds.h), the one behind the rough surface first.
template <class F> Int<F> chain_events(const Int<F>& chain) {
    return ((chain & chain_events_mask) >> 8) | (chain_length<F>(chain) << chain_count_shift);
}
template <class F> Int<F> longer_chain(const Int<F>& chain, const Mask<F>& refracts) {
    Int<F> place = Int<F>(chain_first_event);
    for (int i = 0; i < max_chain_events; ++i) place = select(as_mask(chain_length<F>(chain) > i), Int<F>(place << 1), place);
    return (chain + 1) | select(refracts, place, Int<F>(0));
}
template <class F> Mask<F> may_grow(const Int<F>& chain) {
    return as_mask(chain_length<F>(chain) >= 0) && as_mask(chain_length<F>(chain) <= max_chain_events);
}
template <class F> Mask<F> is_chain(const Int<F>& chain) {
    return as_mask(chain_length<F>(chain) > 0) && as_mask(chain_length<F>(chain) <= max_chain_events);
}
template <class F> Mask<F> has_flag(const Int<F>& chain, int32_t flag) { return as_mask((chain & flag) != 0); }

// True for lights that no ray can hit (has_zero_size). `light`: record.
template <class F> Mask<F> is_zero_size(const LightTables& tables, const Int<F>& light) {
    const Int<F> kind = gather_field(tables.lights, &LightRecord::kind, light);
    const F height = gather_field(tables.lights, &LightRecord::cone_height, light);
    return as_mask(kind == int32_t(LightKind::point)) || (as_mask(kind == int32_t(LightKind::sun)) && !(height > F(0.f)));
}

// True if some surface samples manifolds.
template <Features S> bool samples_manifolds(const SceneTables& scene) {
    if constexpr (S.has(Feature::light_paths)) return !scene.manifolds.empty();
    return false;
}
// Paths whose first vertex no light path can connect to the camera.
template <class F> Mask<F> is_left_by_light_paths(const SceneTables& scene, const Path<F>& path, int bounce) {
    if (scene.emission.empty()) return Mask<F>(true);
    return Mask<F>(bounce > 0) && path.light_ratio == F(0.f);
}
// Paths whose rough vertex at this bounce may begin a chain to some light
template <Features S, class F> Mask<F> starts_chains(const SceneTables& scene, const Path<F>& path, int bounce) {
    if (!samples_manifolds<S>(scene)) return Mask<F>(false);
    return is_left_by_light_paths<F>(scene, path, bounce) || has_flag<F>(path.chain, shares_chains);
}
// and, if they share it with light paths, to this one. `light` is valid.
template <class F> Mask<F> shares_chains_to(const SceneTables& scene, const Path<F>& path, const Int<F>& light) {
    return !has_flag<F>(path.chain, shares_chains) || !is_zero_size<F>(scene.lights, light);
}

// True for lights of which manifold sampling finds chains. `light`: record; -1: none.
template <class F> Mask<F> is_end_of_chains(const SceneTables& scene, const Int<F>& light, const Mask<F>& active) {
    const Mask<F> known = active && as_mask(light >= 0) && as_mask(light < scene.manifolds.lights);
    if (!any(known)) return known;
    return known && as_mask(gather(scene.manifolds.group_of_light, select(known, light, Int<F>(0))) >= 0);
}
// Light that manifold sampling finds, too, from the rough surface before (manifold_hits.h).
template <Features S, class F>
Mask<F> found_by_manifolds(const SceneTables& scene, const Path<F>& path, const Int<F>& light, const Mask<F>& active) {
    if (!samples_manifolds<S>(scene)) return Mask<F>(false);
    const Mask<F> chained = active && is_chain<F>(path.chain);
    return any(chained) ? is_end_of_chains<F>(scene, light, chained) : chained;
}

template <class F> Mask<F> has_chains(const SceneTables& scene, const Int<F>& material) {
    return as_mask((gather_field(scene.materials.materials, &MaterialRecord::flags, material) & int32_t(material_chains)) != 0);
}
// What a vertex does to chains.
template <class F> struct ChainEvent {
    Mask<F> delta;    // the path goes on by a delta lobe,
    Mask<F> crosses;  // by refraction,
    Mask<F> internal; // or is reflected within a solid, not totally: that ends a chain, as there are many that carry little light
    Mask<F> chains;   // the material has material_chains
    Mask<F> begins;   // chains begin here, and end for light paths
    Mask<F> lambertian = Mask<F>(false); // and the surface is Lambertian; not of light paths
};
template <class F> Mask<F> extends_chain(const Int<F>& chain, const ChainEvent<F>& event) {
    return event.delta && !event.internal && event.chains && may_grow<F>(chain);
}
// Path::chain behind a vertex of a path of the camera. `connected`: light paths can connect its first vertex to the camera.
template <class F> Int<F> next_chain(const Int<F>& chain, const ChainEvent<F>& event, const Mask<F>& connected) {
    const Int<F> flags = (chain & chain_flags) | select(event.delta && connected, Int<F>(shares_chains), Int<F>(0));
    const Int<F> first = select(event.lambertian, Int<F>(1 | begins_lambertian), Int<F>(1));
    const Int<F> begun = select(event.begins && !event.delta, first, Int<F>(0));
    return flags | select(extends_chain<F>(chain, event), longer_chain<F>(chain, event.crosses), begun);
}
// The same for light paths, which begin with a chain of no events. The events are those seen from the rough surface, too.
template <class F> Mask<F> is_lit_by_chain(const Int<F>& chain, const ChainEvent<F>& event) {
    return event.begins && !event.delta && is_chain<F>(chain);
}
template <class F> Int<F> next_light_chain(const Int<F>& chain, const ChainEvent<F>& event) {
    const Int<F> flags = (chain & chain_flags) | select(is_lit_by_chain<F>(chain, event), Int<F>(lit_by_chain), Int<F>(0)) |
                         select(event.delta && has_flag<F>(chain, lit_by_chain), Int<F>(shares_chains), Int<F>(0));
    const Int<F> event_bit = select(event.crosses, Int<F>(chain_first_event), Int<F>(0));
    const Int<F> events = (((chain & chain_events_mask) << 1) & chain_events_mask) | event_bit;
    return flags | select(extends_chain<F>(chain, event), Int<F>(((chain & chain_length_mask) + 1) | events), Int<F>(0));
}

} // namespace blush::inline BLUSH_ISA
