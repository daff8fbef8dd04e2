// How much of a surface a path looks at: ray cones (Akenine-Moeller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing",
// Ray Tracing Gems 2019, and "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 2021). Width and angle are those of the
// cone across the ray; that a slanted surface stretches it along is left to the samples of a pixel, which lie all over it, so that nothing is
// blurred across.
//
// From the camera a cone is half a pixel wide: less than the pixel's own filter, which sees to the rest. Planes that mirror or refract pass
// it on. What curved ones would make of it is not known; behind them textures are read as they are, until a lobe spreads the light.
#pragma once

#include "render/estimator_settings.h"
#include "render/path.h"
#include "render/scene_tables.h"

namespace blush::inline BLUSH_ISA {

// A direction drawn from a lobe stands for one of so many cells of it, each as likely.
constexpr float cells_of_a_lobe = 64;
constexpr float widest_spread = 0.5f; // metres per metre

// Metres per metre of distance from a perspective camera; from an orthographic one, metres.
inline float camera_cone(const CameraRecord& camera, const EstimatorSettings& settings) {
    return settings.filter_textures ? length(camera.up) / settings.height : 0.f; // `up` is half the height of the picture
}

// Where the path begins.
template <class F> F cone_at_camera(const CameraRecord& camera, const EstimatorSettings& settings) {
    return camera.orthographic ? F(camera_cone(camera, settings)) : F(0.f);
}

// Metres, where the path's ray has gone the distance t.
template <class F> F cone_width(const CameraRecord& camera, const EstimatorSettings& settings, const Path<F>& path, const F& t) {
    if (!settings.filter_textures) return F(0.f);
    // A cell of solid angle 1 / (cells * pdf) is 2 sqrt(1 / (pi * cells * pdf)) across.
    constexpr float across = 4 * 0.3183098862f / cells_of_a_lobe;
    const F lobe = min(F(sqrt(across / path.pdf)), F(widest_spread));
    const F spread = select(is_finite(path.pdf), lobe, F(camera.orthographic ? 0.f : camera_cone(camera, settings)));
    return max(F(path.cone + spread * t), F(0.f));
}

// Of the path that goes on from a surface where it was `width` wide. Lobes spread it far more than it was, which is forgotten.
template <class F> F scattered_cone(const F& width, const Mask<F>& delta, const Mask<F>& flat) {
    return select(delta, select(flat, width, F(-infinity)), F(0.f));
}

} // namespace blush::inline BLUSH_ISA
