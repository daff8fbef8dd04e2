// How a surface is turned for shading: its normal, interpolated or mapped, and the frame in which it scatters.
#pragma once

#include "render/surface.h"
#include "shading/material.h"

namespace blush::inline BLUSH_ISA {

// The shading frame's normal: interpolated or mapped, turned to the plane's side.
template <Features S, class F>
Vec<F> shading_normal(const Surface<F>& s, const Vec<F>& ng, const Vec<F>& tangent_normal) {
    Vec<F> ns = select<F>(dot(s.ns, ng) < F(0.f), -s.ns, s.ns);
    if constexpr (S.has(Feature::normal_maps)) {
        if (any(s.has_tangents)) {
            // glTF: bitangent = cross(normal, tangent) * w. Gram-Schmidt against the interpolated normal.
            const Vec<F> n = s.ns;
            const Vec<F> flat = s.tangent - n * dot(n, s.tangent);
            const F l2 = dot(flat, flat);
            const Vec<F> t = flat / sqrt(max(l2, F(1e-30f)));
            const Vec<F> b = cross(n, t) * s.tangent_sign;
            const Vec<F> mapped = normalize(t * tangent_normal.x + b * tangent_normal.y + n * tangent_normal.z);
            const Vec<F> turned = select<F>(dot(s.ns, ng) < F(0.f), -mapped, mapped);
            ns = select<F>(s.has_tangents && l2 > F(1e-20f) && dot(turned, ng) > F(0.f), turned, ns);
        }
    }
    return ns;
}

// The frame around the shading normal; its x is the direction along which the material stretches reflections, if it does.
template <Features S, class F> Basis<F> shading_frame(const Surface<F>& s, const Vec<F>& ns, const MaterialPoint<F>& material) {
    const Basis<F> any_frame = basis_around(ns);
    if constexpr (!S.has(Feature::anisotropy)) return any_frame;
    else {
        const Mask<F> stretched = s.has_tangents && material.anisotropy.strength > F(0.f);
        if (!any(stretched)) return any_frame;
        // As in shading_normal; seen from behind the stretch is the same.
        const Vec<F> t = normalize(s.tangent - s.ns * dot(s.ns, s.tangent)), b = cross(s.ns, t) * s.tangent_sign;
        const Vec<F> along = t * material.anisotropy.direction.x + b * material.anisotropy.direction.y;
        const Vec<F> flat = along - ns * dot(ns, along);
        const F l2 = dot(flat, flat);
        const Mask<F> usable = stretched && l2 > F(1e-12f);
        const Vec<F> x = flat / sqrt(select(usable, l2, F(1.f)));
        return {select<F>(usable, x, any_frame.s), select<F>(usable, cross(ns, x), any_frame.t), ns};
    }
}

} // namespace blush::inline BLUSH_ISA
