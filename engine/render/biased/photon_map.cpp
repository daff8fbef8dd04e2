#include "render/biased/photon_map.h"

#include "render/biased/cells.h"
#include "render/biased/hit_shading.h"
#include "render/film/first_surfaces.h"
#include "render/integrator/light_path_emission.h"
#include "scene/affine.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace blush {
namespace {

constexpr double auto_radius = 0.02;        // of that of the scene
constexpr double flatness = 0.2;            // half the height of the disk over its radius: what lies higher is another surface
constexpr uint32_t photon_seed = 0x9b0704u; // any

// Stores photons, and appends what goes on. `with_direct`: also photons that no surface has scattered before.
void shade_photons(const KernelContext& context, TileScratch& scratch, const PathQueue& now, PathQueue& next, int queue, int bounce,
                   bool with_direct, std::vector<Photon>& photons) {
    constexpr Features s = biased_features;
    const CameraRecord& camera = context.scene->camera;
    const float cone = camera_cone(camera, context.settings);
    next.size = 0;
    for (int k = 0; k < now.size; ++k) {
        const Hit<float> hit = load_hit<float>(scratch.hits, k);
        if (hit.geometry < 0 || hit.instance == sphere_instance) continue;
        Path<float> path = load_path<s, float>(now, k);
        path.dispersed = now.dispersed[k];
        const Vec3 to_eye = path.ray.origin + path.ray.direction * hit.t - camera.position;
        const HitShading p = shade_hit(context, path, hit, camera.orthographic ? cone : length(to_eye) * cone);
        if (!p.scatters) continue;
        if ((bounce > 0 || with_direct) && max_component(p.bsdf.diffuse) > 0) {
            const float amount = luminance(scratch.light_paths->emitted[size_t(path.slot)].flux);
            photons.push_back({p.surface.position, p.side.wo, p.beta * amount, bounce == 0});
        }
        if (bounce + 1 >= context.settings.max_bounces) continue;
        const LightVertex<float> v{p.surface, p.material, p.shading, p.bsdf,     p.side.wo,  clamped_cosine<float>(p.shading.ng, p.side.wo),
                                   p.beta,    0.f,        0.f,       p.scatters, p.dispersed};
        continue_light_path<s, float>(context, path, v, bounce, scratch, next, queue);
    }
}

// Of light paths [first, first + count).
std::vector<Photon> trace_photons(const KernelContext& context, const LightPathEmission& emission, int64_t first, int count,
                                  bool with_direct, TileScratch& scratch) {
    if (!scratch.light_paths) scratch.light_paths = std::make_unique<LightPathColumns>();
    LightPathColumns& columns = *scratch.light_paths;
    columns.key = pcg_hash(randomisation(context.seed ^ photon_seed, 0) + uint32_t(first >> place_shift));
    columns.emitted.clear();
    const auto first_index = uint32_t(first & ((int64_t(1) << place_shift) - 1));
    for (int k = 0; k < count; ++k) columns.emitted.push_back(emission.emit(*context.scene, {columns.key, first_index + uint32_t(k)}));
    std::vector<Photon> photons;
    PathQueue *now = &scratch.paths[0], *next = &scratch.paths[1];
    begin_light_paths(columns, *now);
    int queue = 0; // number of `now`
    for (int bounce = 0; now->size > 0 && bounce < context.settings.max_bounces && bounce <= max_path_length; ++bounce) {
        const RayArrays rays{now->ox, now->oy, now->oz, now->dx, now->dy, now->dz, nullptr, nullptr, other_ray_mask};
        HitColumns& h = scratch.hits;
        trace_closest<float>(*context.accel, rays, now->size, bounce < coherent_light_bounces,
                             HitArrays{h.t, h.u, h.v, h.geometry, h.instance, h.triangle});
        queue = 1 - queue;
        shade_photons(context, scratch, *now, *next, queue, bounce, with_direct, photons);
        std::swap(now, next);
    }
    return photons;
}

} // namespace

