// State of a path, and the result of one step: the types shared by the estimator, its kernels and diagnostics.
#pragma once

#include "render/integrator/camera.h"
#include "render/integrator/light_sampling.h"

namespace blush::inline BLUSH_ISA {

template <class F> struct Path {
    Ray<F> ray;
    Vec<F> beta;        // throughput
    F pdf;              // solid-angle pdf of the ray's direction; infinite after the camera and delta lobes
    Vec<F> normal;      // receiver normal at the ray's origin; only with Feature::light_tree
    UInt<F> key, index; // of the sampler
    Int<F> slot;        // index of the sample in the tile
    F importance;       // of the pixel, 1/nits (shading/learned_adjoint.h); only if the adjoint has been learned
    F cone;             // footprint in metres at the ray's origin (ray_cone.h); only with Feature::textures
    Int<F> part;        // that the ray left, -1: the camera; only if lights may be linked
    Int<F> dispersed;   // 1: carries a single wavelength, 0: all; only with Feature::dispersion
    // Only with Feature::light_paths: density with which light paths sample the path up to its last vertex, from there to the camera, over
    // that of the path (light_path_weights.h); and the same where the light found next may be connected by light paths, else 0.
    F light_ratio, emission_ratio;
    // Only with Feature::light_paths: the chain of manifold sampling since the last rough surface (emission_hit.h), else 0.
    Int<F> chain;
};

// First-hit data of a path, for denoising and picking.
template <class F> struct FirstHit {
    Vec<F> albedo, normal;
    F depth; // metres; 0: miss
    Int<F> object, material;
};

// Weights of a step. Kernels read only `guided`; the others are dead code there. Valid where the step emits, connects or continues.
template <class F> struct StepWeights {
    F emission;                         // MIS weight of emission at the hit
    F light, light_pdf, light_bsdf_pdf; // MIS weight of NEE; pdf of the light sample; pdf of the BSDF for it
    F survival;                         // survival probability of Russian roulette; 1 if not applied
    Mask<F> rr_applied;                 // Russian roulette was applied
    Vec<F> arriving;                    // throughput at the vertex, including absorption along the segment
    F guided = F(0.f);                  // share of path guiding in the density of the next direction
};

// A vertex of a path, for connections by path reuse (path_reuse.h) and for manifold sampling.
template <class F> struct ReuseVertex {
    Mask<F> lambertian;    // scatters equal radiance to all points in front of ng and ns
    Mask<F> begins_chains; // manifold sampling may begin here; only in scenes with it
    Vec<F> position;
    F clearance; // offset in metres along ng that keeps a ray's origin off the surface
    Vec<F> ng, ns, reflectance;
};

template <class F> struct Step {
    ReuseVertex<F> reuse_vertex; // at bounces 0 and 1; with manifold sampling at all
    Mask<F> emits, connects, continues;
    Mask<F> crosses;     // the path goes on at the other side of the surface
    Mask<F> internal;    // it is reflected within a solid, not totally
    Mask<F> non_finite;  // throughput is not finite: the path ends, and the film drops and counts the sample
    Vec<F> emitted;      // add where `emits`
    Vec<F> direct;       // add where `connects` and the shadow ray is unoccluded
    Int<F> light;        // light record of `direct`
    UInt<F> shadow_mask; // mask of the shadow ray; only if lights are linked
    Ray<F> shadow;
    F shadow_distance;
    Path<F> next;          // where `continues` or `non_finite`
    FirstHit<F> first;     // at bounce 0 only
    LightPoint<F> sampled; // the light of `direct`; only with Feature::light_paths
    StepWeights<F> weights;
};

} // namespace blush::inline BLUSH_ISA
