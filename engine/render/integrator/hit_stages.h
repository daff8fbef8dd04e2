// Stages of scatter() (estimator.h) from the hit to the BSDF: emission that the path's ray hit, absorption, the shading point, and
// the data that the film and path reuse keep of it. Masks select lanes; values in other lanes are arbitrary.
#pragma once

#include "render/integrator/dispersion.h"
#include "render/integrator/emission_hit.h"
#include "render/integrator/ray_cone.h"
#include "render/integrator/shading_frame.h"
#include "shading/bsdf.h"

namespace blush::inline BLUSH_ISA {

// What the path's ray hit.
template <class F> struct HitLanes {
    Mask<F> met;          // anything
    Mask<F> surface;      // a surface with a material
    Mask<F> sphere;       // a sphere light
    Int<F> sphere_object; // 0: none
};

// Environment and suns in the lanes of `escaped`: adds beta L_e with its MIS weight.
template <Features S, class F> [[gnu::always_inline]] inline void hit_background(const SceneTables& scene,
                                                                                 const EstimatorSettings& settings, const Path<F>& path,
                                                                                 int bounce, const Mask<F>& escaped, Step<F>& out) {
    if constexpr (S.has(Feature::environment) || S.has(Feature::suns)) {
        if (any(escaped)) {
            const BackgroundLight<F> light = background_light<S, F>(scene, settings, path, bounce, escaped);
            out.emitted = select<F>(escaped, path.beta * light.radiance, out.emitted);
            out.weights.emission = light.weight;
        }
    }
    out.emits = escaped;
}

// Sphere lights in the lanes of `met`: adds beta L_e with its MIS weight. They reflect nothing: the path ends.
template <Features S, class F> [[gnu::always_inline]] inline HitLanes<F> hit_sphere_light(const SceneTables& scene, const MisSettings& mis,
                                                                                          const Path<F>& path, const Hit<F>& hit,
                                                                                          const Mask<F>& met, Step<F>& out) {
    HitLanes<F> lanes{met, met, Mask<F>(false), Int<F>(0)};
    if constexpr (S.has(Feature::sphere_lights)) {
        lanes.sphere = met && as_mask(hit.instance == sphere_instance);
        if (any(lanes.sphere)) {
            const SphereEmissionHit<F> sphere = sphere_emission_hit<S, F>(scene, mis, path, hit.triangle, hit.t, lanes.sphere);
            out.emitted = select<F>(lanes.sphere, path.beta * sphere.radiance, out.emitted);
            out.weights.emission = select(lanes.sphere, sphere.weight, out.weights.emission);
            out.emits = out.emits || lanes.sphere;
            lanes.sphere_object = select(lanes.sphere, sphere.object, lanes.sphere_object);
            lanes.surface = met && !lanes.sphere;
        }
    }
    return lanes;
}

// Texture footprint (metres) at panes. Only camera rays filter: elsewhere a pane's transmittance is compared with that seen by
// shadow rays, which do not filter textures.
template <class F> F pane_width(const F& cone, int bounce) { return bounce == 0 ? cone : F(0.f); }

// Width (metres) over which textures of the hit surface are filtered; `cone`: that of the path (ray_cone.h).
template <Features S, class F> [[gnu::always_inline]] inline F filter_width(const SceneTables& scene, const Hit<F>& hit, const F& cone,
                                                                            int bounce, const Mask<F>& surface) {
    if constexpr (S.has(Feature::transmission) && S.has(Feature::textures))
        if (scene.panes) return select(is_pane<S, F>(scene, hit, surface), pane_width<F>(cone, bounce), cone);
    return cone;
}

// The side from which the path's ray hit the surface.
template <class F> struct HitSide {
    Vec<F> wo;     // unit, world: against the ray
    F cos_wo;      // between wo and the outward geometric normal
    Mask<F> front; // outside
    Mask<F> solid; // the surface bounds a solid
};
template <Features S, class F>
[[gnu::always_inline]] inline HitSide<F> hit_side(const Surface<F>& surface, const MaterialPoint<F>& material, const Vec<F>& direction) {
    HitSide<F> side;
    side.wo = -direction;
    side.cos_wo = dot(surface.ng, side.wo);
    side.front = side.cos_wo > F(0.f);
    side.solid = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) side.solid = is_solid<S, F>(material.bsdf);
    return side;
}

