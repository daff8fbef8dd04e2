// What is known of a path, and what one step of it gives: the types that the estimator, its kernels and their observers share.
#pragma once

#include "render/camera.h"

namespace blush::inline BLUSH_ISA {

template <class F> struct Path {
    Ray<F> ray;
    Vec<F> beta;        // throughput: what radiance along the ray is worth to the pixel
    F pdf;              // solid-angle density of the ray's direction; infinite after the camera and smooth lobes
    Vec<F> normal;      // of the Receiver where the ray begins; only with Feature::light_tree
    UInt<F> key, index; // of the sampler
    Int<F> slot;        // which of the tile's samples it adds to
    F cone;             // metres across where the ray begins (ray_cone.h); only with Feature::textures
    Int<F> part;        // that the ray left, -1: the camera; only where lights may be linked
    Int<F> dispersed;   // 1: carries the light of one wavelength, 0: of all; only with Feature::dispersion
};

// What the first surface of a path shows: the denoiser's and the picker's planes.
template <class F> struct FirstHit {
    Vec<F> albedo, normal;
    F depth;                // metres; 0: nothing was hit
    Int<F> object, material;
};

// How a step was weighted, for those who want to know (path_log); kernels do not look and pay nothing. Valid where the step says that it
// emits, connects or continues.
template <class F> struct StepWeights {
    F emission;             // MIS weight of emission that was found
    F light, light_pdf, light_bsdf_pdf; // MIS weight of the light sample; density it was drawn with; density the BSDF would have had
    F survival;             // roulette's probability; 1 where it was not asked
    Mask<F> asked;          // whether it was
    Vec<F> arriving;        // throughput at the vertex, after absorption on the way
};

// What a connection to another pixel's path needs to know of the first two vertices of a path (path_reuse.h).
template <class F> struct Junction {
    Mask<F> lambertian;   // scatters the same radiance to all who are in front of ng and ns
    Vec<F> position;
    F clearance;          // metres along ng that keep a ray's origin off the surface
    Vec<F> ng, ns, reflectance;
};

template <class F> struct Step {
    Junction<F> junction; // at bounces 0 and 1 only
    Mask<F> emits, connects, continues;
    Mask<F> breaks; // the throughput is no finite number: the path ends and its sample is spoilt, for the film to drop and count
    Vec<F> emitted; // add where `emits`
    Vec<F> direct;  // add where `connects` and nothing lies on the shadow ray
    Int<F> light;   // where that comes from: a record of the light table
    UInt<F> shadow_mask; // what the shadow ray meets; only where lights are linked
    Ray<F> shadow;
    F shadow_distance;
    Path<F> next;   // where `continues` or `breaks`
    FirstHit<F> first; // at bounce 0 only
    StepWeights<F> weights;
};

} // namespace blush::inline BLUSH_ISA
