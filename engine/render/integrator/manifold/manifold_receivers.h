// The receivers of manifold sampling (manifold_sampling.h): rough vertices of paths that reflect light, each with a point of a light.
#pragma once

#include "render/integrator/emission_hit.h"
#include "render/integrator/manifold/receiver_bsdf.h"
#include "render/kernels/kernel.h"
#include "shading/path_guiding.h"

#include <memory>

namespace blush::inline BLUSH_ISA {

// hit: of a path that has found the light by chance (manifold_hits.h); zero_size: no path can.
// shares: with light paths (path_chain.h). dispersed: the path carries a single wavelength.
enum ReceiverFlag : int32_t {
    receiver_infinite = 1,
    receiver_two_sided = 2,
    receiver_hit = 4,
    receiver_zero_size = 8,
    receiver_shares = 16,
    receiver_dispersed = 32
};

// Share of samples that take their light from the seeds of the whole scene.
constexpr float global_share = 0.1f;

constexpr float least_receiver_survival = 1.f / 16;
// Of the size of the light: the distance from its point at which a walk has converged.
constexpr float converged_share = 2e-3f;
// The same for lights of zero size: of the distance to the light; at infinity radians.
constexpr float converged_at_points = 2e-5f;

template <class F> Vec<F> load3(const Columns3& c, const Int<F>& i) { return {gather(c.x, i), gather(c.y, i), gather(c.z, i)}; }

// Independent random numbers in [0, 1).
template <class F> F next_random(UInt<F>& state) {
    state = state + 0x9e3779b9u;
    return unit_float<F>(pcg_hash(state));
}

// A point of a light, uniform over its area or solid angle.
template <Features S, class F>
LightPoint<F> chain_light_point(const SceneTables& scene, const Int<F>& light, const F& u, const F& v, const Mask<F>& active) {
    const LightRecord* lights = scene.lights.lights;
    const Int<F> flags = gather_field(lights, &LightRecord::flags, light);
    LightPoint<F> p = begin_light_point<F>(lights, flags, {light, F(1.f), F(0.f)}, active);
    sample_triangle_light<S, F>(scene, flags, u, v, p);
    sample_sun<S, F>(scene, u, v, p);
    if constexpr (S.has(Feature::sphere_lights)) {
        const Mask<F> sphere = has_kind(p, LightKind::sphere);
        if (any(sphere)) {
            const F radius = gather_field(lights, &LightRecord::radius, light);
            const Vec<F> normal = sample_cone(F(2.f), u, v);
            p.normal = select<F>(sphere, normal, p.normal);
            p.position = select<F>(sphere, p.position + normal * radius, p.position);
            p.density = select(sphere, F(0.25f * inv_pi) / (radius * radius), p.density);
        }
    }
    return p;
}

// The size of a light as its points are sampled: metres; at infinity radians.
template <class F> F chain_light_size(const SceneTables& scene, const LightPoint<F>& p) {
    const LightRecord* lights = scene.lights.lights;
    const F height = gather_field(lights, &LightRecord::cone_height, p.light), radius = gather_field(lights, &LightRecord::radius, p.light);
    const Mask<F> sphere = as_mask(p.kind == int32_t(LightKind::sphere));
    return select(p.infinite, sqrt(2.f * height), select(sphere, radius, 1.f / sqrt(max(p.density, F(1e-30f)))));
}

// The seeds of a region for a group of lights; the count is 0 if it has none.
template <class F> void find_segment(const ManifoldTables& t, const Int<F>& region, const Int<F>& group, const Mask<F>& active,
                                     Int<F>& first_seed, Int<F>& seeds) {
    const Int<F> first = gather_field(t.regions, &ManifoldRegion::first_segment, region),
                 segments = gather_field(t.regions, &ManifoldRegion::segments, region);
    for (int i = 0; any(active && as_mask(segments > i)); ++i) {
        const Int<F> at = first + min(Int<F>(i), Int<F>(segments - 1));
        const Mask<F> it = as_mask(gather_field(t.segments, &ManifoldSegment::group, at) == group);
        first_seed = select(it, gather_field(t.segments, &ManifoldSegment::first, at), first_seed);
        seeds = select(it, gather_field(t.segments, &ManifoldSegment::count, at), seeds);
    }
}
// Probability that a receiver selects a group; `seeds`: of its region for the group.
template <class F> F group_probability(const ManifoldTables& t, const Int<F>& region, const Int<F>& group, const Int<F>& seeds) {
    const F of_own = to_float(seeds) / to_float(gather_field(t.regions, &ManifoldRegion::count, region));
    return (1.f - global_share) * of_own + global_share * gather_field(t.groups, &ManifoldGroup::share, group);
}

// Where receivers find seeds for a group of lights, and the probability with which they select it.
template <class F> struct GroupSeeds {
    Int<F> first, count;
    F probability;
};
template <class F> GroupSeeds<F> seeds_of_group(const ManifoldTables& t, const Int<F>& region, const Int<F>& group, const Mask<F>& active) {
    GroupSeeds<F> s{Int<F>(0), Int<F>(0), F(0.f)};
    find_segment<F>(t, region, group, active, s.first, s.count);
    s.probability = group_probability<F>(t, region, group, s.count);
    return s;
}
template <class F> Int<F> region_at(const ManifoldTables& t, const Vec<F>& origin, const Vec<F>& ns, const Mask<F>& active) {
    return gather(t.regions_of_cell, select(active, guiding_cell<F>(t.grid, origin, ns), Int<F>(0)));
}

// Density with which the path has reached this Lambertian vertex from another one before, where that connects to light vertices
// (light_vertices.h): 1/m^2; else 0.
template <class F> F arrival_density(const SceneTables& scene, const Path<F>& path, const ReuseVertex<F>& v) {
    if (scene.light_vertices.empty()) return F(0.f);
    const Vec<F> way = v.position - path.ray.origin;
    const F density = path.pdf * abs(dot(v.ng, path.ray.direction)) / max(dot(way, way), F(1e-30f));
    const Mask<F> connects = v.lambertian && chain_begins<F>(path.chain) && has_flag<F>(path.chain, begins_lambertian) &&
                             !has_flag<F>(path.chain, shares_chains);
    return select(connects, density, F(0.f));
}

// MIS weight of light vertices beside manifold sampling. `arrival`: as above; `ratio`: LightVertexColumns::ratio.
template <class F> F light_vertex_weight(const SceneTables& scene, const F& arrival, const F& ratio) {
    return 1.f / (1.f + arrival * ratio * scene.light_vertices.walk_share);
}
// Probability that walks begin at a vertex: light vertices find most of the light of those with a low density.
template <class F> F receiver_survival(const SceneTables& scene, const F& arrival) {
    const F odds = arrival * (scene.light_vertices.usual_ratio * scene.light_vertices.walk_share);
    return select(arrival > F(0.f), min(max(odds, F(least_receiver_survival)), F(1.f)), F(1.f));
}

// Path::light_ratio behind a vertex, but for the density of the direction in which the path leaves it and, where the vertex is not
// Lambertian, ReceiverBsdf::reverse.
template <class F> F light_ratio_behind(const Path<F>& path, const ReuseVertex<F>& v) {
    const Vec<F> wo = -path.ray.direction;
    const F reverse = select(v.lambertian, cosine_hemisphere_pdf(max(dot(v.ns, wo), F(0.f))), F(1.f));
    return path.light_ratio * reverse / clamped_cosine<F>(v.ng, wo);
}
// Width of the texture filter where the path has met a surface: metres.
template <Features S, class F> F receiver_width(const KernelContext& context, const Path<F>& path, const Hit<F>& hit) {
    if constexpr (S.has(Feature::textures)) return cone_width<F>(context.scene->camera, context.settings, path, hit.t);
    return F(0.f);
}

// A receiver and its point of a light.
template <class F> struct ChainReceiver {
    Vec<F> origin, ns, ng, reflected;
    LightPoint<F> light;
    Int<F> slot;
    GroupSeeds<F> seeds;
    F density; // of the point
    UInt<F> random;
    F light_ratio, arrival;
    Int<F> wavelength;
    Mask<F> dispersed;
};
// Queues the receivers of `lanes`.
template <Features S, class F>
void append_receivers(const SceneTables& scene, ManifoldColumns& c, const ChainReceiver<F>& receiver, const Mask<F>& queued) {
    const LightPoint<F>& p = receiver.light;
    const Vec<F> to = p.position - receiver.origin;
    const F distance = select(p.infinite, F(1.f), sqrt(dot(to, to)));
    const Mask<F> zero_size = is_zero_size<F>(scene.lights, p.light);
    const F of_size = chain_light_size<F>(scene, p) * converged_share;
    const F tolerance = select(zero_size, distance * converged_at_points, max(of_size, F(distance * 2e-6f)));
    const unsigned lanes = bits(queued);
    const int k = c.size;
    const auto put_all = [&](Columns3& column, const Vec<F>& vector) {
        compress(column.x + k, vector.x, lanes);
        compress(column.y + k, vector.y, lanes);
        compress(column.z + k, vector.z, lanes);
    };
    put_all(c.origin, receiver.origin);
    put_all(c.ns, receiver.ns);
    put_all(c.ng, receiver.ng);
    put_all(c.reflected, receiver.reflected);
    put_all(c.emission, p.emission);
    compress(c.density + k, receiver.density, lanes);
    compress(c.arrival + k, receiver.arrival, lanes);
    compress(c.clearcoat + k, p.clearcoat, lanes);
    put_all(c.target, p.position);
    put_all(c.target_normal, p.normal);
    compress(c.tolerance + k, tolerance, lanes);
    compress(c.slot + k, receiver.slot, lanes);
    compress(c.light + k, p.light, lanes);
    if constexpr (S.has(Feature::dispersion)) compress(c.wavelength + k, receiver.wavelength, lanes);
    const Mask<F> shares = Mask<F>(!scene.emission.empty()) && receiver.light_ratio > F(0.f);
    compress(c.kind + k,
             select(shares, Int<F>(receiver_shares), Int<F>(0)) | select(receiver.dispersed, Int<F>(receiver_dispersed), Int<F>(0)) |
                 select(p.infinite, Int<F>(receiver_infinite), Int<F>(0)) | select(p.two_sided, Int<F>(receiver_two_sided), Int<F>(0)) |
                 select(zero_size, Int<F>(receiver_zero_size), Int<F>(0)),
             lanes);
    compress(c.first_seed + k, receiver.seeds.first, lanes);
    compress(c.seeds + k, receiver.seeds.count, lanes);
    compress(c.random + k, receiver.random, lanes);
    if (c.measures || !scene.emission.empty()) compress(c.light_ratio + k, receiver.light_ratio, lanes);
    c.size += count(queued);
}

// Queues the rough vertices of these paths, each with a point of a light.
template <Features S, class F> [[gnu::noinline, gnu::flatten]] void add_receivers(const KernelContext& context, TileScratch& scratch,
                                                                                  const Path<F>& path, const Hit<F>& hit,
                                                                                  const Step<F>& step, int bounce, const Mask<F>& active) {
    const ReuseVertex<F>& v = step.reuse_vertex;
    if (bounce + 1 >= context.settings.max_bounces) return;
    const Mask<F> begins = active && v.begins_chains && starts_chains<S, F>(*context.scene, path, bounce);
    if (!any(begins)) return;
    const SceneTables& scene = *context.scene;
    const ManifoldTables& t = scene.manifolds;
    ManifoldColumns& c = *scratch.manifolds;

    UInt<F> random = pcg_hash(UInt<F>(path.key ^ pcg_hash(UInt<F>(path.index + uint32_t(bounce) * 0x68e31da4u))));
    const Vec<F> origin = offset_origin(v.position, v.ng * v.clearance);
    const F arrival = arrival_density<F>(scene, path, v), q = receiver_survival<F>(scene, arrival);
    const Mask<F> tried = begins && next_random<F>(random) < q;
    if (!any(tried)) return;
    const Int<F> own = region_at<F>(t, origin, v.ns, tried);
    // The group of lights.
    const Int<F> region = select(next_random<F>(random) < F(global_share), Int<F>(0), own);
    const auto pick = [](const F& u, const Int<F>& n) { return min(to_int(F(u * to_float(n))), Int<F>(n - 1)); };
    const Int<F> seed = gather_field(t.regions, &ManifoldRegion::first, region) +
                        pick(next_random<F>(random), gather_field(t.regions, &ManifoldRegion::count, region));
    const Int<F> group = gather_field(t.segments, &ManifoldSegment::group, gather_field(t.seeds, &ManifoldSeed::segment, seed));
    const GroupSeeds<F> seeds = seeds_of_group<F>(t, own, group, tried);

    // The point of the light.
    const Int<F> lights = gather_field(t.groups, &ManifoldGroup::lights, group);
    const Int<F> light = gather_field(t.groups, &ManifoldGroup::first_light, group) + pick(next_random<F>(random), lights);
    const Pair<F> place = Sampler<F>{path.key ^ 0x5ca1ab1eu, path.index}.pair(uint32_t(bounce));
    const LightPoint<F> p = chain_light_point<S, F>(scene, select(tried, light, Int<F>(0)), place.x(), place.y(), tried);
    const F density = seeds.probability * p.density / to_float(lights);
    const Mask<F> queued = tried && p.valid && density > F(0.f) && shares_chains_to<F>(scene, path, p.light);
    if (!any(queued)) return;
    Int<F> wavelength = Int<F>(0);
    Mask<F> dispersed = Mask<F>(false);
    if constexpr (S.has(Feature::dispersion)) {
        wavelength = wavelength_step<F>(Sampler<F>{path.key, path.index});
        dispersed = as_mask(path.dispersed != 0);
    }
    const F footprint = receiver_width<S, F>(context, path, hit);
    int to = c.size;
    for_each_lane(bits(queued), [&](int i) { keep_receiver_hit<F>(c.at, to++, i, path, hit, footprint, v.lambertian); });
    const Vec<F> reflected = step.weights.arriving * select<F>(v.lambertian, v.reflectance * inv_pi, splat<F>(1.f)) * (1.f / q);
    append_receivers<S, F>(scene, c,
                           {origin, v.ns, v.ng, reflected, p, path.slot, seeds, density, random, light_ratio_behind<F>(path, v), arrival,
                            wavelength, dispersed},
                           queued);
}

} // namespace blush::inline BLUSH_ISA
