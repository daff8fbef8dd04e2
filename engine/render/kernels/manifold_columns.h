// The walks of manifold sampling in a tile (render/integrator/manifold/manifold_sampling.h).
#pragma once

#include "render/kernels/column.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace blush {

struct Columns3 {
    Column<float> x, y, z;
};

// Hits where chains begin, as they are shaded again (render/integrator/manifold/receiver_bsdf.h).
struct ReceiverHitColumns {
    Column<int32_t> geometry, instance, triangle; // geometry -1: Lambertian, the rest is not set
    Column<float> u, v, width;                    // width: of the texture filter, metres
    Columns3 wo;                                  // to the vertex before
};

// Where chains of paths begin: a rough vertex, and the direction in which the path has left it.
struct ChainStartColumns {
    Columns3 origin, ns, direction;
    ReceiverHitColumns at;
    Column<float> ratio, arrival; // as ManifoldColumns::light_ratio and arrival
};

// Paths of the camera that find the same light by chance (render/integrator/manifold/manifold_hits.h).
struct ManifoldHitColumns {
    // By slot, and by hit: where a path meets a light, it may begin its next chain.
    ChainStartColumns starts, start;
    // The lights that paths have met at this bounce: record, the chain between, point (at infinity: direction), and the path's light.
    int size = 0;
    Column<int32_t> slot, light, chain;
    Column<int32_t> wavelength; // as ManifoldColumns::wavelength
    Column<uint32_t> random;
    Columns3 target, emitted;
};

// What blended surfaces leave of the light of walks, which pass all of them.
struct WalkTransmittance {
    Column<float> end, share; // by ray of a round: how far it goes, and what is left there
    Column<float> passed;     // by receiver: the product along the chain
};

// By receiver: one rough vertex of a path, with a point of a light.
struct ManifoldColumns {
    int size = 0;
    // The receiver: origin of its rays, normals, throughput; where it is Lambertian, times reflectance over pi.
    Columns3 origin, ns, ng, reflected;
    ReceiverHitColumns at;
    Column<float> arrival;     // density with which paths reach it from a surface that connects to light vertices, 1/m^2; 0: from another
    Column<float> light_ratio; // light_ratio_behind() of the path; only beside light paths
    Column<int32_t> slot;
    Column<int32_t> wavelength; // of the path: step of the visible spectrum; only with Feature::dispersion
    // The light: point (at infinity: direction), normal, radiance, density with which the point is sampled (1/m^2; at infinity 1/sr),
    // record; distance from the point below which a walk has converged.
    Columns3 target, target_normal, emission;
    Column<float> density, tolerance, clearcoat; // clearcoat: share of the light under a clear coat
    Column<int32_t> light, kind;                 // kind: ReceiverFlag
    ManifoldHitColumns hits;
    // Seeds: region's segment for the light's group; the count is 0 if there is none. The group's segment of region 0.
    Column<int32_t> first_seed, seeds;
    Column<uint32_t> random;

    // The walk: its direction, and the best so far with its distance from the target and its Newton step, of which `scale` is taken.
    Columns3 direction, best;
    Column<float> best_error, step_u, step_v, scale;
    Column<int32_t> chain, iterations, state; // state: WalkState

    // The chain that is traced for the direction: events so far, the ray, its derivatives by two turns of the direction, transmittance.
    Column<int32_t> events;
    Column<int32_t> dispersed; // 1: it carries a single wavelength; only with Feature::dispersion, behind an event
    Columns3 position, ray, position_u, position_v, ray_u, ray_v, transmittance;
    std::unique_ptr<WalkTransmittance> blended; // only in scenes with blended surfaces

    // The solution: direction, squared distance within which another is the same, light that it carries, trials to find it again.
    Columns3 root, found;
    Column<float> same, coin; // coin: HitShare::coin
    Column<int32_t> root_chain, trials;

    Column<int32_t> live;

    // What is traced again: hits, for their light, or the chains of light vertices or light paths, of which densities are kept.
    enum class Traced { hits, light_vertices, light_paths } traced = Traced::hits;

    // For the pilot. Accumulated by slot: second moment of the light that was found, and of the same light if paths of the camera found it;
    // the latter over the luminance found, by receiver.
    bool measures = false;
    Column<float> own_moment, base_moment, base;
    int64_t solutions = 0, cut = 0; // accumulated; cut: given up after too many trials
    // The same of receivers that share chains with light paths: base_moment without own_moment, and the rays of their walks.
    double shared_saving = 0;
    int64_t shared_rays = 0;

    void begin_measuring(int slots) {
        measures = true;
        std::fill_n(own_moment.data, slots, 0.f);
        std::fill_n(base_moment.data, slots, 0.f);
    }
};

} // namespace blush
