// Texture footprint of a path: ray cones (Akenine-Moeller et al., "Texture Level of Detail Strategies
// for Real-Time Ray Tracing", Ray Tracing Gems 2019, and "Improved Shader and Texture Level of Detail
// Using Ray Cones", JCGT 2021). Width and angle are perpendicular to the ray; the stretch on slanted
// surfaces is ignored (the samples of a pixel cover it), so that no blur is added.
//
// At the camera the cone is half a pixel wide, less than the pixel filter, which does the rest. Flat specular surfaces pass the
// cone on. Curved ones are not handled: behind them textures are unfiltered. So they are behind rough lobes, whose cone would be wide:
// a mean roughness does not reflect as the texels do, and light paths do not know this cone, so they would converge to another image.
#pragma once

#include "render/compile/scene_tables.h"
#include "render/integrator/estimator_settings.h"
#include "render/integrator/path.h"

namespace blush::inline BLUSH_ISA {

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
    const float spread = camera.orthographic ? 0.f : camera_cone(camera, settings);
    return max(F(path.cone + spread * t), F(0.f));
}

// Cone of the path leaving a surface with footprint `width`: none behind rough lobes and curved surfaces.
template <class F> F scattered_cone(const F& width, const Mask<F>& delta, const Mask<F>& flat) {
    return select(delta && flat, width, F(-infinity));
}

} // namespace blush::inline BLUSH_ISA
