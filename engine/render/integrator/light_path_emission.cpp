#include "render/integrator/light_path_emission.h"

#include "core/distribution.h"
#include "core/math.h"
#include "render/lights/environment_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace blush {
namespace {

// Pairs with the whole scene have this share of the paths.
constexpr double even_share = 0.1;
// A light gives a caster at least this share of what it would give if it faced it.
constexpr double min_facing = 0.05;

// What weak reflectors reflect of light that falls on them, about: other casters get all of their light.
constexpr double weak_share = 0.1;

// Rays find meshes that a caster would see in a larger solid angle (sr), if they faced it.
constexpr double max_small_solid_angle = 0.1;

double flux_of_triangle(const LightRecord& light, const CasterSphere& caster) {
    const Vec3 normal = cross(light.edge1, light.edge2), center = light.position + (light.edge1 + light.edge2) * (1.f / 3);
    const Vec3 to = caster.center - center;
    const double area = 1 / double(light.inverse_area), d2 = double(dot(to, to)), r2 = double(caster.radius) * double(caster.radius);
    const double intensity = double(luminance(light.emission)) * area, all = double(pi) * intensity;
    if (!(d2 > r2)) return all;
    double cosine = double(dot(normalize(normal), normalize(to)));
    if (light.flags & light_two_sided) cosine = std::abs(cosine);
    return std::min(all, intensity * std::max(cosine, min_facing) * double(pi) * r2 / d2);
}

// Estimated flux from the light to a caster; luminance. `sky`: irradiance of the environment on a disk that faces each direction.
double flux_of_pair(const LightRecord& light, const CasterSphere& caster, double sky) {
    const Vec3 to = caster.center - light.position;
    const double d2 = double(dot(to, to)), r2 = double(caster.radius) * double(caster.radius), disk = double(pi) * r2;
    const double emission = double(luminance(light.emission));
    switch (LightKind(light.kind)) {
    case LightKind::triangle: return flux_of_triangle(light, caster);
    case LightKind::point: {
        const double all = 4 * double(pi) * emission;
        return d2 > r2 ? std::min(all, emission * disk / d2) : all;
    }
    case LightKind::sphere: {
        const double all = 4 * double(pi) * double(pi) * emission * double(light.radius) * double(light.radius);
        return d2 > r2 ? std::min(all, all / (4 * double(pi)) * disk / d2) : all;
    }
    // The irradiance of a parallel sun.
    case LightKind::sun: return emission * disk * (light.cone_height > 0 ? 2 * double(pi) * double(light.cone_height) : 1);
    case LightKind::environment: return sky * disk;
    }
    return 0;
}

// By light: the area (m^2) of the mesh that it is a triangle of, whose triangles lie side by side; 0 for other lights.
std::vector<double> areas_of_meshes(const LightTables& lights) {
    std::vector<double> areas(size_t(lights.count), 0.0);
    const auto is_triangle = [&](int32_t i) { return i < lights.count && LightKind(lights.lights[i].kind) == LightKind::triangle; };
    for (int32_t first = 0, end = 0; first < lights.count; first = end) {
        double area = 0;
        for (end = first; is_triangle(end) && lights.lights[end].part == lights.lights[first].part; ++end)
            if (lights.lights[end].inverse_area > 0) area += 1 / double(lights.lights[end].inverse_area);
        std::fill(areas.begin() + first, areas.begin() + end, area);
        end = std::max(end, first + 1);
    }
    return areas;
}

// Of other lights, rays find the reflection by weak reflectors. `mesh_area`: of the mesh of a triangle.
bool emits_to_weak_reflector(const LightRecord& light, double mesh_area, const CasterSphere& caster, const EnvironmentLight& sky) {
    switch (LightKind(light.kind)) {
    case LightKind::triangle: {
        const Vec3 to = caster.center - light.position;
        return mesh_area <= max_small_solid_angle * std::max(double(dot(to, to)), double(caster.radius) * double(caster.radius));
    }
    case LightKind::environment: return sky.has_suns;
    default: return true;
    }
}

// The first casters, so many that their pairs with all lights are not too many.
CausticCasterTables aimed_at(const CausticCasterTables& casters, int32_t lights) {
    const int64_t columns = LightPathEmission::max_pairs / std::max(lights, 1);
    return {casters.spheres, int32_t(std::clamp<int64_t>(columns - 1, 0, casters.count))};
}

EnvironmentLight light_of_environment(const SceneTables& tables) {
    return tables.lights.samples_environment ? measure_light(tables.environment) : EnvironmentLight{};
}

} // namespace

bool emits_to_weak_reflectors(const SceneTables& tables, const CausticCasterTables& all) {
    const CausticCasterTables casters = aimed_at(all, tables.lights.count);
    if (casters.count <= tables.casters.count) return false;
    const EnvironmentLight sky = light_of_environment(tables);
    const std::vector<double> mesh_areas = areas_of_meshes(tables.lights);
    for (int32_t i = 0; i < tables.lights.count; ++i)
        for (int32_t k = tables.casters.count; k < casters.count; ++k)
            if (emits_to_weak_reflector(tables.lights.lights[i], mesh_areas[size_t(i)], casters.spheres[k], sky)) return true;
    return false;
}

