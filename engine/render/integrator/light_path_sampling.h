// Samples how light paths leave the lights: a pair of a light and a caster, a point of the light, and a direction (light_emission.h).
#pragma once

#include "core/distribution.h"
#include "core/sampler.h"
#include "render/integrator/light_path_weights.h"
#include "render/integrator/light_sampling.h"
#include "render/kernels/light_path_columns.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace blush {

// Replaces `sorted` by the paths that the lower halves of `order` number, in its ascending order. Not a template, which kernels for
// different instruction sets would share.
void sort_paths(std::vector<uint64_t>& order, const std::vector<EmittedPath>& paths, std::vector<EmittedPath>& sorted);

} // namespace blush

namespace blush::inline BLUSH_ISA {

// The first pairs of dimensions of the sampler of a light path. The next are those of its vertices (light_paths.h).
enum LightEmissionDimension : uint32_t { emission_pair_dimension, emission_point_dimension, emission_direction_dimension };

// Random numbers of an emission: choose the light and its caster, the point of the light, and the direction.
template <class F> struct EmissionRandom { Pair<F> pair, point, direction; };
template <class F> EmissionRandom<F> emission_random(const Sampler<F>& sampler) {
    return {sampler.pair(emission_pair_dimension), sampler.pair(emission_point_dimension), sampler.pair(emission_direction_dimension)};
}

// EmittedPath in lanes.
template <class F> struct Emission {
    Vec<F> origin, direction, light_position, light_normal, flux;
    F density;
    Int<F> light;
    UInt<F> place;
    Mask<F> infinite, delta;
};

// A point of the light of `p`, uniform over its area or the directions of its disk; of the environment, with the density of its map.
template <class F> void sample_point_of_light(const SceneTables& scene, const Int<F>& flags, const Pair<F>& random, LightPoint<F>& p) {
    const F u = random.x(), v = random.y();
    if (const Mask<F> sphere = has_kind(p, LightKind::sphere); any(sphere)) {
        const F radius = gather_field(scene.lights.lights, &LightRecord::radius, p.light);
        const F size = max_component(abs(p.position)) + radius;
        p.normal = select<F>(sphere, sample_cone(F(2.f), u, v), p.normal);
        p.position = select<F>(sphere, p.position + p.normal * radius, p.position);
        p.error = select<F>(sphere, splat<F>(1.f) * (size * gamma_bound(16)), p.error);
    }
    sample_triangle_light<all_features, F>(scene, flags, u, v, p);
    p.delta = has_kind(p, LightKind::point);
    sample_sun<all_features, F>(scene, u, v, p);
    sample_environment_light<all_features, F>(scene, u, random.bits_y, Mask<F>(true), p);
}

// A direction from the light to the caster; in the lanes of `even`, or if the point is inside of the caster's sphere, with the density of
// the cosine.
template <class F>
Vec<F> sample_emitted_direction(const LightPoint<F>& p, const Vec<F>& center, const F& radius, const Mask<F>& even, const Pair<F>& random) {
    const F u = random.x(), v = random.y();
    const Vec<F> to = center - p.position;
    const F height = sphere_cone_height(dot(to, to), radius);
    const Mask<F> aims = !even && height > F(0.f), two_sided = p.two_sided && has_kind(p, LightKind::triangle);
    const Mask<F> back = two_sided && u >= F(0.5f);
    const F from_side = select(two_sided, 2.f * u - select(back, F(1.f), F(0.f)), u);
    const Vec<F> around = basis_around(select<F>(back, -p.normal, p.normal)).to_world(sample_cosine_hemisphere(from_side, v));
    const Vec<F> anywhere = select<F>(p.delta, sample_cone(F(2.f), u, v), around);
    return select<F>(aims, basis_around(normalize(to)).to_world(sample_cone(height, u, v)), anywhere);
}

// Orders rays to one caster: near numbers for rays that reach its sphere side by side (Morton order of 32^3 cells).
template <class F>
UInt<F> place_of(const Int<F>& target, const Vec<F>& center, const F& radius, const Vec<F>& origin, const Vec<F>& direction) {
    const F along = max(dot(center - origin, direction), radius);
    const Vec<F> at = (origin + direction * along - center) * (0.5f / radius);
    const auto cell = [](const F& x) { return to_unsigned(to_int(min(max(F((x + 0.5f) * 32.f), F(0.f)), F(31.f)))); };
    const UInt<F> x = cell(at.x), y = cell(at.y), z = cell(at.z);
    UInt<F> place = to_unsigned(target);
    for (int bit = 4; bit >= 0; --bit) place = place << 3 | (x >> bit & 1u) << 2 | (y >> bit & 1u) << 1 | (z >> bit & 1u);
    return place;
}

// One light path in each lane. Those without a density do not exist.
template <class F> [[gnu::noinline, gnu::flatten]] Emission<F> emit_path(const SceneTables& scene, const EmissionTables& emission,
                                                                         const EmissionRandom<F>& random) {
    const LightRecord* lights = scene.lights.lights;
    const int32_t casters = emission.casters.count, columns = casters + 1;
    const Int<F> pair = sample_discrete<F>(emission.thresholds, Int<F>(0), emission.lights * columns, random.pair.bits_x).index;
    // The division of integers, which lanes lack: pairs are fewer than 2^21, so the quotient is right.
    const Int<F> light = to_int(F((to_float(pair) + 0.5f) / float(columns))), target = pair - light * columns;
    const Mask<F> even = as_mask(target == casters);
    Vec<F> center = splat<F>(emission.scene.center);
    F radius = F(emission.scene.radius);
    if (casters > 0) {
        const Int<F> k = min(target, Int<F>(casters - 1));
        center = select<F>(even, center, gather_field3<F>(emission.casters.spheres, &CasterSphere::center, k));
        radius = select(even, radius, gather_field(emission.casters.spheres, &CasterSphere::radius, k));
    }
    const Int<F> flags = gather_field(lights, &LightRecord::flags, light);
    LightPoint<F> p = begin_light_point<F>(lights, flags, {light, F(1.f), F(0.f)}, Mask<F>(true));
    sample_point_of_light<F>(scene, flags, random.point, p);

    const Vec<F> away = sample_emitted_direction<F>(p, center, radius, even, random.direction);
    const Vec<F> wi = select<F>(p.infinite, p.position, -away);
    Vec<F> origin = select<F>(p.delta, p.position, offset_origin(p.position, p.error, p.normal, dot(wi, p.normal) < F(0.f)));
    if (any(p.infinite)) {
        const Vec2T<F> disk = sample_disk(random.direction.x(), random.direction.y());
        Vec<F> from = center + basis_around(wi).to_world(Vec<F>{disk.x, disk.y, F(0.f)}) * radius;
        // Begins before the scene, as far as it has to.
        const Vec<F> to_end = splat<F>(emission.scene.center) - from;
        from = from + wi * (dot(to_end, wi) + 1.01f * emission.scene.radius);
        origin = select<F>(p.infinite, from, origin);
    }
    Emission<F> path{origin, -wi, p.position, p.normal, splat<F>(0.f), F(0.f), light, {}, p.infinite, p.delta};
    path.place = place_of<F>(target, center, radius, origin, path.direction);
    const auto point =
        emission_point<all_features, F>(scene, light, select<F>(p.infinite, origin, p.position), p.normal, wi, Mask<F>(true));
    path.density = emission_density<F>(emission, point, Mask<F>(true));
    const Vec<F> radiance = incident_light<all_features, F>(scene, p, wi, F(1.f)).radiance;
    const Mask<F> dense = path.density > F(0.f) && is_finite(path.density);
    path.flux = select<F>(dense, radiance * (1.f / select(dense, path.density, F(1.f))), splat<F>(0.f));
    const F amount = luminance(path.flux);
    path.density = select(amount > F(0.f) && is_finite(amount), path.density, F(0.f));
    return path;
}

template <class F> Vec3 lane_of(const Vec<F>& v, int i) { return {lane(v.x, i), lane(v.y, i), lane(v.z, i)}; }
template <class F> EmittedPath emitted_in_lane(const Emission<F>& e, int i) {
    return {.origin = lane_of<F>(e.origin, i),
            .direction = lane_of<F>(e.direction, i),
            .light_position = lane_of<F>(e.light_position, i),
            .light_normal = lane_of<F>(e.light_normal, i),
            .flux = lane_of<F>(e.flux, i),
            .density = lane(e.density, i),
            .light = lane(e.light, i),
            .infinite = bool(bits(e.infinite) >> i & 1),
            .delta = bool(bits(e.delta) >> i & 1)};
}

// Replaces `emitted` by the paths of the samplers keys[k], indices[k], k < count, which are padded as columns are. EmittedPath::index is k;
// paths that do not exist are left out. Sorted by place: rays of a packet then meet the same triangles.
template <class F> void emit_light_paths(const SceneTables& scene, const EmissionTables& emission, const uint32_t* keys,
                                         const uint32_t* indices, int count, std::vector<EmittedPath>& emitted) {
    std::vector<EmittedPath> unsorted;
    std::vector<uint64_t> order; // place, then number in `unsorted`
    unsorted.reserve(size_t(count));
    order.reserve(size_t(count));
    for (int k = 0; k < count; k += width<F>) {
        const Emission<F> e = emit_path<F>(scene, emission, emission_random<F>({load<UInt<F>>(keys + k), load<UInt<F>>(indices + k)}));
        const Mask<F> exists = as_mask(iota<F>() + k < count) && e.density > F(0.f);
        for_each_lane(bits(exists), [&](int i) {
            order.push_back(uint64_t(lane(e.place, i)) << 32 | unsorted.size());
            unsorted.push_back(emitted_in_lane<F>(e, i));
            unsorted.back().index = uint32_t(k + i);
        });
    }
    sort_paths(order, unsorted, emitted);
}

} // namespace blush::inline BLUSH_ISA
