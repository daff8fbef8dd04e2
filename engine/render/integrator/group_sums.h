// Emission found by paths, by light group.
#pragma once

#include "render/integrator/estimator.h"
#include "render/kernels/kernel.h"

namespace blush::inline BLUSH_ISA {

// Adds this share of the background one light at a time.
template <Features S, class F> void add_background_by_group(const KernelContext& context, GroupColumns& groups, const Path<F>& path,
                                                            int bounce, const F& share, const Mask<F>& seen) {
    const SceneTables& scene = *context.scene;
    for_each_background_light<S, F>(scene, context.settings, path, bounce, seen,
                                    [&](int32_t light, const Vec<F>& radiance, const F&, const Mask<F>& lanes) {
                                        const Vec<F> arriving = path.beta * radiance * share;
                                        const int group = light < 0 ? scene.groups.environment : scene.groups.of_light[light];
                                        for_each_lane(bits(Mask<F>(lanes && seen)), [&](int i) {
                                            groups.add(group, lane(path.slot, i), double(lane(arriving.x, i)), double(lane(arriving.y, i)),
                                                       double(lane(arriving.z, i)));
                                        });
                                    });
}

// Adds step.emitted of paths k, k + 1, ... of a queue: surfaces by their part, and spheres one by one. Not the background.
template <class F> void add_emission_by_group(const KernelContext& context, GroupColumns& groups, const HitColumns& hits, int k,
                                              const Path<F>& path, const Step<F>& step) {
    const SceneTables& scene = *context.scene;
    const Mask<F> found = step.emits && as_mask(load<Int<F>>(hits.geometry + k) >= 0);
    const auto add = [&](int group, int i, const Vec<F>& light) {
        groups.add(group, lane(path.slot, i), double(lane(light.x, i)), double(lane(light.y, i)), double(lane(light.z, i)));
    };
    for_each_lane(bits(found), [&](int i) {
        const int32_t instance = hits.instance[k + i];
        if (instance == sphere_instance)
            return add(scene.groups.of_light[scene.lights.first_sphere + hits.triangle[k + i]], i, step.emitted);
        const int32_t part = hits.geometry[k + i] + (instance >= 0 ? scene.instance_first_part[instance] : 0);
        add(scene.groups.of_part[part], i, step.emitted);
    });
}

} // namespace blush::inline BLUSH_ISA
