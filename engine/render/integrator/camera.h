// Pixel and lens samples to camera rays: pinhole, thin lens, orthographic; pixel filters by importance sampling.
#pragma once

#include "core/sampling.h"
#include "render/compile/scene_tables.h"
#include "shading/features.h"

#include <array>

namespace blush {

// Inverse CDF of a one-dimensional pixel filter, tabulated at `size` equal steps of probability. Sample positions are looked up
// and have weight 1 (Ernst, Stamminger, Greiner 2006), so no two threads write the same pixel.
struct FilterTable {
    static constexpr int size = 256;
    std::array<float, size + 1> offset; // pixels from the centre
};
// Blackman-Harris window of 1.5 pixels (Harris 1978: 0.35875, 0.48829, 0.14128, 0.01168).
const FilterTable& blackman_harris_filter();
// One pixel wide.
const FilterTable& box_filter();

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> struct Ray {
    Vec<F> origin, direction; // direction of unit length
};

template <class F> F filter_offset(const FilterTable& filter, const F& u) {
    const F x = u * float(FilterTable::size);
    const Int<F> i = to_int(x);
    const F a = gather(filter.offset.data(), i), b = gather(filter.offset.data(), Int<F>(i + 1));
    return a + (b - a) * (x - to_float(i));
}

// Ray through image position (x, y) in pixels of a width x height film, y downwards; lens: uniform in the unit square.
template <Features S, class F>
Ray<F> camera_ray(const CameraRecord& camera, const F& x, const F& y, float width, float height, const F& lens_u, const F& lens_v) {
    const F sx = x * (2.f / width) - 1.f, sy = 1.f - y * (2.f / height);
    const Vec<F> eye = splat<F>(camera.position), forward = splat<F>(camera.forward);
    const Vec<F> lateral = splat<F>(camera.right) * sx + splat<F>(camera.up) * sy;
    if constexpr (S.has(Feature::orthographic)) {
        if (camera.orthographic) return {eye + lateral, forward};
    }
    const Vec<F> through = forward + lateral;
    if constexpr (S.has(Feature::thin_lens)) {
        if (camera.aperture_radius > 0) {
            const Vec2T<F> lens = sample_disk(lens_u, lens_v) * F(camera.aperture_radius);
            // right and up are scaled by the field of view: back to unit length for the lens.
            const Vec3 r = normalize(camera.right), u = normalize(camera.up);
            const Vec<F> shift = splat<F>(r) * lens.x + splat<F>(u) * lens.y;
            return {eye + shift, normalize(through * F(camera.focus_distance) - shift)};
        }
    }
    return {eye, normalize(through)};
}

} // namespace blush::inline BLUSH_ISA
