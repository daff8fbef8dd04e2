// Texture coordinates and footprint at a point of a triangle.
#pragma once

#include "core/math.h"
#include "render/compile/scene_tables.h"

namespace blush::inline BLUSH_ISA {

// Size of the filtered area.
template <class F> struct Footprint {
    F width = F(0.f);         // metres
    F triangle_area = F(1.f); // twice the area, square metres
};

// Interpolated texture coordinates with the given barycentric weights, and the footprint's width in UV units (mean over
// directions); 0 on UV sets that the part lacks and in inactive lanes.
template <class F> TexturePoint<F> texture_point(const SceneTables& scene, const Int<F>& part_flags, const std::array<Int<F>, 3>& vertices,
                                                 const std::array<F, 3>& weights, const Mask<F>& active,
                                                 const Footprint<F>& footprint = {}) {
    TexturePoint<F> at;
    for (int set = 0; set < scene.materials.textures.uv_sets; ++set) {
        at.uv[size_t(set)] = {F(0.f), F(0.f)};
        at.width[size_t(set)] = F(0.f);
        const Mask<F> present = active && as_mask((part_flags & int32_t(part_uv << set)) != 0);
        if (!any(present)) continue;
        const float* uv = scene.uv[size_t(set)];
        const auto corner = [&](size_t k) -> Vec2T<F> {
            return {gather(uv, Int<F>(vertices[k] * 2)), gather(uv + 1, Int<F>(vertices[k] * 2))};
        };
        const Vec2T<F> a = corner(0), b = corner(1), c = corner(2);
        const Vec2T<F> mixed = a * weights[0] + b * weights[1] + c * weights[2];
        at.uv[size_t(set)] = {select(present, mixed.x, F(0.f)), select(present, mixed.y, F(0.f))};
        const F uv_area = abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
        at.width[size_t(set)] = select(present, footprint.width * sqrt(uv_area / footprint.triangle_area), F(0.f));
    }
    return at;
}

} // namespace blush::inline BLUSH_ISA
