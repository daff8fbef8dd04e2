// The queues of a tile: loads and stores paths and shadow rays in registers, and traces their rays with Embree.
#pragma once

#include "render/bvh/brute_force.h"
#include "render/integrator/path.h"
#include "render/integrator/strategy_sums.h"
#include "render/kernels/kernel.h"

namespace blush::inline BLUSH_ISA {

template <Features S, class F> Path<F> load_path(const PathQueue& q, int k) {
    Path<F> p;
    p.ray.origin = {load<F>(q.ox + k), load<F>(q.oy + k), load<F>(q.oz + k)};
    p.ray.direction = {load<F>(q.dx + k), load<F>(q.dy + k), load<F>(q.dz + k)};
    p.beta = {load<F>(q.beta_r + k), load<F>(q.beta_g + k), load<F>(q.beta_b + k)};
    p.pdf = load<F>(q.pdf + k);
    p.normal = splat<F>(0.f);
    if constexpr (S.has(Feature::light_tree)) p.normal = {load<F>(q.nx + k), load<F>(q.ny + k), load<F>(q.nz + k)};
    p.cone = F(0.f);
    if constexpr (S.has(Feature::textures)) p.cone = load<F>(q.cone + k);
    p.key = load<UInt<F>>(q.key + k);
    p.index = load<UInt<F>>(q.index + k);
    p.slot = load<Int<F>>(q.slot + k);
    p.importance = F(1.f);
    p.light_ratio = p.emission_ratio = F(0.f);
    p.chain = Int<F>(0);
    if constexpr (S.has(Feature::light_paths)) {
        p.light_ratio = load<F>(q.light_ratio + k);
        p.emission_ratio = load<F>(q.emission_ratio + k);
        p.chain = load<Int<F>>(q.chain + k);
    }
    return p;
}

template <Features S, class F> void append(PathQueue& q, const Path<F>& p, const Mask<F>& lanes) {
    const unsigned b = bits(lanes);
    const int k = q.size;
    compress(q.ox + k, p.ray.origin.x, b);
    compress(q.oy + k, p.ray.origin.y, b);
    compress(q.oz + k, p.ray.origin.z, b);
    compress(q.dx + k, p.ray.direction.x, b);
    compress(q.dy + k, p.ray.direction.y, b);
    compress(q.dz + k, p.ray.direction.z, b);
    compress(q.beta_r + k, p.beta.x, b);
    compress(q.beta_g + k, p.beta.y, b);
    compress(q.beta_b + k, p.beta.z, b);
    compress(q.pdf + k, p.pdf, b);
    if constexpr (S.has(Feature::light_tree)) {
        compress(q.nx + k, p.normal.x, b);
        compress(q.ny + k, p.normal.y, b);
        compress(q.nz + k, p.normal.z, b);
    }
    if constexpr (S.has(Feature::textures)) compress(q.cone + k, p.cone, b);
    if constexpr (S.has(Feature::light_paths)) {
        compress(q.light_ratio + k, p.light_ratio, b);
        compress(q.emission_ratio + k, p.emission_ratio, b);
        compress(q.chain + k, p.chain, b);
    }
    compress(q.key + k, p.key, b);
    compress(q.index + k, p.index, b);
    compress(q.slot + k, p.slot, b);
    q.size += count(lanes);
}

template <class F> void append(ShadowQueue& q, const Step<F>& s, const Int<F>& slot, const Mask<F>& lanes) {
    const unsigned b = bits(lanes);
    const int k = q.size;
    compress(q.ox + k, s.shadow.origin.x, b);
    compress(q.oy + k, s.shadow.origin.y, b);
    compress(q.oz + k, s.shadow.origin.z, b);
    compress(q.dx + k, s.shadow.direction.x, b);
    compress(q.dy + k, s.shadow.direction.y, b);
    compress(q.dz + k, s.shadow.direction.z, b);
    compress(q.distance + k, s.shadow_distance, b);
    compress(q.r + k, s.direct.x, b);
    compress(q.g + k, s.direct.y, b);
    compress(q.b + k, s.direct.z, b);
    compress(q.slot + k, slot, b);
    q.size += count(lanes);
}

// Per-ray random number for stochastic opacity; salt distinguishes the
// rays of a path: 2 * bounce, and 2 * bounce + 1 for its shadow ray.
template <class F> UInt<F> opacity_random(const UInt<F>& key, const UInt<F>& index, uint32_t salt) {
    return key ^ pcg_hash(UInt<F>(index + salt * 0x9e3779b9u));
}

template <class F> Hit<F> load_hit(const HitColumns& h, int k) {
    return {load<F>(h.t + k),
            load<F>(h.u + k),
            load<F>(h.v + k),
            load<Int<F>>(h.geometry + k),
            load<Int<F>>(h.instance + k),
            load<Int<F>>(h.triangle + k)};
}

// The same for rays of path samples that are stratified (RayArrays::index).
template <class F> UInt<F> opacity_key(const UInt<F>& key, uint32_t salt) { return key ^ pcg_hash(salt * 0x9e3779b9u + 1u); }

// The rays of a queue of paths.
struct PathRays {
    int bounce;
    bool from_camera; // else from lights
    bool coherent;    // side by side
    uint32_t mask() const { return from_camera && bounce == 0 ? camera_ray_mask : other_ray_mask; }
};
inline PathRays camera_path_rays(int bounce) { return {bounce, true, bounce == 0}; }

// Closest hits of the queue's path rays. `random` is written if some surface is blended, and `background_share` if it is set.
template <class F> void trace_rays(const KernelContext& context, Column<uint32_t>& random, const PathQueue& q, const PathRays& kind,
                                   HitColumns& h, float* background_share = nullptr) {
    const bool blends = context.scene->blends;
    if (blends)
        for (int k = 0; k < q.size; k += width<F>) store(random + k, opacity_key<F>(load<UInt<F>>(q.key + k), uint32_t(2 * kind.bounce)));
    RayArrays rays{q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, nullptr, blends ? random.data : nullptr, kind.mask()};
    if (blends) rays.index = q.index;
    const HitArrays hits{h.t, h.u, h.v, h.geometry, h.instance, h.triangle};
    if (background_share)
        context.accel->intersect_blended(rays, q.size, hits, background_share);
    else
        trace_closest<F>(*context.accel, rays, q.size, kind.coherent, hits);
}

inline RayArrays shadow_rays_of(const KernelContext& context, const ShadowQueue& q) {
    return {q.ox,           q.oy,
            q.oz,           q.dx,
            q.dy,           q.dz,
            q.distance,     context.scene->blends ? q.random.data : nullptr,
            other_ray_mask, context.scene->links.lit_sets ? q.mask.data : nullptr};
}
// Where the rays of a shadow queue lead. Objects that the camera does not see do not hide anything from it.
enum class Connects { to_lights, to_camera };
inline RayArrays connection_rays(const KernelContext& context, const ShadowQueue& q, Connects to) {
    RayArrays rays = shadow_rays_of(context, q);
    if (to == Connects::to_lights) return rays;
    rays.mask = camera_ray_mask;
    rays.masks = nullptr;
    return rays;
}

// Density, 1/sr, of lobes that focus light: that of a diffuse lobe is at most 1 / pi.
constexpr float min_focused_pdf = 1;

// Records the shadow rays of these lanes; call before they are appended to the queue.
template <class F> void record_trials(TileScratch& scratch, const Step<F>& s, const Mask<F>& lanes) {
    std::vector<ShadowTrial>& trials = *scratch.trials;
    int k = scratch.shadows.size;
    for_each_lane(bits(lanes), [&](int i) {
        scratch.shadows.trial[k++] = int32_t(trials.size());
        const Vec<F>&at = s.shadow.origin, &normal = s.next.normal;
        trials.push_back({{lane(at.x, i), lane(at.y, i), lane(at.z, i)},
                          {lane(normal.x, i), lane(normal.y, i), lane(normal.z, i)},
                          lane(s.light, i),
                          false});
    });
}

// Records the rays of the paths that are appended to the next queue.
template <class F> void record_escapes(EscapeTrials& escapes, const Path<F>& next, const Mask<F>& lanes) {
    for_each_lane(bits(lanes), [&](int i) {
        const Vec<F>&at = next.ray.origin, &to = next.ray.direction;
        escapes.all.push_back({{lane(at.x, i), lane(at.y, i), lane(at.z, i)},
                               {lane(to.x, i), lane(to.y, i), lane(to.z, i)},
                               lane(next.pdf, i) == infinity,
                               false});
    });
}

// The same for path guiding. Delta lobes cannot be guided.
template <class F> void record_guiding(GuidingTrials& guiding, const Path<F>& next, const Mask<F>& lanes) {
    for_each_lane(bits(lanes && next.pdf < F(infinity)), [&](int i) {
        const auto at = [&](const Vec<F>& v) { return Vec3{lane(v.x, i), lane(v.y, i), lane(v.z, i)}; };
        const Vec3 normal = at(next.normal), direction = at(next.ray.direction);
        const double cosine = double(max(0.f, dot(normal, direction)));
        guiding.add({at(next.ray.origin), normal, direction, 0}, lane(next.slot, i),
                    cosine / (double(lane(next.pdf, i)) * double(luminance(at(next.beta)))));
    });
}

// The same for the adjoint; smooth lobes meet no roulette. Counts the rays that have arrived in the lanes of `active`.
template <class F> void record_continuations(ContinuationTrials& trials, const Path<F>& path, const Path<F>& next, const Mask<F>& continues,
                                             const Mask<F>& active) {
    for_each_lane(bits(active), [&](int i) { trials.note_ray(lane(path.slot, i)); });
    for_each_lane(bits(continues && next.pdf < F(infinity)), [&](int i) {
        const auto at = [&](const Vec<F>& v) { return Vec3{lane(v.x, i), lane(v.y, i), lane(v.z, i)}; };
        trials.add(at(next.ray.origin), at(next.normal), lane(path.slot, i), double(luminance(at(next.beta))));
    });
}

// The same for splitting: paths that arrive at a surface, by the direction back along them.
template <class F> void record_arrivals(ContinuationTrials& trials, const Path<F>& path, const Hit<F>& hit, const Mask<F>& active) {
    for_each_lane(bits(active), [&](int i) { trials.note_ray(lane(path.slot, i)); });
    const Vec<F> at = path.ray.origin + path.ray.direction * hit.t, wo = -path.ray.direction;
    const auto of_lane = [](const Vec<F>& v, int i) { return Vec3{lane(v.x, i), lane(v.y, i), lane(v.z, i)}; };
    for_each_lane(bits(active && as_mask(hit.geometry >= 0) && !as_mask(hit.instance == sphere_instance)),
                  [&](int i) { trials.add(of_lane(at, i), of_lane(wo, i), lane(path.slot, i), double(luminance(of_lane(path.beta, i)))); });
}

// The importance of the paths' pixels, if they have one.
template <class F> void load_importance(const TileScratch& scratch, const SceneTables& scene, Path<F>& path, const Mask<F>& active) {
    if (scene.adjoint.empty()) return;
    path.importance = gather(scratch.importance->data, select(active, path.slot, Int<F>(0)));
}

// Replaces the camera rays in the queue by photons.
inline void emit_photons(PhotonTrials& photons, PathQueue& q) {
    q.size = int(photons.emitted.size());
    for (int k = 0; k < q.size; ++k) {
        const EmittedPhoton& p = photons.emitted[size_t(k)];
        q.ox[k] = p.origin.x;
        q.oy[k] = p.origin.y;
        q.oz[k] = p.origin.z;
        q.dx[k] = p.direction.x;
        q.dy[k] = p.direction.y;
        q.dz[k] = p.direction.z;
        q.beta_r[k] = q.beta_g[k] = q.beta_b[k] = p.flux;
    }
}
// Records photons that smooth lobes have sent to rough surfaces; for path guiding, only those that go on from there with the density of a
// diffuse lobe.
template <class F> void record_photons(const LightTables& lights, PhotonTrials& photons, const Path<F>& path, const Step<F>& step,
                                       int bounce, const Mask<F>& lanes) {
    const Path<F>& next = step.next;
    const Mask<F> diffuse = next.pdf <= F(1.001f * inv_pi),
                  arrived = lanes && path.pdf > F(min_focused_pdf) && diffuse && Mask<F>(bounce > 0);
    const unsigned arrived_lanes = bits(arrived), delta = bits(next.pdf == F(infinity)), crosses = bits(step.crosses),
                   internal = bits(step.internal);
    for_each_lane(bits(lanes), [&](int i) {
        const auto at = [&](const Vec<F>& v) { return Vec3{lane(v.x, i), lane(v.y, i), lane(v.z, i)}; };
        int32_t& events = photons.events[size_t(lane(path.slot, i))];
        if (arrived_lanes >> i & 1) {
            const int32_t light = photons.emitted[size_t(lane(path.slot, i))].light;
            if (!has_zero_size(lights.lights[light])) // path guiding samples directions of lights that rays can hit
                photons.arrived.push_back({at(next.ray.origin), at(next.normal), -at(path.ray.direction), luminance(at(path.beta))});
        }
        if (events > 0 && !(delta >> i & 1)) {
            const int32_t light = photons.emitted[size_t(lane(path.slot, i))].light;
            photons.chains.push_back({at(next.ray.origin), at(next.normal), at(path.ray.origin), events, light, luminance(at(path.beta))});
        }
        const int32_t count = events >> chain_count_shift;
        if (events < 0 || !(delta >> i & 1) || internal >> i & 1 || count == max_chain_events)
            events = -1;
        else
            events = (count + 1) << chain_count_shift | (events & ((1 << count) - 1)) << 1 | int32_t(crosses >> i & 1);
    });
}

// Leaves a share of the light of shadow ray k: the transmittance of blended surfaces.
inline void dim_shadow_light(TileScratch& scratch, int k, float share) {
    ShadowQueue& q = scratch.shadows;
    for (Column<float>* light : {&q.r, &q.g, &q.b}) (*light)[k] = share > 0 ? (*light)[k] * share : 0.f;
    if (scratch.trials) (*scratch.trials)[size_t(q.trial[k])].transmittance *= share;
}

// Adds the light of unoccluded shadow ray k.
inline void add_shadow_light(TileScratch& scratch, const ShadowQueue& q, int k) {
    const int slot = q.slot[k];
    scratch.r[slot] += double(q.r[k]);
    scratch.g[slot] += double(q.g[k]);
    scratch.b[slot] += double(q.b[k]);
    if (scratch.trials) (*scratch.trials)[size_t(q.trial[k])].arrived = true;
    if (scratch.groups) scratch.groups->add(q.group[k], slot, double(q.r[k]), double(q.g[k]), double(q.b[k]));
    if (scratch.strategies) add_by_strategy(*scratch.strategies, FoundBy::nee, slot, double(q.r[k]), double(q.g[k]), double(q.b[k]));
}

} // namespace blush::inline BLUSH_ISA