LightPathEmission::LightPathEmission(const SceneTables& tables, const CasterSphere& scene, const std::function<bool(int32_t)>& emits)
    : casters_(aimed_at(tables.emission_casters, tables.lights.count)), scene_(scene), lights_(tables.lights.count) {
    const size_t columns = size_t(casters_.count) + 1;
    if (casters_.count == 0 || lights_ == 0) return;
    const EnvironmentLight sky = light_of_environment(tables);
    const std::vector<double> mesh_areas = areas_of_meshes(tables.lights);
    std::vector<double> flux(size_t(lights_) * columns);
    double aimed = 0, all = 0;
    for (size_t i = 0; i < size_t(lights_); ++i) {
        if (!emits(int32_t(i))) continue;
        const LightRecord& light = tables.lights.lights[i];
        for (size_t k = 0; k < columns; ++k) {
            double& f = flux[i * columns + k];
            f = flux_of_pair(light, k + 1 < columns ? casters_.spheres[k] : scene_, sky.integral);
            if (!std::isfinite(f)) f = 0;
            const bool is_weak = k >= size_t(tables.casters.count) && k + 1 < columns; // after mirrors and glass, before the scene
            if (is_weak) f *= emits_to_weak_reflector(light, mesh_areas[i], casters_.spheres[k], sky) ? weak_share : 0;
            (k + 1 < columns ? aimed : all) += f;
        }
    }
    if (!(aimed > 0 && all > 0)) return;
    for (size_t i = 0; i < flux.size(); ++i) flux[i] *= i % columns + 1 < columns ? (1 - even_share) / aimed : even_share / all;
    set_chances(flux);
}

LightPathEmission LightPathEmission::of_zero_size_lights(const SceneTables& tables, const CasterSphere& scene) {
    LightPathEmission emission(tables, scene, [&](int32_t light) { return has_zero_size(tables.lights.lights[light]); });
    emission.alone_ = true;
    return emission;
}

LightPathEmission LightPathEmission::of_all_lights(const SceneTables& tables, const CasterSphere& scene) {
    LightPathEmission emission;
    emission.scene_ = scene;
    emission.lights_ = tables.lights.count;
    const double sky = light_of_environment(tables).integral;
    std::vector<double> flux;
    for (int32_t i = 0; i < tables.lights.count; ++i) {
        const double f = flux_of_pair(tables.lights.lights[i], scene, sky);
        flux.push_back(std::isfinite(f) ? f : 0);
    }
    if (std::ranges::any_of(flux, [](double f) { return f > 0; })) emission.set_chances(flux);
    return emission;
}

void LightPathEmission::set_chances(const std::vector<double>& flux) {
    thresholds_ = make_thresholds(flux);
    for (size_t i = 0; i < flux.size(); ++i)
        // The last pair is drawn at least once in 2^32, whatever its flux.
        chances_.push_back(flux[i] > 0 ? discrete_probability<float>(thresholds_.data(), 0, int32_t(flux.size()), int32_t(i)) : 0.f);
}

EmissionTables LightPathEmission::tables(float paths) const {
    if (empty()) return {};
    return {chances_.data(), thresholds_.data(), lights_, casters_, scene_, paths, alone_};
}

EmittedPath LightPathEmission::emit(const SceneTables& scene, const Sampler<float>& sampler) const {
    return emit_by(scene, emission_random<float>(sampler), sampler.index);
}

EmittedPath LightPathEmission::emit_by(const SceneTables& scene, const EmissionRandom<float>& random, uint32_t index) const {
    EmittedPath path = emitted_in_lane<float>(emit_path<float>(scene, tables(1), random), 0);
    path.index = index;
    return path;
}

void sort_paths(std::vector<uint64_t>& order, const std::vector<EmittedPath>& paths, std::vector<EmittedPath>& sorted) {
    std::ranges::sort(order);
    sorted.clear();
    for (const uint64_t at : order) sorted.push_back(paths[size_t(uint32_t(at))]);
}

void trace_light_path_tile(const KernelContext& context, const Kernel& kernel, const LightPathEmission& emission, const LightPathTile& tile,
                           TileScratch& scratch) {
    if (!scratch.light_paths) scratch.light_paths = std::make_unique<LightPathColumns>();
    LightPathColumns& columns = *scratch.light_paths;
    // The samplers of pixels have other keys, and use the upper bits of the index for the place of the pixel.
    const int64_t index = (tile.pass >> 1) * tile.paths_per_pass + tile.first;
    columns.key = pcg_hash(randomisation(context.seed ^ 0x11687u, uint32_t(tile.pass & 1)) + uint32_t(index >> place_shift));
    const auto first_index = uint32_t(index & ((int64_t(1) << place_shift) - 1));
    columns.splats.clear();
    columns.moments.clear();
    PathQueue& samplers = scratch.paths[0];
    for (int k = 0; k < tile.count; ++k) {
        samplers.key[k] = columns.key;
        samplers.index[k] = first_index + uint32_t(k);
    }
    kernel.emit_light_paths(*context.scene, emission.tables(1), samplers.key, samplers.index, tile.count, columns.emitted);
    for (EmittedPath& path : columns.emitted) path.index += first_index;
    kernel.trace_light_paths(context, scratch);
}

} // namespace blush
