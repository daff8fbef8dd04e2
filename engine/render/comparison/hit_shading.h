// A surface that a path meets, shaded as the estimator does it (estimator.h), one path at a time.
#pragma once

#include "render/integrator/light_paths.h"

namespace blush::inline BLUSH_ISA {

constexpr Features comparison_features = all_features.with(Feature::light_paths);

struct HitShading {
    Surface<float> surface;
    MaterialPoint<float> material;
    HitSide<float> side;
    Vec3 beta; // behind the attenuation on the way
    bool scatters = false, dispersed = false;
    ShadingFrame<float> shading;
    Bsdf<float> bsdf;
};

// `width`: of the texture filter, metres.
inline HitShading shade_hit(const KernelContext& context, const Path<float>& path, const Hit<float>& hit, float width) {
    constexpr Features s = comparison_features;
    HitShading p;
    p.surface = surface_at<s, float>(*context.scene, hit, true, width);
    p.material = material_at<s, float>(context.scene->materials, p.surface.material, p.surface.texture, p.surface.color, true);
    p.side = hit_side<s, float>(p.surface, p.material, path.ray.direction);
    p.beta = attenuate<s, float>(path.beta, p.material, hit.t, p.side, true);
    p.scatters = !p.material.unlit;
    p.shading = shading_frame_at<s, float>(p.surface, p.material, p.side.wo, p.side.front, p.side.solid);
    p.dispersed = disperse<s, float>(path, p.material.dispersion, p.side, p.scatters, p.material.bsdf.ior, p.beta);
    p.bsdf = make_bsdf<s, float>(p.material.bsdf, p.shading.wo, context.settings.energy);
    return p;
}

} // namespace blush::inline BLUSH_ISA
