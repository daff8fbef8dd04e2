// The BSDFs of receivers of manifold sampling (manifold_receivers.h). A Lambertian receiver needs its normal alone. Of others the hit is
// kept, and shaded again when a walk has found a direction: few do.
#pragma once

#include "render/integrator/hit_stages.h"
#include "render/integrator/light_path_weights.h"
#include "render/kernels/kernel.h"
#include "render/kernels/manifold_columns.h"

namespace blush::inline BLUSH_ISA {

// A receiver for one direction.
template <class F> struct ReceiverBsdf {
    Vec<F> f_cos; // f |cos|; of Lambertian receivers |cos| alone
    F pdf;        // of the direction by BSDF sampling, 1/sr
    F reverse;    // of the direction to the vertex before, for light that comes from there, 1/sr; 1 at Lambertian receivers
    F cosine;     // with the shading normal; at least 0
    Mask<F> lambertian;
};

// Keeps the hit of path.ray as that of receiver or slot i, or that it is Lambertian. `width`: of the texture filter, metres.
template <class F> void keep_receiver_hit(ReceiverHitColumns& c, int i, int from, const Path<F>& path, const Hit<F>& hit, const F& width,
                                          const Mask<F>& lambertian) {
    c.geometry[i] = lane(select(lambertian, Int<F>(-1), hit.geometry), from);
    c.instance[i] = lane(hit.instance, from);
    c.triangle[i] = lane(hit.triangle, from);
    c.u[i] = lane(hit.u, from);
    c.v[i] = lane(hit.v, from);
    c.width[i] = lane(width, from);
    c.wo.x[i] = -lane(path.ray.direction.x, from);
    c.wo.y[i] = -lane(path.ray.direction.y, from);
    c.wo.z[i] = -lane(path.ray.direction.z, from);
}
inline void copy3(Columns3& to, int i, const Columns3& from, int k) { to.x[i] = from.x[k], to.y[i] = from.y[k], to.z[i] = from.z[k]; }
inline void copy_receiver_hit(ReceiverHitColumns& to, int i, const ReceiverHitColumns& from, int k) {
    to.geometry[i] = from.geometry[k], to.instance[i] = from.instance[k], to.triangle[i] = from.triangle[k];
    to.u[i] = from.u[k], to.v[i] = from.v[k], to.width[i] = from.width[k];
    copy3(to.wo, i, from.wo, k);
}

// Sets the values of receivers that are not Lambertian, as scatter() and continue_ratios() have them.
template <Features S, class F>
[[gnu::noinline, gnu::flatten]] void shade_receivers(const KernelContext& context, const ReceiverHitColumns& c, const Int<F>& index,
                                                     const Vec<F>& wi, const Mask<F>& active, ReceiverBsdf<F>& at) {
    const SceneTables& scene = *context.scene;
    const EnergyTable* energy = context.settings.energy;
    const Hit<F> hit{F(1.f),
                     gather(c.u, index),
                     gather(c.v, index),
                     select(active, gather(c.geometry, index), Int<F>(0)),
                     select(active, gather(c.instance, index), Int<F>(-1)),
                     select(active, gather(c.triangle, index), Int<F>(0))};
    const Vec<F> wo{gather(c.wo.x, index), gather(c.wo.y, index), gather(c.wo.z, index)};
    const Surface<F> surface = surface_at<S, F>(scene, hit, active, gather(c.width, index));
    MaterialPoint<F> material = material_at<S, F>(scene.materials, surface.material, surface.texture, surface.color, active);
    const ShadingFrame<F> frame = shading_frame_at<S, F>(surface, material, wo, dot(surface.ng, wo) > F(0.f), Mask<F>(false));
    const Bsdf<F> bsdf = make_bsdf<S, F>(material.bsdf, frame.wo, energy);
    const BsdfValue<F> value = eval<S, F>(bsdf, frame.wo, frame.frame.to_local(wi));
    const Mask<F> lit = active && dot(wi, frame.ns) > F(0.f) && dot(wi, frame.ng) > F(0.f);
    const ViewedPoint<F> back = view_point<S, F>(scene, energy, surface, material, bsdf, wi, wo, false, lit);
    at.f_cos = select<F>(active, select<F>(lit, value.f_cos, splat<F>(0.f)), at.f_cos);
    at.pdf = select(active, select(lit, value.pdf, F(0.f)), at.pdf);
    at.reverse = select(active, select(lit, back.value.pdf, F(0.f)), at.reverse);
}

// At receivers with the normals `ns`, for the direction `wi`.
template <Features S, class F> ReceiverBsdf<F> receiver_bsdf(const KernelContext& context, const ReceiverHitColumns& c, const Int<F>& index,
                                                             const Vec<F>& ns, const Vec<F>& wi, const Mask<F>& active) {
    ReceiverBsdf<F> at;
    at.cosine = max(dot(wi, ns), F(0.f));
    at.f_cos = splat<F>(1.f) * at.cosine;
    at.pdf = cosine_hemisphere_pdf(at.cosine);
    at.reverse = F(1.f);
    at.lambertian = as_mask(gather(c.geometry, index) < 0);
    if (const Mask<F> others = active && !at.lambertian; any(others)) shade_receivers<S, F>(context, c, index, wi, others, at);
    return at;
}

} // namespace blush::inline BLUSH_ISA
