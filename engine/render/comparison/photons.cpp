#include "render/comparison/photons.h"

#include "render/comparison/hit_shading.h"

#include <algorithm>
#include <utility>

namespace blush {
namespace {

constexpr double auto_radius = 0.02;        // of that of the scene
constexpr uint32_t photon_seed = 0x9b0704u; // any

bool takes_photons(const HitShading& p, PhotonSelection::At at) {
    return at == PhotonSelection::At::diffuse ? max_component(p.bsdf.diffuse) > 0 : !is_delta_only<float>(p.bsdf);
}

// Stores photons, and appends what goes on.
void shade_photons(const KernelContext& context, TileScratch& scratch, const PathQueue& now, PathQueue& next, int queue, int bounce,
                   const PhotonSelection& selection, std::vector<Photon>& photons) {
    constexpr Features s = comparison_features;
    next.size = 0;
    for (int k = 0; k < now.size; ++k) {
        const Hit<float> hit = load_hit<float>(scratch.hits, k);
        if (hit.geometry < 0 || hit.instance == sphere_instance) continue;
        Path<float> path = load_path<s, float>(now, k);
        path.dispersed = now.dispersed[k];
        const HitShading p = shade_hit(context, path, hit, 0); // textures are not filtered: see ray_cone.h
        if (!p.scatters) continue;
        if (bounce >= selection.min_bounces && takes_photons(p, selection.at)) {
            const float amount = luminance(scratch.light_paths->emitted[size_t(path.slot)].flux);
            photons.push_back({p.surface.position, p.side.wo, p.beta * amount, bounce});
        }
        if (bounce + 1 >= context.settings.max_bounces) continue;
        const LightPathVertex<float> v{p, clamped_cosine<float>(p.shading.ng, p.side.wo)};
        continue_light_path<s, float>(context, path, v, bounce, true, scratch, next, queue);
    }
}

// Of light paths [first, first + count).
std::vector<Photon> trace_photons(const KernelContext& context, const LightPathEmission& emission, int64_t first, int count,
                                  const PhotonSelection& selection, TileScratch& scratch) {
    if (!scratch.light_paths) scratch.light_paths = std::make_unique<LightPathColumns>();
    LightPathColumns& columns = *scratch.light_paths;
    columns.key = pcg_hash(randomisation(context.seed ^ photon_seed, 0) + uint32_t(first >> place_shift) + selection.pass * 0x9e3779b9u);
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
        shade_photons(context, scratch, *now, *next, queue, bounce, selection, photons);
        std::swap(now, next);
    }
    return photons;
}

} // namespace

double photon_radius(const ComparisonIntegrator& options, const CasterSphere& scene) {
    return options.radius > 0 ? double(options.radius) : auto_radius * std::max(double(scene.radius), 1e-30);
}

void PhotonGrid::begin(const PreparationContext& context) {
    const SceneTables& tables = *context.kernel.scene;
    emission_ = tables.lights.count > 0 ? LightPathEmission::of_all_lights(tables, context.scene) : LightPathEmission();
}

bool PhotonGrid::trace(const PreparationContext& context, const PhotonSelection& selection) {
    radius_ = selection.radius;
    photons_.clear();
    cells_.clear();
    if (emission_.empty()) return true;
    const int64_t tiles = (selection.paths + tile_capacity - 1) / tile_capacity;
    std::vector<std::vector<Photon>> of_tile{size_t(tiles)};
    const bool done = context.workers.for_each(tiles, context.wanted, [&](int64_t tile, unsigned worker) {
        const int64_t first = tile * tile_capacity;
        const int count = int(std::min<int64_t>(tile_capacity, selection.paths - first));
        of_tile[size_t(tile)] = trace_photons(context.kernel, emission_, first, count, selection, context.scratch_of(worker));
    });
    for (const std::vector<Photon>& photons : of_tile) photons_.insert(photons_.end(), photons.begin(), photons.end());
    sort_by_cells();
    return done;
}

void PhotonGrid::sort_by_cells() {
    const auto key = [&](const Photon& photon) { return cell_of(to_double(photon.position), 2 * radius_).key(); };
    std::ranges::stable_sort(photons_, {}, key);
    for (size_t i = 0; i < photons_.size(); ++i) {
        Range& range = cells_.try_emplace(key(photons_[i]), Range{i, i}).first->second;
        range.end = i + 1;
    }
}

} // namespace blush
