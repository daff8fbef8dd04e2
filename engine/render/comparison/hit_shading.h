// A surface that a path meets, shaded as the estimator does it (estimator.h), one path at a time.
#pragma once

#include "render/integrator/light_paths.h"

namespace blush::inline BLUSH_ISA {

constexpr Features comparison_features = all_features.with(Feature::light_paths);

using HitShading = ShadedHit<float>;

// `width`: of the texture filter, metres.
inline HitShading shade_hit(const KernelContext& context, const Path<float>& path, const Hit<float>& hit, float width) {
    return shade_hit<comparison_features, float>(*context.scene, context.settings.energy, path, hit, true, width);
}

} // namespace blush::inline BLUSH_ISA
