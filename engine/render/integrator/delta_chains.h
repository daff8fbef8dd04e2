// Delta chains: light that a camera sees by delta lobes alone, as the camera sees lamps in mirrors and glass. Path samples select one lobe
// at each surface. The image of a lamp after seven reflections within a glass ball is then met by one path in ten thousand, with the full
// brightness of the lamp: a firefly. Chains follow all lobes instead (Whitted 1980, "An improved illumination model for shaded display"),
// each with its share: the probability with which a path would have selected its lobes. Below `least_share` they are subject to Russian
// roulette (Arvo and Kirk 1990), so a sample has no more chains than its light needs, and none adds more than its share of a lamp.
#pragma once

#include "render/film/edges/highlight_places.h"
#include "render/integrator/wavefront.h"
#include "shading/delta_lobes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <type_traits>

namespace blush::inline BLUSH_ISA {

constexpr float least_share = 1.f / 64;    // so faint images of lamps keep a sixty-fourth of their variance
constexpr uint32_t chain_key = 0x1f83d9ab; // any: tells the random numbers of lobes from others
constexpr float sighting_cone = 0.0340741737f, sighting_angle = 0.21409442f; // 1 - cos(15 degrees); the cone's solid angle, sr

// The lobes of one surface that go on, for the lanes of a register.
template <class F> struct ChainLobes {
    std::array<DeltaLobe<F>, num_delta_lobes> all;
    std::array<Vec<F>, num_delta_lobes> wi;       // world
    std::array<Mask<F>, num_delta_lobes> outward; // wi leaves to the side of ng
    std::array<Vec<F>, num_delta_lobes> beta;
    std::array<F, num_delta_lobes> share;
    std::array<Mask<F>, num_delta_lobes> lanes;
};

// No sample has more than most_copies chains: where it has as many, a surface selects one of its lobes in proportion to their shares.
// `choice`: uniform in [0, 1).
template <class F>
void limit_chains(Column<int32_t>& alive, const Int<F>& slots, const F& choice, const Mask<F>& active, ChainLobes<F>& lobes) {
    alignas(64) float shares[num_delta_lobes][width<F>], scale[num_delta_lobes][width<F>];
    std::array<unsigned, num_delta_lobes> lanes;
    for (size_t l = 0; l < num_delta_lobes; ++l) {
        store(shares[l], select(lobes.lanes[l], lobes.share[l], F(0.f)));
        std::fill_n(scale[l], width<F>, 1.f);
        lanes[l] = bits(lobes.lanes[l]);
    }
    bool limited = false;
    for_each_lane(bits(active), [&](int i) {
        int count = 0;
        for (const unsigned of : lanes) count += int(of >> i & 1);
        int32_t& of_slot = alive[lane(slots, i)];
        if (count < 2 || of_slot + count - 1 <= most_copies) {
            of_slot += count - 1;
            return;
        }
        limited = true;
        float sum = 0;
        for (const auto& of : shares) sum += of[i];
        float left = lane(choice, i) * sum;
        size_t selected = 0;
        for (size_t l = 0; l < num_delta_lobes; ++l) {
            if (shares[l][i] > 0 && left >= 0) selected = l; // the last one if rounding leaves a rest
            left -= shares[l][i];
            scale[l][i] = 0;
        }
        scale[selected][i] = sum / shares[selected][i];
    });
    if (!limited) return;
    for (size_t l = 0; l < num_delta_lobes; ++l) {
        const F by = load<F>(scale[l]);
        lobes.beta[l] = lobes.beta[l] * by;
        lobes.share[l] = lobes.share[l] * by;
        lobes.lanes[l] = lobes.lanes[l] && by > F(0.f);
    }
}

// Sorts the entries of a queue from `first` on, which are those of lobes[0], lobes[1], ..., by lane, and those of a lane by lobe: so the
// chains of a sample keep their order whatever other samples a register holds.
template <Features S> void sort_by_lane(PathQueue& q, Column<float>& share, Column<int32_t>& codes, int first,
                                        const std::array<unsigned, num_delta_lobes>& lobes) {
    int order[num_delta_lobes * 32], count = 0;
    for_each_lane(lobes[0] | lobes[1] | lobes[2], [&](int i) {
        int begin = first;
        for (const unsigned lanes : lobes) {
            if (lanes >> i & 1) order[count++] = begin + std::popcount(lanes & ((1u << i) - 1));
            begin += std::popcount(lanes);
        }
    });
    const auto sort = [&](auto&... columns) {
        const auto sort_one = [&](auto& column) {
            auto* data = column.data;
            std::remove_reference_t<decltype(*data)> sorted[num_delta_lobes * 32];
            for (int k = 0; k < count; ++k) sorted[k] = data[order[k]];
            for (int k = 0; k < count; ++k) data[first + k] = sorted[k];
        };
        (sort_one(columns), ...);
    };
    sort(q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, q.beta_r, q.beta_g, q.beta_b, q.pdf, q.key, q.index, q.slot, share, codes);
    if constexpr (S.has(Feature::light_tree)) sort(q.nx, q.ny, q.nz);
    if constexpr (S.has(Feature::textures)) sort(q.cone);
    if constexpr (S.has(Feature::links)) sort(q.part);
    if constexpr (S.has(Feature::dispersion)) sort(q.dispersed);
}

// All delta lobes behind a vertex, after Russian roulette.
template <Features S, class F> ChainLobes<F> chain_lobes(const Path<F>& path, const ShadedHit<F>& p, const ScatterSetup<F>& setup,
                                                         const F& share, int bounce, const F& survival) {
    const Pair<F> direction =
        Sampler<F>{path.key, path.index}.pair(first_scatter_dimension + dimensions_per_scatter * uint32_t(bounce) + bsdf_dimension);
    ChainLobes<F> lobes;
    lobes.all = delta_lobes<S, F>(p.bsdf, p.shading.wo, direction.x(), direction.y());
    if constexpr (S.has(Feature::transmission)) {
        // trace_through_panes() has let pass a part of the chains, and these are the others.
        lobes.all[delta_transmission].valid = lobes.all[delta_transmission].valid && !setup.pane;
        const F others = 1.f / max(setup.scatter_share, F(0x1p-24f));
        for (DeltaLobe<F>& lobe : lobes.all) {
            lobe.value = lobe.value * others;
            lobe.probability = lobe.probability * others;
        }
    }
    for (size_t l = 0; l < num_delta_lobes; ++l) {
        const DeltaLobe<F>& lobe = lobes.all[l];
        lobes.wi[l] = p.shading.frame.to_world(lobe.wi);
        lobes.outward[l] = dot(lobes.wi[l], p.shading.ng) > F(0.f);
        const F before = share * lobe.probability, q = min(F(before * (1.f / least_share)), F(1.f));
        lobes.beta[l] = p.beta * lobe.value * (1.f / max(q, F(1e-30f)));
        lobes.share[l] = before / max(q, F(1e-30f));
        // Light leaks: as in scatter().
        const Mask<F> same_side = (lobe.wi.z > F(0.f)) == lobes.outward[l];
        lobes.lanes[l] = p.scatters && lobe.valid && same_side && has_light(lobes.beta[l]) && survival < q;
    }
    return lobes;
}

// The chain behind a vertex by one of its lobes.
template <Features S, class F> Path<F> chain_behind(const Path<F>& path, const ShadingPoint<F>& p, const ScatterSetup<F>& setup,
                                                    const ChainLobes<F>& lobes, size_t l, const F& cone, int bounce) {
    IndirectSample<F> s;
    s.bsdf = {lobes.all[l].wi, lobes.all[l].value, F(1.f), Mask<F>(true), lobes.all[l].valid};
    s.wi = lobes.wi[l];
    s.outward = lobes.outward[l];
    Path<F> next = path;
    next_path<S, F>(path, p, setup, s, lobes.beta[l], cone, next);
    // Lobes have random numbers of their own, but a wavelength belongs to its numbers.
    if (l != delta_transmission) {
        const UInt<F> own = path.key ^ pcg_hash((uint32_t(bounce) * uint32_t(num_delta_lobes) + uint32_t(l)) ^ chain_key);
        next.key = select(p.dispersed, path.key, own);
    }
    return next;
}

// The code of a lobe behind the surface of number `bounce`, in its place of ChainLobeCodes::codes.
inline int32_t code_of(size_t lobe, int bounce) { return int32_t(uint32_t(lobe) << (ChainLobeCodes::bits_per_lobe * bounce)); }

// Of followed chains: leaves the lobe that comes next.
template <class F>
void keep_known_lobe(const ChainColumns& chains, const Int<F>& slots, int bounce, const Mask<F>& active, ChainLobes<F>& lobes) {
    alignas(64) int32_t codes[width<F>]{};
    for_each_lane(bits(active), [&](int i) {
        codes[i] = int32_t(chains.followed[size_t(lane(slots, i))].lobes.codes >> (ChainLobeCodes::bits_per_lobe * bounce) &
                           ((1u << ChainLobeCodes::bits_per_lobe) - 1));
    });
    const Int<F> code = load<Int<F>>(codes);
    for (size_t l = 0; l < num_delta_lobes; ++l) lobes.lanes[l] = lobes.lanes[l] && as_mask(code == int32_t(l));
}

// Of followed chains: keeps the rays behind the last lobes. Returns their lanes.
template <class F> Mask<F> keep_ends(ChainColumns& chains, const Path<F>& behind, int bounce, const Mask<F>& lanes) {
    alignas(64) int32_t counts[width<F>]{};
    for_each_lane(bits(lanes), [&](int i) { counts[i] = chains.followed[size_t(lane(behind.slot, i))].lobes.count; });
    const Mask<F> ends = lanes && as_mask(load<Int<F>>(counts) == int32_t(bounce + 1));
    for_each_lane(bits(ends), [&](int i) {
        const auto at = [&](const Vec<F>& v) { return Vec3{lane(v.x, i), lane(v.y, i), lane(v.z, i)}; };
        chains.ends[size_t(lane(behind.slot, i))] = {at(behind.ray.origin), at(behind.ray.direction), true};
    });
    return ends;
}

// Of a chain in a queue: its share and the codes of its lobes.
template <class F> struct ChainSoFar {
    F share;
    Int<F> codes;
};

// Looks for lamps within a cone of 15 degrees around the chain's next ray, by one sampled point on a light, and queues its shadow ray,
// whose slot is the number of the sighting. Within that cone it stands for the light: with throughput beta, radiance L and pdf p it adds
// beta L / (p w) to the mean radiance and 1 / (p w) to the rate, w being the solid angle of the cone. This is a kernel density estimate
// (Silverman 1986): a cone some hundred times as large as a lamp is met as much more often.
template <Features S, class F> [[gnu::noinline]] void sight_lamps(const KernelContext& context, TileScratch& scratch, const Path<F>& next,
                                                                  const ChainSoFar<F>& chain, int bounce, size_t first,
                                                                  const Mask<F>& active) {
    const SceneTables& scene = *context.scene;
    ChainColumns& chains = *scratch.chains;
    const Pair<F> random =
        Sampler<F>{next.key, next.index}.pair(first_scatter_dimension + dimensions_per_scatter * uint32_t(bounce) + light_dimension);
    const LightPoint<F> light = sample_light_point<S, F>(scene, random, {next.ray.origin, next.ray.direction}, active);
    const Vec<F> to = select<F>(light.infinite, light.position, light.position - next.ray.origin);
    const F distance_squared = dot(to, to), distance = sqrt(distance_squared);
    const Vec<F> wi = to / distance;
    const F apart = 1.f - dot(wi, next.ray.direction);
    Mask<F> near = active && light.valid && !light.delta && apart < F(sighting_cone);
    if (!any(near)) return;
    const IncidentLight<F> in = incident_light<S, F>(scene, light, wi, distance_squared);
    Step<F> step;
    step.direct = next.beta * in.radiance;
    near = near && in.pdf > F(0.f) && has_light(step.direct);
    step.shadow = {next.ray.origin, wi};
    step.shadow_distance = select(light.infinite, F(infinity), distance * (1.f - 1e-4f));
    int number = int(chains.sightings.size() - first);
    alignas(64) int32_t numbers[width<F>]{};
    for_each_lane(bits(near), [&](int i) {
        numbers[i] = number++;
        chains.sightings.push_back({.slot = lane(next.slot, i),
                                    .apart = lane(apart, i),
                                    .share = lane(chain.share, i),
                                    .rate = 1 / (double(lane(in.pdf, i)) * double(sighting_angle)),
                                    .light = {},
                                    .film_x = chains.film_x[lane(next.slot, i)],
                                    .film_y = chains.film_y[lane(next.slot, i)],
                                    .lobes = {uint32_t(lane(chain.codes, i)), bounce + 1},
                                    .light_index = lane(light.light, i),
                                    .target = {lane(light.position.x, i), lane(light.position.y, i), lane(light.position.z, i)},
                                    .target_density = lane(light.density, i)});
    });
    if (scene.blends)
        compress(scratch.shadows.random + scratch.shadows.size, opacity_random<F>(next.key, next.index, uint32_t(bounce + 1)), bits(near));
    if (scene.links.lit_sets) compress(scratch.shadows.mask + scratch.shadows.size, UInt<F>(other_ray_mask), bits(near));
    append<F>(scratch.shadows, step, load<Int<F>>(numbers), near);
}

// Keeps the sightings from `first` on whose shadow rays arrive.
template <Features S, class F> void keep_arrived(const KernelContext& context, TileScratch& scratch, int bounce, size_t first) {
    std::vector<ChainSighting>& all = scratch.chains->sightings;
    const size_t count = all.size() - first;
    for (Column<double>* c : {&scratch.r, &scratch.g, &scratch.b}) std::fill_n(c->data, count, 0.0);
    connect_paths<S, F>(context, scratch, bounce);
    size_t kept = first;
    for (size_t k = 0; k < count; ++k) {
        const Vec3d light{scratch.r[k], scratch.g[k], scratch.b[k]};
        const double amount = dot(luminance_weights, light);
        if (!(amount > 0) || !(amount <= 1e300)) continue;
        all[kept] = all[first + k];
        all[kept++].light = light;
    }
    all.erase(all.begin() + std::ptrdiff_t(kept), all.end());
}

// The light that the chains of a register's lanes have met.
template <Features S, class F> void add_met_emission(const KernelContext& context, TileScratch& scratch, const PathQueue& now, int k,
                                                     const Path<F>& path, const F& share, int bounce, const Mask<F>& active,
                                                     Step<F>& step) {
    const Mask<F> emits = step.emits;
    F weight = F(1.f);
    if (scratch.chains->places) {
        const F aimed = gather(scratch.chains->weight.data, path.slot); // -1: does not aim
        weight = select(aimed > F(0.f), aimed, F(1.f));
    }
    const F light = luminance(step.emitted), squares = light * light / (share * weight);
    for_each_lane(bits(emits), [&](int i) { scratch.chains->path_squares[lane(path.slot, i)] += double(lane(squares, i)); });
    add_emission<S, F>(context, scratch, now.slot + k, k, path, bounce, active, step);
}

// Chains k, k + 1, ... of `now`, which is the queue of number `queue`; their lobes go to `next`.
template <Features S, class F> [[gnu::always_inline]] inline void
shade_chain(const KernelContext& context, TileScratch& scratch, const PathQueue& now, PathQueue& next, int queue, int bounce, int k) {
    const SceneTables& scene = *context.scene;
    const EstimatorSettings& settings = context.settings;
    ChainColumns& chains = *scratch.chains;
    Path<F> path = load_path<S, F>(now, k);
    if constexpr (S.has(Feature::links)) path.part = load<Int<F>>(now.part + k);
    if constexpr (S.has(Feature::dispersion)) path.dispersed = load<Int<F>>(now.dispersed + k);
    const F share = load<F>(chains.share[queue] + k);
    const Int<F> codes = load<Int<F>>(chains.lobes[queue] + k);
    const Mask<F> active = as_mask(iota<F>() + k < now.size);
    const Hit<F> hit = load_hit<F>(scratch.hits, k);

    Step<F> step = ended_step<F>(path.beta);
    const Mask<F> met = active && as_mask(hit.geometry >= 0);
    hit_background<S, F>(scene, settings, path, bounce, active && !met, step);
    const HitLanes<F> lanes = hit_sphere_light<S, F>(scene, settings.mis, path, hit, met, step);
    F cone = F(0.f);
    if constexpr (S.has(Feature::textures)) cone = cone_width<F>(scene.camera, settings, path, hit.t);
    const F width_of_filter = filter_width<S, F>(scene, hit, cone, bounce, lanes.surface);
    const ShadedHit<F> p = shade_hit<S, F>(scene, settings.energy, path, hit, lanes.surface, width_of_filter);
    hit_emitter<S, F>(scene, settings.mis, path, hit, p.surface, p.material, p.side, p.arriving, lanes.surface, step);
    hit_unlit<S, F>(p.material, p.arriving, lanes.surface, step);
    if (chains.task == ChainTask::emission) add_met_emission<S, F>(context, scratch, now, k, path, share, bounce, active, step);
    if (bounce >= settings.max_bounces) return;
    if (!any(p.scatters)) {
        for_each_lane(bits(active), [&](int i) { --chains.alive[lane(path.slot, i)]; });
        return;
    }

    const ShadingPoint<F> point{p.surface,  p.material.bsdf, p.shading,    p.bsdf,     p.beta,
                                p.scatters, Mask<F>(false),  p.side.solid, p.dispersed};
    ScatterSetup<F> setup{p.material.pane, F(1.f), false, {}, {p.surface.position, p.shading.ns}};
    if constexpr (S.has(Feature::transmission))
        if (scene.panes) setup = scatter_setup<S, F>(scene, p.material, point);
    const Pair<F> choice =
        Sampler<F>{path.key, path.index}.pair(first_scatter_dimension + dimensions_per_scatter * uint32_t(bounce) + choice_dimension);
    const bool follows = chains.task == ChainTask::follow;
    ChainLobes<F> lobes = chain_lobes<S, F>(path, p, setup, share, bounce, follows ? F(0.f) : choice.y());
    if (follows) keep_known_lobe<F>(chains, path.slot, bounce, active, lobes);
    limit_chains<F>(chains.alive, path.slot, choice.x(), active, lobes);
    const int first = next.size;
    std::array<unsigned, num_delta_lobes> appended{};
    for (size_t l = 0; l < num_delta_lobes; ++l) {
        if (!any(lobes.lanes[l])) continue;
        const Path<F> behind = chain_behind<S, F>(path, point, setup, lobes, l, cone, bounce);
        const Mask<F> finite = is_finite(F(behind.beta.x + behind.beta.y + behind.beta.z));
        Mask<F> continues = lobes.lanes[l] && finite;
        add_light<F>(scratch, now.slot + k, behind.beta, lobes.lanes[l] && !finite); // the film drops and counts the sample
        if (follows) continues = continues && !keep_ends<F>(chains, behind, bounce, continues);
        appended[l] = bits(continues);
        compress(chains.share[1 - queue] + next.size, lobes.share[l], appended[l]);
        compress(chains.lobes[1 - queue] + next.size, Int<F>(codes | code_of(l, bounce)), appended[l]);
        if constexpr (S.has(Feature::links)) compress(next.part + next.size, behind.part, appended[l]);
        if constexpr (S.has(Feature::dispersion)) compress(next.dispersed + next.size, behind.dispersed, appended[l]);
        append<S, F>(next, behind, continues);
        if (chains.task != ChainTask::sight) continue;
        for_each_lane(appended[l], [&](int i) { chains.turned[size_t(lane(path.slot, i))] = 1; });
    }
    if (next.size > first) sort_by_lane<S>(next, chains.share[1 - queue], chains.lobes[1 - queue], first, appended);
}

template <Features S, class F> [[gnu::flatten]] void shade_chains(const KernelContext& context, TileScratch& scratch, const PathQueue& now,
                                                                  PathQueue& next, int queue, int bounce) {
    next.size = 0;
    for (int k = 0; k < now.size; k += width<F>) shade_chain<S, F>(context, scratch, now, next, queue, bounce, k);
}

// Sightings of the rays in the queue of number `queue`.
template <Features S, class F>
void sight_lamps_of(const KernelContext& context, TileScratch& scratch, const PathQueue& rays, int queue, int bounce) {
    const size_t first = scratch.chains->sightings.size();
    scratch.shadows.size = 0;
    for (int k = 0; k < rays.size; k += width<F>) {
        const Path<F> path = load_path<S, F>(rays, k);
        const ChainSoFar<F> chain{load<F>(scratch.chains->share[queue] + k), load<Int<F>>(scratch.chains->lobes[queue] + k)};
        sight_lamps<S, F>(context, scratch, path, chain, bounce, first, as_mask(iota<F>() + k < rays.size));
    }
    scratch.shadow_rays += scratch.shadows.size;
    keep_arrived<S, F>(context, scratch, bounce, first);
}

// The samples of the tile or of the task, and their first rays. Returns their number.
template <Features S, class F> int begin_chains(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    ChainColumns& chains = *scratch.chains;
    if (chains.task == ChainTask::emission) {
        generate_paths<S, F>(context, job, scratch);
        return job.paths();
    }
    const SampleColumns to = sample_columns(scratch);
    const int n = int(chains.task == ChainTask::sight ? chains.samples.size() : chains.followed.size());
    for (int k = 0; k < n; ++k) {
        const ChainStart& from = chains.task == ChainTask::sight ? chains.samples[size_t(k)] : chains.followed[size_t(k)].sample;
        to.x[k] = from.x, to.y[k] = from.y, to.sample[k] = from.index;
    }
    begin_paths<S, F>(context, n, scratch);
    return n;
}

// The positions of the samples on the film: of paths; and in pixels with places of highlights those that aim at them, as far as `places` is
// set.
template <Features S, class F> void find_film_positions(const KernelContext& context, int n, TileScratch& scratch) {
    ChainColumns& chains = *scratch.chains;
    const PathQueue& q = scratch.paths[0];
    const SampleColumns pixels = sample_columns(scratch);
    const FilterTable& filter = *context.settings.filter;
    const bool aims = chains.places != nullptr;
    for (int k = 0; k < n; k += width<F>) {
        const Pair<F> in_pixel = Sampler<F>{load<UInt<F>>(q.key + k), load<UInt<F>>(q.index + k)}.pair(0);
        store(chains.film_x + k, aims ? in_pixel.x() : load<F>(pixels.x + k) + 0.5f + filter_offset(filter, in_pixel.x()));
        store(chains.film_y + k, aims ? in_pixel.y() : load<F>(pixels.y + k) + 0.5f + filter_offset(filter, in_pixel.y()));
        store(chains.weight + k, F(1.f));
    }
    if (aims) aim_samples(*chains.places, filter, n, {pixels.x, pixels.y, chains.film_x, chains.film_y, chains.weight});
}

// Makes the first rays those through the positions on the film, where these have a weight.
template <Features S, class F> void move_on_film(const KernelContext& context, int n, TileScratch& scratch) {
    const ChainColumns& chains = *scratch.chains;
    PathQueue& q = scratch.paths[0];
    const EstimatorSettings& settings = context.settings;
    for (int k = 0; k < n; k += width<F>) {
        const F weight = load<F>(chains.weight + k);
        const Mask<F> moved = weight >= F(0.f);
        if (!any(moved)) continue;
        F lens_u = F(0.f), lens_v = F(0.f);
        if constexpr (S.has(Feature::thin_lens)) {
            const Pair<F> on_lens = Sampler<F>{load<UInt<F>>(q.key + k), load<UInt<F>>(q.index + k)}.pair(1);
            lens_u = on_lens.x();
            lens_v = on_lens.y();
        }
        const Ray<F> ray = camera_ray<S, F>(context.scene->camera, load<F>(chains.film_x + k), load<F>(chains.film_y + k), settings.width,
                                            settings.height, lens_u, lens_v);
        const auto set = [&](float* column, const F& value) { store(column + k, select(moved, value, load<F>(column + k))); };
        set(q.ox, ray.origin.x), set(q.oy, ray.origin.y), set(q.oz, ray.origin.z);
        set(q.dx, ray.direction.x), set(q.dy, ray.direction.y), set(q.dz, ray.direction.z);
        set(q.beta_r, weight), set(q.beta_g, weight), set(q.beta_b, weight);
    }
}

// What the task needs of the samples before their first rays.
template <Features S, class F> void begin_task(const KernelContext& context, int n, TileScratch& scratch) {
    ChainColumns& chains = *scratch.chains;
    std::fill_n(chains.share[0].data, n, 1.f);
    std::fill_n(chains.lobes[0].data, n, 0);
    std::fill_n(chains.alive.data, n, 1);
    switch (chains.task) {
    case ChainTask::emission:
        if (scratch.bounces) scratch.bounces->begin();
        std::fill_n(chains.path_squares.data, n, 0.0);
        if (!chains.places) return;
        find_film_positions<S, F>(context, n, scratch);
        move_on_film<S, F>(context, n, scratch);
        return;
    case ChainTask::sight:
        std::fill(chains.turned.begin(), chains.turned.end(), uint8_t(0));
        find_film_positions<S, F>(context, n, scratch);
        return;
    case ChainTask::follow:
        for (int k = 0; k < n; ++k) {
            chains.film_x[k] = chains.followed[size_t(k)].film_x;
            chains.film_y[k] = chains.followed[size_t(k)].film_y;
            chains.weight[k] = 1;
            chains.ends[size_t(k)].valid = false;
        }
        move_on_film<S, F>(context, n, scratch);
    }
}

// Does the ChainTask of `scratch` for chains of at most `max_bounces` delta lobes. Emission has the same mean, for each slot, as
// render_tile() with `emission_only`. The tile or the samples of the task have at most tile_capacity / most_copies slots.
template <Features S, class F> void trace_delta_chains(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    StageTimer timer(scratch.stages);
    if (!scratch.chains) scratch.chains = std::make_unique<ChainColumns>();
    ChainColumns& chains = *scratch.chains;
    const int n = begin_chains<S, F>(context, job, scratch);
    begin_task<S, F>(context, n, scratch);
    timer.end(Stage::generate);
    for (int bounce = 0, queue = 0; scratch.paths[queue].size > 0; ++bounce, queue = 1 - queue) {
        PathQueue &now = scratch.paths[queue], &next = scratch.paths[1 - queue];
        (bounce > 0 ? scratch.bounce_rays : scratch.camera_rays) += now.size;
        trace_paths<S, F>(context, scratch, now, next, bounce);
        timer.end(Stage::trace);
        shade_chains<S, F>(context, scratch, now, next, queue, bounce);
        if (chains.task == ChainTask::sight)
            sight_lamps_of<S, F>(context, scratch, next, 1 - queue, bounce);
        else if (chains.task == ChainTask::emission && scratch.bounces)
            record_bounce(scratch, n, bounce);
        timer.end(Stage::shade);
    }
}

} // namespace blush::inline BLUSH_ISA
