// Texture footprint of a path: ray cones (Akenine-Moeller et al., "Texture Level of Detail Strategies
// for Real-Time Ray Tracing", Ray Tracing Gems 2019, and "Improved Shader and Texture Level of Detail
// Using Ray Cones", JCGT 2021). Width and angle are perpendicular to the ray; the stretch on slanted
// surfaces is ignored (the samples of a pixel cover it), so that no blur is added.
//
// At the camera the cone is half a pixel wide, less than the pixel filter, which does the rest. Flat specular surfaces pass the
// cone on. Curved ones are not handled: behind them textures are unfiltered until a rough lobe spreads the path.
#pragma once

#include "render/compile/scene_tables.h"
#include "render/integrator/estimator_settings.h"
#include "render/integrator/path.h"

namespace blush::inline BLUSH_ISA {

// A sampled direction represents one of so many equally likely cells of its lobe.
constexpr float cells_of_a_lobe = 64;
constexpr float max_cone_spread = 0.5f; // metres per metre

// Metres per metre of distance for a perspective camera; metres for an orthographic one.
inline float camera_cone(const CameraRecord& camera, const EstimatorSettings& settings) {
    return settings.filter_textures ? length(camera.up) / settings.height : 0.f; // `up` is half the height of the image
}

// Width at the camera.
template <class F> F cone_at_camera(const CameraRecord& camera, const EstimatorSettings& settings) {
    return camera.orthographic ? F(camera_cone(camera, settings)) : F(0.f);
}

// Width in metres at distance t along the path's ray.
template <class F> F cone_width(const CameraRecord& camera, const EstimatorSettings& settings, const Path<F>& path, const F& t) {
    if (!settings.filter_textures) return F(0.f);
    // A cell of solid angle 1 / (cells * pdf) is 2 sqrt(1 / (pi * cells * pdf)) across.
    constexpr float across = 4 * inv_pi / cells_of_a_lobe;
    const F lobe = min(F(sqrt(across / path.pdf)), F(max_cone_spread));
    const F spread = select(is_finite(path.pdf), lobe, F(camera.orthographic ? 0.f : camera_cone(camera, settings)));
    return max(F(path.cone + spread * t), F(0.f));
}

// Cone of the path leaving a surface with footprint `width`. Rough
// lobes spread the path much more, so the old width is dropped there.
template <class F> F scattered_cone(const F& width, const Mask<F>& delta, const Mask<F>& flat) {
    return select(delta, select(flat, width, F(-infinity)), F(0.f));
}

} // namespace blush::inline BLUSH_ISA
