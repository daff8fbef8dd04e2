#include "render/comparison/photon_map.h"

#include "render/comparison/hit_shading.h"
#include "render/film/first_surfaces.h"

#include <numbers>

namespace blush {
namespace {

constexpr uint32_t gather_seed = 0x9b0704u; // any

} // namespace

bool PhotonMap::prepare(const PreparationContext& context) {
    radius_ = photon_radius(options_, context.scene);
    photons_.begin(context);
    PreparationContext whole = context;
    const bool gathers = options_.gather > 0;
    if (gathers) --whole.kernel.settings.max_bounces; // the gather rays scatter once more
    // What comes from a light directly is direct light, but where gather rays look.
    return photons_.trace(whole, {.paths = options_.photons_per_pass(), .min_bounces = gathers ? 0 : 1, .radius = radius_});
}

Vec3d PhotonMap::density(const Vec3d& at, const Vec3d& normal) const {
    Vec3d flux{0, 0, 0};
    photons_.for_each_near(at, normal, radius_, [&](const Photon& photon) {
        if (dot(to_double(photon.towards), normal) > 0) flux = flux + to_double(photon.flux);
    });
    return flux * (std::numbers::inv_pi / (radius_ * radius_ * double(options_.photons_per_pass())));
}

Vec3d PhotonMap::gather(const KernelContext& context, const DiffusePoint& point, TileScratch& scratch) const {
    const uint32_t replicate = pcg_hash(point.sampler.key + pcg_hash(point.sampler.index ^ gather_seed));
    begin_paths_at_meter(context, point.receiver, replicate, options_.gather, scratch);
    trace_first_surfaces(context, other_ray_mask, scratch);
    Vec3d sum{0, 0, 0};
    for (int k = 0; k < scratch.paths[0].size; ++k) {
        const Hit<float> hit = load_hit<float>(scratch.hits, k);
        if (hit.geometry < 0 || hit.instance == sphere_instance) continue;
        Path<float> path = load_path<comparison_features, float>(scratch.paths[0], k);
        path.dispersed = 0;
        const HitShading p = shade_hit(context, path, hit, 0);
        if (!p.scatters || !(max_component(p.bsdf.diffuse) > 0)) continue;
        const Vec3d irradiance = density(to_double(p.surface.position), to_double(p.shading.ns));
        sum = sum + irradiance * to_double(p.beta * p.bsdf.diffuse) * std::numbers::inv_pi;
    }
    return sum * (std::numbers::pi / options_.gather);
}

void PhotonMap::irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                           std::span<Vec3d> out) const {
    for (size_t i = 0; i < points.size(); ++i) {
        const MeterPoint& receiver = points[i].receiver;
        out[i] =
            options_.gather > 0 ? gather(context, points[i], scratch) : density(to_double(receiver.position), to_double(receiver.normal));
    }
}

} // namespace blush
