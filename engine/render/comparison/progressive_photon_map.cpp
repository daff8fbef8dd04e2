#include "render/comparison/progressive_photon_map.h"

#include "render/comparison/hit_shading.h"
#include "render/integrator/wavefront.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace blush {
namespace {

void add_radiance(TileScratch& tile, int slot, const Vec3d& radiance) {
    tile.r[slot] += radiance.x;
    tile.g[slot] += radiance.y;
    tile.b[slot] += radiance.z;
}

} // namespace

double progressive_radius(double first, double alpha, int64_t sample) {
    double squared = first * first;
    for (int64_t i = 1; i <= sample; ++i) squared *= (double(i) + alpha) / (double(i) + 1);
    return std::sqrt(squared);
}

bool ProgressivePhotonMap::prepare(const PreparationContext& context) {
    first_radius_ = photon_radius(options_, context.scene);
    photons_.begin(context);
    return true;
}

bool ProgressivePhotonMap::prepare_sample(int64_t sample, const PreparationContext& context) {
    radius_ = progressive_radius(first_radius_, double(options_.alpha), sample);
    return photons_.trace(
        context,
        {.paths = options_.photons_per_pass(), .pass = uint32_t(sample), .at = PhotonSelection::At::scattering, .radius = radius_});
}

Vec3d ProgressivePhotonMap::reflected(const KernelContext& context, const Path<float>& path, const Hit<float>& hit, int bounce) const {
    const float cone = cone_width<float>(context.scene->camera, context.settings, path, hit.t);
    const HitShading p = shade_hit(context, path, hit, filter_width<all_features, float>(*context.scene, hit, cone, bounce, true));
    if (!p.scatters || is_delta_only<float>(p.bsdf)) return {0, 0, 0};
    Vec3d sum{0, 0, 0};
    photons_.for_each_near(to_double(p.surface.position), to_double(p.shading.ng), radius_, [&](const Photon& photon) {
        if (bounce + 1 > context.settings.max_bounces - photon.bounces) return;
        const Vec3 wi = p.shading.frame.to_local(photon.towards);
        const float along = dot(photon.towards, p.shading.ng);
        if ((wi.z > 0) != (along > 0)) return; // light leaks, as in scatter()
        const BsdfValue<float> f = eval<all_features, float>(p.bsdf, p.shading.wo, wi);
        // Flux over the area of the disk is irradiance: its cosine is the geometric one (Veach 1997, 5.3).
        sum = sum + to_double(f.f_cos * photon.flux) * (1.0 / double(clamped_cosine<float>(p.shading.ng, photon.towards)));
    });
    return sum * to_double(p.beta) * (std::numbers::inv_pi / (radius_ * radius_ * double(options_.photons_per_pass())));
}

void ProgressivePhotonMap::add(const KernelContext& all, const TileJob& job, TileScratch& tile, TileScratch& scratch) const {
    KernelContext context = all;
    context.settings.mis.strategy = Strategy::bsdf; // what a ray finds behind mirrors and glass counts whole
    generate_paths<all_features, float>(context, job, scratch);
    PathQueue *now = &scratch.paths[0], *next = &scratch.paths[1];
    for (int bounce = 0; now->size > 0 && bounce <= max_path_length; ++bounce) {
        trace_paths<all_features, float>(context, scratch, *now, *next, bounce);
        next->size = 0;
        for (int k = 0; k < now->size; ++k) {
            Path<float> path = load_path<all_features, float>(*now, k);
            path.part = now->part[k];
            path.dispersed = now->dispersed[k];
            const Hit<float> hit = load_hit<float>(scratch.hits, k);
            Step<float> step = scatter<all_features, float>(*context.scene, context.settings, path, hit, bounce, true);
            // The kernels have added the emission that the camera sees.
            if (bounce > 0) add_emission<all_features, float>(context, scratch, now->slot + k, k, path, bounce, true, step);
            if (hit.geometry >= 0 && hit.instance != sphere_instance)
                add_radiance(scratch, path.slot, reflected(context, path, hit, bounce));
            if (!step.continues || step.next.pdf != infinity) continue;
            next->part[next->size] = step.next.part;
            next->dispersed[next->size] = step.next.dispersed;
            append<all_features, float>(*next, step.next, true);
        }
        std::swap(now, next);
    }
    for (int slot = 0; slot < job.paths(); ++slot) add_radiance(tile, slot, {scratch.r[slot], scratch.g[slot], scratch.b[slot]});
}

} // namespace blush