// True where light is reflected within a solid that some of it leaves there; false for total internal reflection. `crosses`: it is
// refracted. With the BSDF for the way that it came.
template <Features S, class F> Mask<F> reflects_partly_within(const HitSide<F>& side, const Bsdf<F>& bsdf, const Mask<F>& crosses) {
    if constexpr (!S.has(Feature::transmission)) return Mask<F>(false);
    return side.solid && !side.front && !crosses && !totally_reflects(bsdf.interface, bsdf.cos);
}

// Throughput behind a segment of t metres that ends here from within a solid: beta exp(-sigma_a t) (Beer-Lambert).
template <Features S, class F> [[gnu::always_inline]] inline Vec<F> attenuate(const Vec<F>& beta, const MaterialPoint<F>& material,
                                                                              const F& t, const HitSide<F>& side, const Mask<F>& surface) {
    if constexpr (S.has(Feature::absorption)) {
        const Mask<F> within = surface && side.solid && !side.front;
        if (any(within)) {
            const Vec<F> optical_depth = material.sigma_a * t;
            const Vec<F> transmittance{blush::exp(-optical_depth.x), blush::exp(-optical_depth.y), blush::exp(-optical_depth.z)};
            return select<F>(within, beta * transmittance, beta);
        }
    }
    return beta;
}

// Emissive triangles: adds beta L_e w_bsdf, the emission with its MIS weight against NEE (Veach 1997, 9.2; emission_hit.h).
template <Features S, class F> [[gnu::always_inline]] inline void hit_emitter(const SceneTables& scene, const MisSettings& mis,
                                                                              const Path<F>& path, const Hit<F>& hit, const Surface<F>& at,
                                                                              const MaterialPoint<F>& material, const HitSide<F>& side,
                                                                              const Vec<F>& beta, const Mask<F>& surface, Step<F>& out) {
    if constexpr (S.has(Feature::emissive_triangles)) {
        const Mask<F> emitting = surface && max_component(material.emission) > F(0.f) && (side.front || material.double_sided);
        if (any(emitting)) {
            const F facing = abs(side.cos_wo);
            Vec<F> emission = material.emission;
            if constexpr (S.has(Feature::clearcoat)) emission = emission * through_clearcoat(material.bsdf.layers.clearcoat, facing);
            const EmissionHit<F> light =
                emission_hit<S, F>(scene, mis, path, {at.part, at.position, at.ng}, hit, facing, emission, emitting);
            out.emitted = select<F>(emitting, beta * light.radiance * light.weight, out.emitted);
            out.weights.emission = select(emitting, light.weight, out.weights.emission);
            out.emits = out.emits || emitting;
        }
    }
}

// Unlit surfaces: every ray sees their colour; they neither scatter nor are sampled as lights. Returns the lanes that scatter.
template <Features S, class F> [[gnu::always_inline]] inline Mask<F> hit_unlit(const MaterialPoint<F>& material, const Vec<F>& beta,
                                                                               const Mask<F>& surface, Step<F>& out) {
    if constexpr (S.has(Feature::unlit)) {
        const Mask<F> unlit = surface && material.unlit;
        out.emitted = select<F>(unlit, beta * material.bsdf.base_color, out.emitted);
        out.emits = out.emits || unlit;
        return surface && !unlit;
    }
    return surface;
}

// Dispersive solids: a path that meets its first one gets a single wavelength, whose index of refraction replaces `ior`
// (dispersion.h). Returns the lanes that carry one.
template <Features S, class F> [[gnu::always_inline]] inline Mask<F>
disperse(const Path<F>& path, const F& dispersion, const HitSide<F>& side, const Mask<F>& scatters, F& ior, Vec<F>& beta) {
    if constexpr (!S.has(Feature::dispersion)) return Mask<F>(false);
    const Mask<F> dispersed = as_mask(path.dispersed != 0);
    const Mask<F> splits = scatters && side.solid && dispersion > F(0.f);
    if (!any(splits)) return dispersed;
    const Wavelength<F> light = wavelength_of(Sampler<F>{path.key, path.index});
    ior = select(splits, dispersed_ior(ior, dispersion, light.nanometres), ior);
    beta = select<F>(splits && !dispersed, beta * light.rgb, beta);
    return dispersed || splits;
}

