// Where a point of a triangle lies on its textures.
#pragma once

#include "core/math.h"
#include "render/scene_tables.h"

namespace blush::inline BLUSH_ISA {

// Texture coordinates at the point of the triangle with these vertices that has these weights; (0, 0) on sets that the part does not
// have and in lanes that are not active.
template <class F>
TexturePoint<F> texture_point(const SceneTables& scene, const Int<F>& part_flags, const std::array<Int<F>, 3>& vertices,
                              const std::array<F, 3>& weights, const Mask<F>& active) {
    TexturePoint<F> at;
    for (int set = 0; set < scene.materials.textures.uv_sets; ++set) {
        at.uv[size_t(set)] = {F(0.f), F(0.f)};
        const Mask<F> present = active && as_mask((part_flags & int32_t(part_uv << set)) != 0);
        if (!any(present)) continue;
        const float* uv = scene.uv[size_t(set)];
        const auto mixed = [&](int c) {
            return gather(uv + c, Int<F>(vertices[0] * 2)) * weights[0] + gather(uv + c, Int<F>(vertices[1] * 2)) * weights[1] +
                   gather(uv + c, Int<F>(vertices[2] * 2)) * weights[2];
        };
        at.uv[size_t(set)] = {select(present, mixed(0), F(0.f)), select(present, mixed(1), F(0.f))};
    }
    return at;
}

} // namespace blush::inline BLUSH_ISA
