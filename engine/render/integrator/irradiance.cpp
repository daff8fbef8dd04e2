#include "render/integrator/irradiance.h"

#include "render/integrator/wavefront.h"

#include <algorithm>
#include <numbers>

namespace blush {
namespace {

constexpr Features features = all_features;

Path<float> leave(const MeterPoint& receiver, const Sampler<float>& sampler, int slot) {
    const Pair<float> u = sampler.pair(first_scatter_dimension + bsdf_dimension);
    const Vec3 local = sample_cosine_hemisphere<float>(u.x(), u.y());
    Path<float> path;
    path.ray = {receiver.position, normalize(basis_around(receiver.normal).to_world(local))};
    path.beta = {1, 1, 1};
    path.pdf = cosine_hemisphere_pdf<float>(local.z);
    path.normal = receiver.normal;
    path.key = sampler.key;
    path.index = sampler.index;
    path.slot = slot;
    path.cone = 0;
    return path;
}

} // namespace

Step<float> sample_light_at_meter(const KernelContext& context, const MeterPoint& receiver, const Sampler<float>& sampler, int32_t part) {
    const SceneTables& scene = *context.scene;
    Step<float> step{};
    const LightPoint<float> light = sample_light_point<features, float>(scene, sampler.pair(first_scatter_dimension + light_dimension),
                                                                        {receiver.position, receiver.normal}, true);
    const Vec3 rough_to = light.infinite ? light.position : light.position - receiver.position;
    const Vec3 end = offset_origin<float>(light.position, light.error, light.normal, dot(rough_to, light.normal) < 0);
    const Vec3 to = light.infinite ? light.position : end - receiver.position;
    const float distance_squared = dot(to, to), distance = std::sqrt(distance_squared);
    const Vec3 wi = to / distance;
    const float cosine = dot(wi, receiver.normal);
    const IncidentLight<float> in = incident_light<features, float>(scene, light, wi, distance_squared);
    bool only_sampled = light.delta;
    step.shadow_mask = other_ray_mask;
    if (scene.links.lit_sets && light.valid) {
        only_sampled = only_sampled || has_own_shadows<float>(scene.links, light.light, true);
        step.shadow_mask = shadow_mask<float>(scene.links, light.light);
    }
    const bool lit = !scene.links.lit_sets || !light.valid || is_lit<float>(scene.links, light.light, part, true);
    const float weight = nee_mis_weight<float>(context.settings.mis, in.pdf, cosine_hemisphere_pdf<float>(cosine), only_sampled);
    step.direct = in.radiance * (cosine * inv_pi * weight / in.pdf);
    step.light = light.light;
    step.connects = light.valid && lit && cosine > 0 && has_light<float>(step.direct);
    step.shadow = {receiver.position, wi};
    step.shadow_distance = light.infinite ? infinity : distance * (1.f - 4e-7f);
    return step;
}

void begin_paths_at_meter(const KernelContext& context, const MeterPoint& receiver, uint32_t replicate, int samples, TileScratch& scratch) {
    const uint32_t key = pixel_key<float>(replicate, 0u, randomisation(context.seed, 0));
    PathQueue& paths = scratch.paths[0];
    paths.size = scratch.shadows.size = 0;
    const bool blends = context.scene->blends;
    for (int i = 0; i < samples; ++i) {
        const Sampler<float> sampler{key, uint32_t(i)};
        paths.part[paths.size] = from_meter;
        paths.dispersed[paths.size] = 0;
        append<features, float>(paths, leave(receiver, sampler, i), true);
        if (context.scene->lights.count == 0) continue;
        const Step<float> step = sample_light_at_meter(context, receiver, sampler, from_meter);
        if (!step.connects) continue;
        if (blends) scratch.shadows.random[scratch.shadows.size] = opacity_random<float>(key, uint32_t(i), 1);
        scratch.shadows.mask[scratch.shadows.size] = step.shadow_mask;
        if (scratch.trials) record_trials<float>(scratch, step, true);
        append<float>(scratch.shadows, step, i, true);
    }
}

namespace {

// Follows the paths in scratch.paths[0]. `after_first` is called when their first surfaces have been shaded, before NEE there.
template <class AfterFirst> void follow_paths(const KernelContext& context, TileScratch& scratch, const AfterFirst& after_first) {
    PathQueue *now = &scratch.paths[0], *next = &scratch.paths[1];
    for (int bounce = 1; now->size > 0 && bounce <= max_path_length; ++bounce) {
        trace_paths<features, float>(context, scratch, *now, *next, bounce);
        shade_paths<features, float>(context, scratch, *now, *next, bounce);
        if (bounce == 1) after_first(*now);
        connect_paths<features, float>(context, scratch, bounce);
        std::swap(now, next);
    }
}

void clear_radiance(TileScratch& scratch, int samples) {
    std::fill_n(scratch.r.data, samples, 0.0);
    std::fill_n(scratch.g.data, samples, 0.0);
    std::fill_n(scratch.b.data, samples, 0.0);
}

} // namespace

Vec3d estimate_irradiance(KernelContext context, const MeterPoint& receiver, uint32_t replicate, int samples, TileScratch& scratch) {
    context.settings.reuse = {};
    if (context.settings.max_bounces < 1) context.settings.max_bounces = 1;
    samples = std::clamp(samples, 1, max_irradiance_samples);
    clear_radiance(scratch, samples);
    begin_paths_at_meter(context, receiver, replicate, samples, scratch);
    connect_paths<features, float>(context, scratch, 0);
    follow_paths(context, scratch, [](const PathQueue&) {});
    Vec3d sum{0, 0, 0};
    for (int i = 0; i < samples; ++i) sum = sum + Vec3d{scratch.r[i], scratch.g[i], scratch.b[i]};
    return sum * (std::numbers::pi / samples);
}

Vec3d GatheredRays::irradiance() const {
    Vec3d sum{0, 0, 0};
    for (const Vec3d& r : radiance) sum = sum + r;
    return sum * (std::numbers::pi / double(std::max<size_t>(1, radiance.size())));
}

GatheredRays gather_indirect(KernelContext context, const MeterPoint& receiver, uint32_t replicate, int samples, TileScratch& scratch) {
    context.settings.reuse = {};
    samples = std::clamp(samples, 1, max_irradiance_samples);
    clear_radiance(scratch, samples);
    begin_paths_at_meter(context, receiver, replicate, samples, scratch);
    GatheredRays rays;
    const auto count = size_t(samples);
    rays.direction.resize(count);
    rays.distance.assign(count, infinity);
    for (int i = 0; i < samples; ++i) {
        const PathQueue& q = scratch.paths[0];
        rays.direction[size_t(i)] = {q.dx[i], q.dy[i], q.dz[i]};
    }
    follow_paths(context, scratch, [&](const PathQueue& now) {
        for (int k = 0; k < now.size; ++k)
            if (scratch.hits.geometry[k] >= 0) rays.distance[size_t(now.slot[k])] = scratch.hits.t[k];
        clear_radiance(scratch, samples); // emission that these rays found is direct light
    });
    for (int i = 0; i < samples; ++i) rays.radiance.push_back({scratch.r[i], scratch.g[i], scratch.b[i]});
    return rays;
}

} // namespace blush
