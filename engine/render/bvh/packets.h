// Traces arrays of rays with Embree in packets of N.
#pragma once

#include "core/math.h"
#include "core/sampler.h"
#include "render/bvh/opacity_filter.h"
#include "render/bvh/ray_arrays.h"
#include "render/bvh/transmittance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <embree3/rtcore.h>
#include <limits>
#include <numeric>

namespace blush {

template <int N> struct Packet;
template <> struct Packet<4> {
    using RayHit = RTCRayHit4;
    using Ray = RTCRay4;
    static constexpr auto intersect = rtcIntersect4;
    static constexpr auto occluded = rtcOccluded4;
};
template <> struct Packet<8> {
    using RayHit = RTCRayHit8;
    using Ray = RTCRay8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <> struct Packet<16> {
    using RayHit = RTCRayHit16;
    using Ray = RTCRay16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
};

template <int N, class Ray> void load_rays(Ray& ray, const RayArrays& rays, int first) {
    const auto copy = [&](float* to, const float* from) { std::memcpy(to, from + first, N * sizeof(float)); };
    copy(ray.org_x, rays.ox);
    copy(ray.org_y, rays.oy);
    copy(ray.org_z, rays.oz);
    copy(ray.dir_x, rays.dx);
    copy(ray.dir_y, rays.dy);
    copy(ray.dir_z, rays.dz);
    if (rays.far_distance)
        copy(ray.tfar, rays.far_distance);
    else
        std::fill_n(ray.tfar, N, infinity);
    // tnear is just above 0, because the watertight test includes 0: a ray must not hit the surface that it starts on, for
    // example when the camera lies in it.
    std::fill_n(ray.tnear, N, std::numeric_limits<float>::min());
    std::fill_n(ray.time, N, 0.f);
    if (rays.masks)
        std::memcpy(ray.mask, rays.masks + first, N * sizeof(uint32_t));
    else
        std::fill_n(ray.mask, N, rays.mask);
    std::fill_n(ray.flags, N, 0u);
}

// Call after load_rays.
template <int N, class Ray> void begin_packet(TraceContext& context, Ray& ray, const RayArrays& rays, int first) {
    if (context.blended == Blended::by_chance && !rays.random) return;
    std::iota(ray.id, ray.id + N, 0u);
    context.random = rays.random ? rays.random + first : nullptr;
    context.index = rays.index ? rays.index + first : nullptr;
    if (context.blended == Blended::by_chance) return;
    std::fill_n(context.depth, N, 0u);
    std::fill_n(context.limit, N, opaque_depth);
    if (context.chosen) std::fill_n(context.chosen->t, N, infinity);
    if (!context.random || context.blended == Blended::ignored) return;
    for (int i = 0; i < N; ++i) {
        // A ray that goes on behind a pane has the same random number, and needs an independent decision there.
        const uint32_t place = pcg_hash(std::bit_cast<uint32_t>(ray.org_x[i])) ^ pcg_hash(std::bit_cast<uint32_t>(ray.org_y[i]) + 1) ^
                               pcg_hash(std::bit_cast<uint32_t>(ray.org_z[i]) + 2);
        const uint32_t sample = context.index ? pcg_hash(context.index[i]) : 0;
        context.limit[i] = roulette_limit(1 - unit_float<float>(pcg_hash(context.random[i] ^ pcg_hash(place + sample))));
    }
}

// The lanes whose directions have the signs of lane `first`.
template <int N> void select_octant(int* lanes, const int* of, int first, const auto& q) {
    const auto same = [&](const float* d, int i) { return std::signbit(d[i]) == std::signbit(d[first]) && (d[i] < 0) == (d[first] < 0); };
    for (int i = 0; i < N; ++i) lanes[i] = of[i] && same(q.dir_x, i) && same(q.dir_y, i) && same(q.dir_z, i) ? -1 : 0;
}

// Any-hits of the valid lanes. Embree 3.13 traces a coherent packet once for each octant of its directions, but each time reports the
// hits of all its lanes: a filter that counts them must get one octant at a time.
template <int N> void trace_occluded(RTCScene scene, TraceContext& context, const int* valid, auto& q) {
    const bool coherent = context.embree.flags & RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (!coherent || context.blended != Blended::attenuating) return Packet<N>::occluded(valid, scene, &context.embree, &q);
    alignas(64) int left[N], octant[N];
    std::copy_n(valid, N, left);
    for (int i = 0; i < N; ++i) {
        if (!left[i]) continue;
        select_octant<N>(octant, left, i, q);
        for (int k = i; k < N; ++k) left[k] &= ~octant[k];
        Packet<N>::occluded(octant, scene, &context.embree, &q);
    }
}

// Marks the first `count` lanes as valid, except rays outside the range that Embree accepts (an Embree built with assertions
// aborts on them). Such a ray misses everything; its non-finite or huge sample is reported by the film.
template <int N, class Rays> void valid_lanes(int* valid, const Rays& q, int count, float reach) {
    for (int i = 0; i < N; ++i) {
        const float size = std::abs(q.org_x[i]) + std::abs(q.org_y[i]) + std::abs(q.org_z[i]) + std::abs(q.dir_x[i]) +
                           std::abs(q.dir_y[i]) + std::abs(q.dir_z[i]);
        valid[i] = -(int(i < count) & int(size <= reach) & int(q.tfar[i] >= 0)); // branchless: runs for every ray
    }
}

// The Embree scenes to trace. `area_lights`: separate scene of the area lights; null: they are in the top level. Geometry k of it has the
// id that it would have in the top level: meshes count from `first_mesh`, then spheres from `first_sphere`.
struct TracedScenes {
    RTCScene top, area_lights;
    uint32_t area_light_meshes, first_mesh, first_sphere;
    float reach; // largest sum of coordinates of a ray that is traced
};

// Continues q, which holds the hits of the top level, in the scene of the area lights.
template <int N> void intersect_area_lights(const TracedScenes& scenes, TraceContext& context, const int* valid, auto& q) {
    alignas(64) uint32_t before[N];
    std::copy_n(q.hit.geomID, N, before);
    std::fill_n(q.hit.geomID, N, RTC_INVALID_GEOMETRY_ID);
    Packet<N>::intersect(valid, scenes.area_lights, &context.embree, &q);
    for (int i = 0; i < N; ++i) {
        uint32_t& geometry = q.hit.geomID[i];
        if (geometry == RTC_INVALID_GEOMETRY_ID)
            geometry = before[i];
        else
            geometry += geometry < scenes.area_light_meshes ? scenes.first_mesh : scenes.first_sphere - scenes.area_light_meshes;
    }
}

// The share of the background; the chosen hits become those of q unless it has nearer ones.
template <int N> void end_at_chosen(const TraceContext& context, auto& q, float* share) {
    const ChosenHits& c = *context.chosen;
    for (int i = 0; i < N; ++i) {
        const bool escapes = q.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID && context.depth[i] <= context.limit[i];
        share[i] = escapes ? transmittance_of(std::min(context.depth[i], roulette_depth)) : 0.f;
        if (!(c.t[i] < infinity && c.t[i] <= q.ray.tfar[i])) continue;
        q.ray.tfar[i] = c.t[i];
        q.hit.u[i] = c.u[i];
        q.hit.v[i] = c.v[i];
        q.hit.geomID[i] = c.geometry[i];
        q.hit.instID[0][i] = c.instance[i];
        q.hit.primID[i] = c.triangle[i];
    }
}

// `share`: of the background, by ray, for Blended::both; else null.
template <int N> void intersect_packets(const TracedScenes& scenes, TraceContext& context, const RayArrays& rays, int count,
                                        const HitArrays& hits, float* share) {
    alignas(64) int valid[N];
    alignas(64) typename Packet<N>::RayHit q;
    for (int k = 0; k < count; k += N) {
        load_rays<N>(q.ray, rays, k);
        begin_packet<N>(context, q.ray, rays, k);
        std::fill_n(q.hit.geomID, N, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(q.hit.instID[0], N, RTC_INVALID_GEOMETRY_ID);
        valid_lanes<N>(valid, q.ray, count - k, scenes.reach);
        Packet<N>::intersect(valid, scenes.top, &context.embree, &q);
        if (scenes.area_lights) intersect_area_lights<N>(scenes, context, valid, q);
        if (share) end_at_chosen<N>(context, q, share + k);
        const auto copy = [&](auto* to, const auto* from) { std::memcpy(to + k, from, N * sizeof(float)); };
        copy(hits.t, q.ray.tfar);
        copy(hits.u, q.hit.u);
        copy(hits.v, q.hit.v);
        copy(hits.geometry, q.hit.geomID);
        copy(hits.instance, q.hit.instID[0]);
        copy(hits.triangle, q.hit.primID);
    }
}

// Calls store(ray, lane, blocked) for each ray.
template <int N, class Store>
void occluded_packets(const TracedScenes& scenes, TraceContext& context, const RayArrays& rays, int count, const Store& store) {
    alignas(64) int valid[N];
    alignas(64) typename Packet<N>::Ray q;
    for (int k = 0; k < count; k += N) {
        load_rays<N>(q, rays, k);
        begin_packet<N>(context, q, rays, k);
        valid_lanes<N>(valid, q, count - k, scenes.reach);
        trace_occluded<N>(scenes.top, context, valid, q);
        if (scenes.area_lights) {
            for (int i = 0; i < N; ++i) valid[i] &= -int(q.tfar[i] >= 0);
            trace_occluded<N>(scenes.area_lights, context, valid, q);
        }
        const int n = std::min(N, count - k);
        for (int i = 0; i < n; ++i) store(k + i, i, q.tfar[i] < 0);
    }
}

} // namespace blush
