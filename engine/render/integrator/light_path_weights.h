// MIS with light paths: paths from lights whose vertices are connected to the camera (t = 1; Veach 1997, section 10.2). They carry only
// light that leaves its first surface by other lobes than Lambertian ones and sheen (facet_share), and only if the camera does not see this
// surface: light by glass, mirrors and glaze. NEE finds the rest better.
//
// A path with vertices x1 (seen by the camera) ... xk and the light y has the densities, with p' = pdf / |cos| over projected solid angle,
//
//     camera, hits the light:  p(x1) p'(x1) ... p'(xk)               times the geometry terms, which all strategies share
//     NEE:                     p(x1) p'(x1) ... p'(xk-1) p'nee(xk)
//     light path:              N p'(y) p'rev(xk) ... p'rev(x2)
//
// p(x1) is the density of camera rays in pixels per m2, N the number of light paths for one camera sample of every pixel, and p'(y) that of
// emission (light_emission.h); p'rev(xk), of the first surface, is that of the lobes named above. So along a camera path the ratio N
// p'rev(x2) ... p'rev(xi) / (p(x1) p'(x1) ... p'(xi)) is kept, one factor for each vertex, and along a light path the inverse. Delta lobes
// have the factor 1 in both directions; a light path cannot be connected to the camera there (Georgiev 2012, "Implementing Vertex
// Connection and Merging", has these quantities for all connections). Probabilities of Russian roulette are left out of all densities:
// weights add up to 1 for any densities that all strategies agree on.
#pragma once

#include "render/integrator/light_sampling.h"
#include "render/integrator/path.h"
#include "render/integrator/shading_frame.h"
#include "shading/bsdf.h"
#include "shading/path_guiding.h"

namespace blush::inline BLUSH_ISA {

// Cosines of grazing directions are clamped, so that no ratio overflows.
template <class F> F clamped_cosine(const Vec<F>& normal, const Vec<F>& direction) { return max(abs(dot(normal, direction)), F(1e-6f)); }

// MIS weight (power heuristic) of a sample that has this weight without light paths; `ratio`: of their density to its own.
template <class F> F weight_beside(const F& weight, const F& ratio) {
    const F r = min(ratio, F(1e18f)); // its square is finite
    return weight / (1.f + weight * (r * r));
}

// Camera rays per area perpendicular to `direction` at distance `t` along it: pixels / m2, for one sample of every pixel.
template <class F> F camera_density(const CameraRecord& camera, const EstimatorSettings& settings, const Vec<F>& direction, const F& t) {
    const float pixels = settings.width * settings.height / (4 * length(camera.right) * length(camera.up));
    if (camera.orthographic) return F(pixels);
    const F cosine = max(dot(direction, splat<F>(camera.forward)), F(1e-6f));
    return F(pixels) / max(F(cosine * cosine * cosine * (t * t)), F(1e-30f));
}

// The BSDF of a point for a viewer of its own.
template <class F> struct ViewedPoint {
    BsdfValue<F> value; // f |cos(wi)|, and the pdf of wi; 0 where shading and geometric normal disagree about the side of wi
    F pdf;              // of wi with path guiding
    F facet_share;      // of value.pdf
    Mask<F> behind;     // ShadingFrame::behind
};
// In the lanes of `active`. `known`: the BSDF as seen from anywhere.
template <Features S, class F>
[[gnu::noinline, gnu::flatten]] ViewedPoint<F> view_point(const SceneTables& scene, const EnergyTable* energy, const Surface<F>& surface,
                                                          MaterialPoint<F> material, const Bsdf<F>& known, const Vec<F>& viewer,
                                                          const Vec<F>& wi, bool guided, const Mask<F>& active) {
    const Mask<F> front = dot(surface.ng, viewer) > F(0.f);
    Mask<F> solid = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) solid = is_solid<S, F>(material.bsdf);
    const ShadingFrame<F> frame = shading_frame_at<S, F>(surface, material, viewer, front, solid);
    const Mask<F> lambertian = is_lambertian<S, F>(known);
    const F cosine = dot(wi, frame.ns);
    ViewedPoint<F> p;
    p.behind = frame.behind;
    p.value.pdf = cosine_hemisphere_pdf(cosine);
    p.value.f_cos = known.diffuse * p.value.pdf;
    p.facet_share = F(0.f);
    if (any(active && !lambertian)) {
        const Bsdf<F> bsdf = make_bsdf<S, F>(material.bsdf, frame.wo, energy);
        const BsdfValue<F> value = eval<S, F>(bsdf, frame.wo, frame.frame.to_local(wi));
        p.value.f_cos = select<F>(lambertian, p.value.f_cos, value.f_cos);
        p.value.pdf = select(lambertian, p.value.pdf, value.pdf);
        p.facet_share = select(lambertian, F(0.f), facet_share<S, F>(bsdf, frame.frame.to_local(wi), value.pdf));
    }
    const Mask<F> same_side = (cosine > F(0.f)) == (dot(wi, frame.ng) > F(0.f));
    p.value.f_cos = select<F>(same_side, p.value.f_cos, splat<F>(0.f));
    p.value.pdf = select(same_side, p.value.pdf, F(0.f));
    p.pdf = p.value.pdf;
    if (guided && !scene.guides.empty() && any(active && lambertian)) {
        const auto guide = direction_guide_at<F>(scene.guides, surface.position, frame.ns, active && lambertian);
        p.pdf = select(same_side, guided_pdf<F>(scene.guides, guide, wi, p.value.pdf), F(0.f));
    }
    return p;
}