bool PhotonMap::prepare(const PreparationContext& context) {
    const double extent = std::max(double(context.scene.radius), 1e-30);
    radius_ = options_.radius > 0 ? double(options_.radius) : auto_radius * extent;
    photons_.clear();
    cells_.clear();
    if (context.kernel.scene->lights.count == 0) return true;
    KernelContext kernel = context.kernel;
    SceneTables tables = *kernel.scene;
    const LightPathEmission emission = LightPathEmission::of_all_lights(tables, context.scene);
    if (emission.empty()) return true;
    tables.emission = emission.tables(1);
    if (options_.gather > 0) --kernel.settings.max_bounces; // the gather rays scatter once more
    kernel.scene = &tables;
    const int64_t tiles = (int64_t(options_.photons) + tile_capacity - 1) / tile_capacity;
    std::vector<std::vector<Photon>> of_tile{size_t(tiles)};
    const bool done = context.workers.for_each(tiles, context.wanted, [&](int64_t tile, unsigned worker) {
        const int64_t first = tile * tile_capacity;
        const int count = int(std::min<int64_t>(tile_capacity, options_.photons - first));
        of_tile[size_t(tile)] = trace_photons(kernel, emission, first, count, options_.gather > 0, context.scratch_of(worker));
    });
    for (const std::vector<Photon>& photons : of_tile) photons_.insert(photons_.end(), photons.begin(), photons.end());
    sort_by_cells();
    return done;
}

void PhotonMap::sort_by_cells() {
    const auto key = [&](const Photon& photon) { return cell_of(to_double(photon.position), 2 * radius_).key(); };
    std::ranges::stable_sort(photons_, {}, key);
    for (size_t i = 0; i < photons_.size(); ++i) {
        Range& range = cells_.try_emplace(key(photons_[i]), Range{i, i}).first->second;
        range.end = i + 1;
    }
}

Vec3d PhotonMap::density(const Vec3d& at, const Vec3d& normal, bool with_direct) const {
    Vec3d flux{0, 0, 0};
    for_each_cell_near(at, 2 * radius_, [&](uint64_t key) {
        const auto found = cells_.find(key);
        if (found == cells_.end()) return;
        for (size_t k = found->second.begin; k < found->second.end; ++k) {
            const Photon& photon = photons_[k];
            const Vec3d to = to_double(photon.position) - at;
            if (!(length_squared(to) < radius_ * radius_) || !(std::abs(dot(to, normal)) < flatness * radius_)) continue;
            if ((with_direct || !photon.direct) && dot(to_double(photon.towards), normal) > 0) flux = flux + to_double(photon.flux);
        }
    });
    return flux * (std::numbers::inv_pi / (radius_ * radius_ * double(options_.photons)));
}

Vec3d PhotonMap::gather(const KernelContext& context, const DiffusePoint& point, TileScratch& scratch) const {
    const uint32_t replicate = pcg_hash(point.sampler.key + pcg_hash(point.sampler.index ^ photon_seed));
    begin_paths_at_meter(context, point.receiver, replicate, options_.gather, scratch);
    trace_first_surfaces(context, other_ray_mask, scratch);
    Vec3d sum{0, 0, 0};
    for (int k = 0; k < scratch.paths[0].size; ++k) {
        const Hit<float> hit = load_hit<float>(scratch.hits, k);
        if (hit.geometry < 0 || hit.instance == sphere_instance) continue;
        Path<float> path = load_path<biased_features, float>(scratch.paths[0], k);
        path.dispersed = 0;
        const HitShading p = shade_hit(context, path, hit, 0);
        if (!p.scatters || !(max_component(p.bsdf.diffuse) > 0)) continue;
        const Vec3d irradiance = density(to_double(p.surface.position), to_double(p.shading.ns), true);
        sum = sum + irradiance * to_double(p.beta * p.bsdf.diffuse) * std::numbers::inv_pi;
    }
    return sum * (std::numbers::pi / options_.gather);
}

void PhotonMap::irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                           std::span<Vec3d> out) const {
    for (size_t i = 0; i < points.size(); ++i) {
        const MeterPoint& receiver = points[i].receiver;
        out[i] = options_.gather > 0 ? gather(context, points[i], scratch)
                                     : density(to_double(receiver.position), to_double(receiver.normal), false);
    }
}

} // namespace blush
