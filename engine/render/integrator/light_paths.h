// Light paths, traced as a wavefront: from the lights through the scene, each vertex connected to the camera (t = 1; Veach 1997, section
// 10.2, there "light tracing"). Weights: light_path_weights.h; emission: light_emission.h.
#pragma once

#include "render/integrator/manifold/shared_chains.h"
#include "render/integrator/path_queues.h"
#include "render/integrator/scatter_stages.h"
#include "render/integrator/splat_pixel.h"
#include "render/integrator/thin_transmission.h"
#include "shading/adjoint.h"

#include <algorithm>
#include <utility>

namespace blush::inline BLUSH_ISA {

// Dimensions of the sampler of a light path, in pairs: those of its emission (light_path_emission.h), then three for each vertex.
constexpr uint32_t first_light_vertex_dimension = 4;
enum LightVertexDimension : uint32_t { light_bsdf_dimension, light_choice_dimension, light_lens_dimension, dimensions_per_light_vertex };

// Paths leave their lights side by side, and so they meet the first surfaces.
constexpr int coherent_light_bounces = 3;
inline PathRays light_path_rays(int bounce) { return {bounce, false, bounce < coherent_light_bounces}; }

// The camera as a point `from` sees it.
template <class F> struct CameraConnection {
    Vec<F> to;     // unit
    F distance;    // metres; the connection ends at the camera
    F x, y;        // image position in pixels
    F density;     // camera_density()
    Mask<F> valid; // in the image's plane; the position may be outside of the image
};
template <Features S, class F> CameraConnection<F> connect_camera(const CameraRecord& camera, const EstimatorSettings& settings,
                                                                  const Vec<F>& from, const F& lens_u, const F& lens_v) {
    const Vec<F> forward = splat<F>(camera.forward);
    CameraConnection<F> c;
    const Vec<F> from_eye = from - splat<F>(camera.position);
    Vec<F> lateral; // in the plane that is the image's at distance 1 from the eye
    if (camera.orthographic) {
        c.to = -forward;
        c.distance = dot(from_eye, forward);
        lateral = from_eye - forward * c.distance;
        c.valid = c.distance > F(0.f);
    } else {
        Vec<F> shift = splat<F>(0.f);
        if constexpr (S.has(Feature::thin_lens))
            if (camera.aperture_radius > 0) {
                const Vec2T<F> lens = sample_disk(lens_u, lens_v) * F(camera.aperture_radius);
                shift = splat<F>(normalize(camera.right)) * lens.x + splat<F>(normalize(camera.up)) * lens.y;
            }
        const Vec<F> ray = from_eye - shift;
        c.distance = length(ray);
        c.to = ray * (-1.f / max(c.distance, F(1e-30f)));
        const F depth = dot(ray, forward);
        c.valid = depth > F(0.f);
        // Where the ray from the lens crosses the plane in focus, as seen from the eye.
        const F focus = F(camera.aperture_radius > 0 ? camera.focus_distance : 1.f);
        lateral = (shift + ray * (focus / select(c.valid, depth, F(1.f)))) * (1.f / focus) - forward;
    }
    const Vec3 right = camera.right * (1 / dot(camera.right, camera.right)), up = camera.up * (1 / dot(camera.up, camera.up));
    c.x = (dot(lateral, splat<F>(right)) + 1.f) * (0.5f * settings.width);
    c.y = (1.f - dot(lateral, splat<F>(up))) * (0.5f * settings.height);
    c.density = camera_density<F>(camera, settings, -c.to, c.distance);
    // Within the reach of the pixel filter; not NaN.
    c.valid = c.valid && c.x > F(-2.f) && c.x < F(settings.width + 2) && c.y > F(-2.f) && c.y < F(settings.height + 2);
    return c;
}

// A vertex of a light path: `side.wo` is the direction towards the vertex before.
template <class F> struct LightPathVertex : ShadedHit<F> {
    F cosine;                                 // between wo and the geometric normal, > 0
    F scatter_share = F(1.f);                 // share_beside_straight()
    F hit_ratio = F(0.f), nee_ratio = F(0.f); // nee_ratio: at the first vertex that of NEE there, so without the factor of the vertex
    Mask<F> nee_alone = Mask<F>(false);       // NEE alone finds what this first vertex scatters by other than delta lobes
};
// Where the path meets a surface, in the lanes of `met`. `seen`: the vertex is connected to the camera.
template <Features S, class F>
[[gnu::always_inline]] inline LightPathVertex<F> light_vertex_at(const SceneTables& scene, const EstimatorSettings& settings,
                                                                 const Path<F>& path, const Hit<F>& hit, const Mask<F>& met, bool seen) {
    // Textures are filtered as the camera sees them, but for those of panes (pane_width) and behind rough lobes (ray_cone.h).
    const Vec<F> to_eye = path.ray.origin + path.ray.direction * hit.t - splat<F>(scene.camera.position);
    const float cone = seen ? camera_cone(scene.camera, settings) : 0.f;
    F footprint = scene.camera.orthographic ? F(cone) : F(length(to_eye) * cone);
    if constexpr (S.has(Feature::transmission) && S.has(Feature::textures))
        if (scene.panes) footprint = select(is_pane<S, F>(scene, hit, met), F(0.f), footprint);
    LightPathVertex<F> v{shade_hit<S, F>(scene, settings.energy, path, hit, met, footprint), F(0.f)};
    v.cosine = clamped_cosine<F>(v.shading.ng, v.side.wo);
    v.scatter_share = share_beside_straight<S, F>(scene, v.material, v.bsdf, v.shading.wo);
    return v;
}
// Weight of a sample of a delta lobe: what it leaves of the light that passes it. `cosine`: between wi and the geometric normal; `choice`:
// of the lobe.
template <Features S, class F> [[gnu::always_inline]] inline Vec<F> delta_light_weight(const LightPathVertex<F>& v, const BsdfSample<F>& s,
                                                                                       const F& cosine, const F& choice) {
    return s.weight * (cosine / v.cosine * delta_adjoint<S, F>(v.bsdf, v.material.bsdf.layers, v.shading.wo, s.wi, choice));
}

// The lights of paths k, k + 1, ... before their first vertex.
template <class F> Int<F> emitters(const LightPathColumns& columns, int k, const Mask<F>& lanes) {
    alignas(64) int32_t light[width<F>]{};
    for_each_lane(bits(lanes), [&](int i) { light[i] = columns.emitted[size_t(k + i)].light; });
    return load<Int<F>>(light);
}

// Density with which NEE at the first vertex samples the point of the light, over projected solid angle.
template <Features S, class F>
F nee_density(const SceneTables& scene, const LightPathColumns& columns, int k, const LightPathVertex<F>& v, const Mask<F>& lanes) {
    alignas(64) float x[width<F>]{}, y[width<F>]{}, z[width<F>]{}, nx[width<F>]{}, ny[width<F>]{}, nz[width<F>]{};
    for_each_lane(bits(lanes), [&](int i) {
        const EmittedPath& e = columns.emitted[size_t(k + i)];
        x[i] = e.light_position.x, y[i] = e.light_position.y, z[i] = e.light_position.z;
        nx[i] = e.light_normal.x, ny[i] = e.light_normal.y, nz[i] = e.light_normal.z;
    });
    const Vec<F> position{load<F>(x), load<F>(y), load<F>(z)}, normal{load<F>(nx), load<F>(ny), load<F>(nz)};
    const auto at = emission_point<S, F>(scene, emitters<F>(columns, k, lanes), position, normal, v.side.wo, lanes);
    Receiver<F> to{v.surface.position, v.shading.ns};
    to.normal = select<F>(v.material.bsdf.transmission > F(0.f), splat<F>(0.f), to.normal);
    to.normal = select<F>(v.material.bsdf.layers.diffuse_transmission > F(0.f), splat<F>(0.f), to.normal);
    return nee_pdf<S, F>(scene, to, at, lanes) / v.cosine;
}

// Queues the connection of a vertex behind the first to the camera: radiance, as a share of one light path's flux, with its MIS weight.
template <Features S, class F> [[gnu::noinline, gnu::flatten]] void
connect_vertex(const KernelContext& context, TileScratch& scratch, const Path<F>& path, const LightPathVertex<F>& v, int bounce) {
    const SceneTables& scene = *context.scene;
    const Mask<F> connectable = v.scatters && !is_delta_only<F>(v.bsdf);
    if (!any(connectable)) return;
    const uint32_t dimension = first_light_vertex_dimension + dimensions_per_light_vertex * uint32_t(bounce) + light_lens_dimension;
    Pair<F> lens{UInt<F>(0u), UInt<F>(0u)};
    if (scene.camera.aperture_radius > 0) lens = Sampler<F>{path.key, path.index}.pair(dimension);
    // The side of the camera decides on which side the ray begins.
    const CameraConnection<F> rough = connect_camera<S, F>(scene.camera, context.settings, v.surface.position, lens.x(), lens.y());
    const Vec<F> from = offset_origin(v.surface.position, v.surface.error, v.shading.ng, dot(rough.to, v.shading.ng) > F(0.f));
    const CameraConnection<F> c = connect_camera<S, F>(scene.camera, context.settings, from, lens.x(), lens.y());
    const Mask<F> seen_by_camera = connectable && c.valid;
    if (!any(seen_by_camera)) return;
    const ViewedPoint<F> view =
        view_point<S, F>(scene, context.settings.energy, v.surface, v.material, v.bsdf, c.to, v.side.wo, true, seen_by_camera);
    const F per_path = c.density * clamped_cosine<F>(v.shading.ng, c.to) * (1.f / scene.emission.paths);
    Vec<F> value = v.beta * view.value.f_cos * (per_path / v.cosine);
    if constexpr (S.has(Feature::transmission))
        if (scene.panes) value = value * (1.f / max(v.scatter_share, F(0x1p-24f)));
    const F seen = view.pdf / v.cosine;
    const F hit = v.hit_ratio * seen * per_path, nee = v.nee_ratio * seen * per_path;
    F weight = 1.f / (1.f + hit * hit + nee * nee);
    if (const Mask<F> shared = seen_by_camera && has_flag<F>(path.chain, shares_chains); samples_manifolds<S>(scene) && any(shared))
        weight = select(shared, weight_of_shared_chains<F>(*scratch.light_vertices, path, hit, shared), weight);
    const Mask<F> connects = seen_by_camera && has_light(value);
    if (!any(connects)) return;
    Step<F> step;
    step.shadow = {from, c.to};
    step.shadow_distance = c.distance * (1.f - 4e-7f);
    step.direct = value * weight;
    LightPathColumns& columns = *scratch.light_paths;
    if (columns.measures) compress(columns.others + scratch.shadows.size, min(F(sqrt(hit * hit + nee * nee)), F(1e18f)), bits(connects));
    compress(columns.x + scratch.shadows.size, c.x, bits(connects));
    compress(columns.y + scratch.shadows.size, c.y, bits(connects));
    if (scene.blends)
        compress(scratch.shadows.random + scratch.shadows.size, opacity_random<F>(path.key, path.index, uint32_t(2 * bounce + 1)),
                 bits(connects));
    append<F>(scratch.shadows, step, path.slot, connects);
}

// Appends the path behind the vertex. `all_lobes`: it goes on by all lobes of its first surface, else by those that it shares with NEE.
template <Features S, class F>
[[gnu::noinline, gnu::flatten]] void continue_light_path(const KernelContext& context, const Path<F>& path, const LightPathVertex<F>& v,
                                                         int bounce, bool all_lobes, TileScratch& scratch, PathQueue& next, int queue) {
    const EstimatorSettings& settings = context.settings;
    const Sampler<F> sampler{path.key, path.index};
    const uint32_t dimension = first_light_vertex_dimension + dimensions_per_light_vertex * uint32_t(bounce);
    const Pair<F> direction = sampler.pair(dimension + light_bsdf_dimension), choice = sampler.pair(dimension + light_choice_dimension);
    F lobe = choice.x();
    if constexpr (S.has(Feature::transmission))
        if (context.scene->panes) lobe = lobe * v.scatter_share;
    const BsdfSample<F> s = sample_beside_straight<S, F>(*context.scene, v.bsdf, v.shading.wo, v.material.pane, lobe, direction);
    const Vec<F> wi = normalize(v.shading.frame.to_world(s.wi));
    const Mask<F> outward = dot(wi, v.shading.ng) > F(0.f);
    const F cosine = clamped_cosine<F>(v.shading.ng, wi);

    // Light flows against the camera's paths: the BSDF is that seen from wi, and the cosines are the geometric ones (Veach 1997, 5.3).
    Vec<F> beta = splat<F>(0.f);
    F hit_ratio = v.hit_ratio, nee_ratio = bounce == 0 ? F(0.f) : v.nee_ratio;
    const Mask<F> dense = v.scatters && !s.delta;
    Mask<F> begins_chains = Mask<F>(false); // of the camera,
    F chain_pdf = F(0.f);                   // whose direction has this density
    Mask<F> shared = Mask<F>(true);         // at the first surface: with NEE (facet_share)
    if (any(dense)) {
        const ViewedPoint<F> view =
            view_point<S, F>(*context.scene, settings.energy, v.surface, v.material, v.bsdf, wi, v.side.wo, true, dense);
        F share = F(1.f);
        if (bounce == 0 && !all_lobes) {
            share = facet_share<S, F>(v.bsdf, s.wi, s.pdf);
            shared = !dense || sampler.pair(dimension + light_lens_dimension).x() < share; // its lens is not sampled
        }
        const F seen = view.pdf / v.cosine, forward = share * s.pdf / cosine;
        const F factor = seen / max(forward, F(1e-30f));
        beta = view.value.f_cos * (1.f / (v.cosine * max(forward, F(1e-30f))));
        begins_chains = dense && only_reflects<S, F>(v.bsdf, v.material.bsdf) && !view.behind;
        chain_pdf = view.value.pdf;
        hit_ratio = select(dense, v.hit_ratio * factor, hit_ratio);
        nee_ratio = select(dense, bounce == 0 ? F(v.nee_ratio / max(forward, F(1e-30f))) : F(v.nee_ratio * factor), nee_ratio);
    }
    beta = select<F>(dense, beta, delta_light_weight<S, F>(v, s, cosine, lobe)) * v.beta;

    const Mask<F> same_side = (s.wi.z > F(0.f)) == outward;
    Mask<F> continues = v.scatters && s.valid && same_side && has_light(beta) && is_finite(F(beta.x + beta.y + beta.z)) && shared;
    if (bounce == 0) continues = continues && (s.delta || !v.nee_alone);
    Int<F> chain = Int<F>(0);
    if (samples_manifolds<S>(*context.scene)) {
        const Mask<F> crosses = outward != (dot(v.side.wo, v.shading.ng) > F(0.f)),
                      internal = reflects_partly_within<S, F>(v.side, v.bsdf, crosses);
        const ChainEvent<F> event{s.delta, crosses, internal, has_chains<F>(*context.scene, v.surface.material), begins_chains};
        if (const Mask<F> lit = v.scatters && is_lit_by_chain<F>(path.chain, event); any(lit))
            keep_lit_vertices<F>(*scratch.light_vertices, path, v.surface, v.shading, v.side.wo, chain_pdf, lit);
        chain = next_light_chain<F>(path.chain, event);
    }
    if (bounce + 1 >= settings.roulette.start && settings.roulette.rule != Roulette::Rule::off) {
        const Mask<F> applied = dense || Mask<F>(bounce + 1 >= first_rr_bounce_at_delta);
        const F q = select(applied, survival_probability(settings.roulette, beta), F(1.f));
        continues = continues && !(choice.y() >= q);
        beta = beta / max(q, F(1e-30f));
    }
    Path<F> p = path;
    p.ray = {offset_origin(v.surface.position, v.surface.error, v.shading.ng, outward), wi};
    p.beta = beta;
    p.chain = chain;
    const unsigned lanes = bits(continues);
    if constexpr (S.has(Feature::dispersion)) compress(next.dispersed + next.size, select(v.dispersed, Int<F>(1), Int<F>(0)), lanes);
    compress(scratch.light_paths->hit_ratio[queue] + next.size, min(hit_ratio, F(1e30f)), lanes);
    compress(scratch.light_paths->nee_ratio[queue] + next.size, min(nee_ratio, F(1e30f)), lanes);
    append<S, F>(next, p, continues);
}

// Shades the hits of `now`, which is the queue of number 1 - `queue`; survivors go to `next`.
template <Features S, class F> [[gnu::flatten]] void shade_light_paths(const KernelContext& context, TileScratch& scratch,
                                                                       const PathQueue& now, PathQueue& next, int queue, int bounce) {
    const SceneTables& scene = *context.scene;
    const EstimatorSettings& settings = context.settings;
    LightPathColumns& columns = *scratch.light_paths;
    next.size = 0;
    scratch.shadows.size = 0;
    for (int k = 0; k < now.size; k += width<F>) {
        Path<F> path = load_path<S, F>(now, k);
        if constexpr (S.has(Feature::dispersion)) path.dispersed = load<Int<F>>(now.dispersed + k);
        const Mask<F> active = as_mask(iota<F>() + k < now.size);
        const Hit<F> hit = load_hit<F>(scratch.hits, k);
        const Mask<F> met = active && as_mask(hit.geometry >= 0) && !as_mask(hit.instance == sphere_instance);
        if (!any(met)) continue;
        LightPathVertex<F> v = light_vertex_at<S, F>(scene, settings, path, hit, met, bounce > 0);
        if (bounce == 0) {
            v.scatters = v.scatters && !is_lambertian<S, F>(v.bsdf);
            v.nee_alone = Mask<F>(scene.emission.alone);
            if constexpr (S.has(Feature::links))
                if (scene.links.lit_sets) {
                    const Int<F> light = emitters<F>(columns, k, met);
                    v.scatters = v.scatters && is_lit<F>(scene.links, light, v.surface.part, met);
                    v.nee_alone = v.nee_alone || has_own_shadows<F>(scene.links, light, met);
                }
            if (!any(v.scatters)) continue;
            alignas(64) float densities[width<F>]{}, hits[width<F>]{};
            for_each_lane(bits(v.scatters), [&](int i) {
                const EmittedPath& e = columns.emitted[size_t(k + i)];
                densities[i] = 1 / e.density;
                hits[i] = e.delta ? 0 : densities[i];
            });
            v.hit_ratio = load<F>(hits);
            if (const Mask<F> lit = v.scatters && !is_delta_only<F>(v.bsdf); any(lit))
                v.nee_ratio = select(lit, load<F>(densities) * nee_density<S, F>(scene, columns, k, v, lit), F(0.f));
        } else {
            v.hit_ratio = load<F>(columns.hit_ratio[1 - queue] + k);
            v.nee_ratio = load<F>(columns.nee_ratio[1 - queue] + k);
        }
        if (bounce > 0) connect_vertex<S, F>(context, scratch, path, v, bounce);
        if (bounce + 1 < settings.max_bounces) continue_light_path<S, F>(context, path, v, bounce, false, scratch, next, queue);
    }
}

// Traces the rays of light paths. In scenes with panes, overwrites `rest`.
template <Features S, class F>
void trace_light_rays(const KernelContext& context, TileScratch& scratch, PathQueue& now, PathQueue& rest, int bounce) {
    const PathRays rays = light_path_rays(bounce);
    trace_rays<F>(context, scratch.random, now, rays, scratch.hits);
    if constexpr (S.has(Feature::transmission))
        if (context.scene->panes) trace_through_panes<S, F>(context, scratch, now, rest, rays);
}

// Adds the splats of the connections that reach the camera.
template <Features S, class F> void add_splats(const KernelContext& context, TileScratch& scratch, int bounce) {
    connect_rays<S, F>(context, scratch, Connects::to_camera, false, [&](int k) { add_splat(context, bounce, scratch, k); });
}

// Light paths of the tile: see LightPathColumns.
template <Features S, class F> void trace_light_paths(const KernelContext& context, TileScratch& scratch) {
    LightPathColumns& columns = *scratch.light_paths;
    PathQueue* now = &scratch.paths[0];
    PathQueue* next = &scratch.paths[1];
    begin_light_paths(columns, *now);
    begin_light_chains<S>(*context.scene, scratch, *now);
    int queue = 0; // number of `now`
    for (int bounce = 0; now->size > 0 && bounce < context.settings.max_bounces; ++bounce) {
        if (bounce > max_path_length) {
            scratch.truncated_paths += now->size;
            break;
        }
        scratch.bounce_rays += now->size;
        trace_light_rays<S, F>(context, scratch, *now, *next, bounce);
        queue = 1 - queue;
        shade_light_paths<S, F>(context, scratch, *now, *next, queue, bounce);
        scratch.shadow_rays += scratch.shadows.size;
        if (scratch.shadows.size > 0) add_splats<S, F>(context, scratch, bounce);
        weigh_shared_chains<S, F>(context, scratch, *next, *now);
        std::swap(now, next);
    }
}

} // namespace blush::inline BLUSH_ISA