// The point of a light that the ray from `origin` along `wi` finds at `position`.
template <Features S, class F> EmissionPoint<F> emission_point(const SceneTables& scene, const Int<F>& light, const Vec<F>& position,
                                                               const Vec<F>& normal, const Vec<F>& wi, const Mask<F>& active) {
    const LightRecord* lights = scene.lights.lights;
    EmissionPoint<F> p;
    p.light = select(active, light, Int<F>(0));
    const Int<F> kind = gather_field(lights, &LightRecord::kind, p.light), flags = gather_field(lights, &LightRecord::flags, p.light);
    const auto is = [&](LightKind wanted) { return as_mask(kind == int32_t(wanted)); };
    p.point = is(LightKind::point);
    p.infinite = is(LightKind::sun) || is(LightKind::environment);
    p.two_sided = is(LightKind::triangle) && as_mask((flags & int32_t(light_two_sided)) != 0);
    p.position = position;
    p.normal = normal;
    p.away = -wi;
    p.density = select(is(LightKind::triangle), gather_field(lights, &LightRecord::inverse_area, p.light), F(1.f));
    const F radius = gather_field(lights, &LightRecord::radius, p.light);
    p.density = select(is(LightKind::sphere), F(0.25f * inv_pi) / (radius * radius), p.density);
    const F height = gather_field(lights, &LightRecord::cone_height, p.light);
    p.density = select(is(LightKind::sun) && height > F(0.f), cone_pdf(height), p.density);
    if constexpr (S.has(Feature::environment))
        if (const Mask<F> sky = active && is(LightKind::environment); scene.lights.samples_environment && any(sky))
            p.density = select(sky, environment_pdf<F>(scene.environment, wi), p.density);
    return p;
}

// Pdf of NEE at a receiver for the point of a light that emits towards it, over the solid angle there. Of lights without size: as if the
// point had an area of 1 m^2 that faces the receiver. In the lanes of `active`.
template <Features S, class F>
F nee_pdf(const SceneTables& scene, const Receiver<F>& to, const EmissionPoint<F>& at, const Mask<F>& active) {
    const Vec<F> to_light = at.position - to.position;
    const F d2 = dot(to_light, to_light);
    const Int<F> kind = gather_field(scene.lights.lights, &LightRecord::kind, at.light);
    const Mask<F> sphere = as_mask(kind == int32_t(LightKind::sphere)), sky = active && as_mask(kind == int32_t(LightKind::environment));
    const F radius = gather_field(scene.lights.lights, &LightRecord::radius, at.light);
    const Vec<F> to_center = gather_field3<F>(scene.lights.lights, &LightRecord::position, at.light) - to.position;
    const F height = sphere_cone_height(dot(to_center, to_center), radius);
    F pdf = select(at.infinite, at.density, at.density * d2 / max(emission_cosine(at), F(1e-6f)));
    pdf = select(sphere, select(height > F(0.f), cone_pdf(select(height > F(0.f), height, F(1.f))), F(0.f)), pdf);
    pdf = pdf * nee_probability<S, F>(scene, to, at.light, active && !sky);
    if (any(sky)) pdf = select(sky, environment_nee_pdf<S, F>(scene, to, -at.away, sky), pdf);
    return pdf;
}

// Density of light paths over that of the camera path that hits a light. `position`: at infinity any point of the ray.
template <Features S, class F> F light_path_ratio(const SceneTables& scene, const Path<F>& path, const Int<F>& light,
                                                  const Vec<F>& position, const Vec<F>& normal, const Mask<F>& active) {
    if constexpr (S.has(Feature::light_paths)) {
        const Mask<F> connects = active && as_mask(light >= 0) && as_mask(light < scene.emission.lights) && path.emission_ratio > F(0.f);
        if (scene.emission.empty() || !any(connects)) return F(0.f);
        const auto point = emission_point<S, F>(scene, light, position, normal, path.ray.direction, connects);
        return select(connects, path.emission_ratio * emission_density<F>(scene.emission, point, connects), F(0.f));
    } else
        return F(0.f);
}

} // namespace blush::inline BLUSH_ISA