// Where a path meets a surface, with the BSDF for the way that it came. scatter() does not use it: the compiler does not remove copies.
template <class F> struct ShadedHit {
    Surface<F> surface;
    MaterialPoint<F> material; // with the index of refraction of the path's wavelength
    HitSide<F> side;
    Vec<F> arriving; // throughput behind the absorption on the way,
    Vec<F> beta;     // and as that of the path's wavelength
    Mask<F> scatters, dispersed;
    ShadingFrame<F> shading;
    Bsdf<F> bsdf;
};
// In the lanes of `met`. `width`: of the texture filter, metres.
template <Features S, class F> [[gnu::always_inline]] inline ShadedHit<F>
shade_hit(const SceneTables& scene, const EnergyTable* energy, const Path<F>& path, const Hit<F>& hit, const Mask<F>& met, const F& width) {
    ShadedHit<F> p;
    p.surface = surface_at<S, F>(scene, hit, met, width);
    p.material = material_at<S, F>(scene.materials, p.surface.material, p.surface.texture, p.surface.color, met);
    p.side = hit_side<S, F>(p.surface, p.material, path.ray.direction);
    p.arriving = p.beta = attenuate<S, F>(path.beta, p.material, hit.t, p.side, met);
    p.scatters = met && !p.material.unlit;
    p.shading = shading_frame_at<S, F>(p.surface, p.material, p.side.wo, p.side.front, p.side.solid);
    p.dispersed = disperse<S, F>(path, p.material.dispersion, p.side, p.scatters, p.material.bsdf.ior, p.beta);
    p.bsdf = make_bsdf<S, F>(p.material.bsdf, p.shading.wo, energy);
    return p;
}

// A surface point with its BSDF. Refers to its parts, because the compiler does not remove copies of them.
template <class F> struct ShadingPoint {
    const Surface<F>& surface;
    const BsdfParams<F>& params;
    const ShadingFrame<F>& shading;
    const Bsdf<F>& bsdf;
    Vec<F> beta; // throughput of the path up to here
    Mask<F> scatters;
    Mask<F> lambertian; // and the BSDF is Lambertian
    Mask<F> solid;      // the surface bounds a solid
    Mask<F> dispersed;  // the path carries a single wavelength
};

// First-hit planes. The albedo of what does not scatter is its emission, so that the denoiser sees its edges.
template <Features S, class F> [[gnu::always_inline]] inline void first_hit_planes(const SceneTables& scene, const Hit<F>& hit,
                                                                                   const HitLanes<F>& lanes, const ShadingPoint<F>& p,
                                                                                   const Vec<F>& wo_world, const Vec<F>& emitted,
                                                                                   FirstHit<F>& first) {
    first.albedo = select<F>(lanes.surface, albedo<S, F>(p.bsdf, p.shading.wo), emitted);
    first.normal = select<F>(lanes.surface, p.shading.ns, select<F>(lanes.sphere, wo_world, splat<F>(0.f)));
    first.depth = select(lanes.met, hit.t, F(0.f));
    first.object = select(lanes.surface, gather_field(scene.parts, &PartRecord::object, p.surface.part), lanes.sphere_object);
    first.material = select(lanes.surface, p.surface.material, Int<F>(-1));
}

// The vertex as path reuse connects to it (path_reuse.h).
template <class F> [[gnu::always_inline]] inline void set_reuse_vertex(const ShadingPoint<F>& p, ReuseVertex<F>& v) {
    v.lambertian = p.lambertian && !p.shading.behind;
    v.position = p.surface.position;
    v.clearance = clearance(p.shading.ng, p.surface.error);
    v.ng = p.shading.ng;
    v.ns = p.shading.ns;
    v.reflectance = p.bsdf.diffuse;
}

} // namespace blush::inline BLUSH_ISA
