// The rays of the walks of manifold sampling (manifold_sampling.h).
#pragma once

#include "render/integrator/manifold/manifold_walk.h"
#include "render/integrator/path_queues.h"

namespace blush::inline BLUSH_ISA {

// The walks of lanes k, k + 1, ... of ManifoldColumns::live.
template <class F> Int<F> live_walks(const ManifoldColumns& c, int k, int live) {
    return select(as_mask(iota<F>() + k < live), load<Int<F>>(c.live + k), Int<F>(0));
}

// Distance along a ray to its target, less than that of any hit on the light there: walks have converged within their tolerance.
template <class F> F before_target(const ManifoldColumns& c, const Int<F>& index, const F& distance) {
    return distance * (1.f - 1e-4f) - 4.f * gather(c.tolerance, index);
}

// Closest hits of the walks' rays on all but blended surfaces, and what these leave of the light: up to the hit, or to the light's point.
template <class F>
void trace_walks(const KernelContext& context, const ManifoldColumns& c, const PathQueue& rays, int live, HitColumns& h) {
    RayArrays arrays{rays.ox, rays.oy, rays.oz, rays.dx, rays.dy, rays.dz, nullptr, nullptr, other_ray_mask};
    const HitArrays hits{h.t, h.u, h.v, h.geometry, h.instance, h.triangle};
    if (!c.blended) return trace_closest<F>(*context.accel, arrays, live, false, hits);
    context.accel->intersect_unblended(arrays, live, false, hits);
    for (int k = 0; k < live; k += width<F>) {
        const Hit<F> hit = load_hit<F>(h, k);
        const Int<F> index = live_walks<F>(c, k, live);
        const F before_hit = select(as_mask(hit.geometry < 0), F(infinity), hit.t * (1.f - 4e-7f));
        // The light itself may be blended: its ray ends as much before it as take_arrivals() allows for.
        const F to_light = dot(load3<F>(c.target, index) - load3<F>(c.position, index), load3<F>(c.ray, index));
        const F before_light = max(before_target<F>(c, index, to_light), F(0.f));
        const Mask<F> ends_at_light =
            as_mask(gather(c.state, index) == int32_t(arrives)) && as_mask((gather(c.kind, index) & int32_t(receiver_infinite)) == 0);
        store(c.blended->end + k, select(ends_at_light, min(before_hit, before_light), before_hit));
    }
    arrays.far_distance = c.blended->end;
    context.accel->transmittance(arrays, live, false, c.blended->share);
}

} // namespace blush::inline BLUSH_ISA
