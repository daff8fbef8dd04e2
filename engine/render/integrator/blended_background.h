// The background behind blended surfaces. They stop path rays by chance, but the light of the background that passes all of them is
// known: each ray adds it times the product of their transmittances, whether it is stopped or not. The expectation is the same as if
// only the rays that pass all of them added it, and the variance is less.
#pragma once

#include "render/integrator/emission_hit.h"
#include "render/integrator/path_queues.h"

namespace blush::inline BLUSH_ISA {

// True if path rays know the transmittance towards the background. Not with panes: a ray that passes one begins again behind it.
inline bool sees_past_blended(const SceneTables& scene) {
    return scene.blends && !scene.panes &&
           (scene.environment.lights_scene || scene.environment.visible_to_camera || scene.lights.sun_count > 0);
}

// What paths k, k + 1, ... of a queue see of the background.
template <class F> struct SeenBackground {
    F share = F(1.f); // of its light
    Mask<F> seen;
    Mask<F> stopped = Mask<F>(false); // those of them that a blended surface stopped
};
template <class F> SeenBackground<F> seen_background(const SceneTables& scene, const TileScratch& scratch, int k, const Mask<F>& active) {
    const Mask<F> escaped = active && as_mask(load<Int<F>>(scratch.hits.geometry + k) < 0);
    if (!sees_past_blended(scene)) return {.seen = escaped};
    const F share = load<F>(*scratch.background_share + k);
    const Mask<F> seen = active && (escaped || share > F(0.f));
    return {share, seen, seen && !escaped};
}

// Light of the background in the lanes of `background.stopped`; black in others.
template <Features S, class F>
Vec<F> light_past_blended(const KernelContext& context, const Path<F>& path, int bounce, const SeenBackground<F>& background) {
    if (!any(background.stopped)) return splat<F>(0.f);
    const BackgroundLight<F> light = background_light<S, F>(*context.scene, context.settings, path, bounce, background.stopped);
    return select<F>(background.stopped, path.beta * light.radiance * background.share, splat<F>(0.f));
}

} // namespace blush::inline BLUSH_ISA
