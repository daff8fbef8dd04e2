#include "render/integrator/light_path_emission.h"

#include "core/distribution.h"
#include "core/math.h"
#include "render/integrator/light_path_weights.h"
#include "render/integrator/light_sampling.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace blush {
namespace {

// Pairs with the whole scene have this share of the paths.
constexpr double even_share = 0.1;
// A light gives a caster at least this share of what it would give if it faced it.
constexpr double min_facing = 0.05;

// What weak reflectors reflect of light that falls on them, about: other casters get all of their light.
constexpr double weak_share = 0.1;

enum EmissionDimension : uint32_t { pair_dimension, point_dimension, direction_dimension };

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

// Of other lights, rays find the reflection by weak reflectors.
bool is_emitted_to_weak(const LightRecord& light) { return has_zero_size(light) || LightKind(light.kind) == LightKind::sun; }

// Integral of the environment's radiance over all directions; luminance.
double integral_of_environment(const SceneTables& tables) {
    if (!tables.lights.samples_environment) return 0;
    constexpr int samples = 256;
    double sum = 0;
    for (uint32_t i = 0; i < samples; ++i) {
        const Pair<float> random = Sampler<float>{pcg_hash(0x5c1e9u), i}.pair(0);
        const EnvironmentSample<float> s = sample_environment<float>(tables.environment, random.x(), random.bits_y);
        if (s.pdf > 0) sum += double(luminance(s.radiance)) / double(s.pdf) / samples;
    }
    return sum;
}

// A point of the light, and a direction in which it emits.
struct PointSample {
    LightPoint<float> light;
    float density; // of the position
};
PointSample sample_point(const SceneTables& tables, int32_t light, const Pair<float>& random) {
    const LightRecord& record = tables.lights.lights[light];
    LightPoint<float> p = begin_light_point<float>(tables.lights.lights, record.flags, {light, 1.f, 0.f}, true);
    const float u = random.x(), v = random.y();
    if (LightKind(record.kind) == LightKind::sphere) {
        p.normal = sample_cone(2.f, u, v);
        p.position = p.position + p.normal * record.radius;
        const float size = max_component(abs(record.position)) + record.radius;
        p.error = Vec3{1, 1, 1} * (size * gamma_bound(16));
        return {p, 0.25f * inv_pi / (record.radius * record.radius)};
    }
    sample_triangle_light<all_features, float>(tables, record.flags, u, v, p);
    p.delta = LightKind(record.kind) == LightKind::point;
    sample_sun<all_features, float>(tables, u, v, p);
    sample_environment_light<all_features, float>(tables, u, random.bits_y, true, p);
    return {p, p.density};
}

// Orders rays to one caster: near numbers for rays that reach its sphere side by side (Morton order of 32^3 cells).
uint32_t place_of(int32_t target, const CasterSphere& sphere, const Vec3& origin, const Vec3& direction) {
    const float along = max(dot(sphere.center - origin, direction), sphere.radius);
    const Vec3 at = (origin + direction * along - sphere.center) * (0.5f / sphere.radius);
    const auto cell = [](float x) { return uint32_t(std::clamp((x + 0.5f) * 32, 0.f, 31.f)); };
    const uint32_t x = cell(at.x), y = cell(at.y), z = cell(at.z);
    auto place = uint32_t(target);
    for (int bit = 4; bit >= 0; --bit) place = place << 3 | (x >> bit & 1u) << 2 | (y >> bit & 1u) << 1 | (z >> bit & 1u);
    return place;
}

// A direction from the light to the caster; with `even`, or if the point is inside of the caster's sphere, with the density of the cosine.
Vec3 sample_direction(const LightPoint<float>& p, const CasterSphere& caster, bool even, const Pair<float>& random) {
    const Vec3 to = caster.center - p.position;
    const float height = sphere_cone_height(dot(to, to), caster.radius);
    if (!even && height > 0) return basis_around(normalize(to)).to_world(sample_cone(height, random.x(), random.y()));
    if (p.delta) return sample_cone(2.f, random.x(), random.y());
    const bool back = p.two_sided && LightKind(p.kind) == LightKind::triangle && random.x() >= 0.5f;
    const float u = p.two_sided && LightKind(p.kind) == LightKind::triangle ? 2 * random.x() - float(back) : random.x();
    return basis_around(back ? -p.normal : p.normal).to_world(sample_cosine_hemisphere(u, random.y()));
}

} // namespace

LightPathEmission::LightPathEmission(const SceneTables& tables, const CasterSphere& scene, const std::function<bool(int32_t)>& emits)
    : casters_(tables.emission_casters), scene_(scene), lights_(tables.lights.count) {
    const size_t columns = size_t(casters_.count) + 1;
    if (casters_.count == 0 || lights_ == 0 || int64_t(lights_) * int64_t(columns) > max_pairs) return;
    const double sky = integral_of_environment(tables);
    std::vector<double> flux(size_t(lights_) * columns);
    double aimed = 0, all = 0;
    for (size_t i = 0; i < size_t(lights_); ++i) {
        if (!emits(int32_t(i))) continue;
        const LightRecord& light = tables.lights.lights[i];
        for (size_t k = 0; k < columns; ++k) {
            double& f = flux[i * columns + k];
            f = flux_of_pair(light, k + 1 < columns ? casters_.spheres[k] : scene_, sky);
            if (!std::isfinite(f)) f = 0;
            const bool is_weak = k >= size_t(tables.casters.count) && k + 1 < columns; // after mirrors and glass, before the scene
            if (is_weak) f *= is_emitted_to_weak(light) ? weak_share : 0;
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
    const double sky = integral_of_environment(tables);
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
    return {chances_.data(), lights_, casters_, scene_, paths, alone_};
}

EmittedPath LightPathEmission::emit(const SceneTables& tables, const Sampler<float>& sampler) const {
    return emit_by(tables, {sampler.pair(pair_dimension), sampler.pair(point_dimension), sampler.pair(direction_dimension)}, sampler.index);
}

void LightPathEmission::emit_paths(const SceneTables& scene, const uint32_t* keys, const uint32_t* indices, int count,
                                   std::vector<EmittedPath>& emitted) const {
    emitted.clear();
    for (int k = 0; k < count; ++k) {
        EmittedPath path = emit(scene, {keys[k], indices[k]});
        path.index = uint32_t(k);
        if (path.density > 0) emitted.push_back(path);
    }
    std::ranges::stable_sort(emitted, {}, &EmittedPath::place);
}

EmittedPath LightPathEmission::emit_by(const SceneTables& tables, const Random& numbers, uint32_t index) const {
    const auto pair = sample_discrete<float>(thresholds_.data(), 0, int(thresholds_.size()), numbers.pair.bits_x);
    const int32_t columns = casters_.count + 1, light = pair.index / columns, target = pair.index % columns;
    const bool even = target == casters_.count;
    const CasterSphere& sphere = even ? scene_ : casters_.spheres[target];
    const auto [p, density] = sample_point(tables, light, numbers.point);
    const Pair<float>& random = numbers.direction;
    EmittedPath path;
    path.index = index;
    Vec3 wi;
    if (p.infinite) {
        wi = p.position;
        const Vec2T<float> disk = sample_disk(random.x(), random.y());
        path.origin = sphere.center + basis_around(wi).to_world(Vec3{disk.x, disk.y, 0}) * sphere.radius;
        // Begins before the scene, as far as it has to.
        const Vec3 to_end = scene_.center - path.origin;
        path.origin = path.origin + wi * (dot(to_end, wi) + 1.01f * scene_.radius);
    } else {
        wi = -sample_direction(p, sphere, even, random);
        path.origin = p.delta ? p.position : offset_origin(p.position, p.error, p.normal, dot(wi, p.normal) < 0);
    }
    path.direction = -wi;
    path.place = place_of(target, sphere, path.origin, path.direction);
    path.light_position = p.infinite ? wi : p.position;
    path.light_normal = p.normal;
    path.light = light;
    path.infinite = p.infinite;
    path.delta = p.delta;
    const auto point = emission_point<all_features, float>(tables, light, p.infinite ? path.origin : p.position, p.normal, wi, true);
    path.density = emission_density<float>(this->tables(1), point, true);
    const Vec3 radiance = incident_light<all_features, float>(tables, p, wi, 1.f).radiance;
    if (path.density > 0 && std::isfinite(path.density)) path.flux = radiance * (1 / path.density);
    if (!(luminance(path.flux) > 0) || !std::isfinite(luminance(path.flux))) path.density = 0;
    return path;
}

void trace_light_path_tile(const KernelContext& context, const Kernel& kernel, const LightPathEmission& emission, const LightPathTile& tile,
                           TileScratch& scratch) {
    if (!scratch.light_paths) scratch.light_paths = std::make_unique<LightPathColumns>();
    LightPathColumns& columns = *scratch.light_paths;
    // The samplers of pixels have other keys, and use the upper bits of the index for the place of the pixel.
    const int64_t index = (tile.pass >> 1) * tile.paths_per_pass + tile.first;
    columns.key = pcg_hash(randomisation(context.seed ^ 0x11687u, uint32_t(tile.pass & 1)) + uint32_t(index >> place_shift));
    const auto first_index = uint32_t(index & ((int64_t(1) << place_shift) - 1));
    columns.emitted.clear();
    columns.splats.clear();
    columns.moments.clear();
    for (int k = 0; k < tile.count; ++k) columns.emitted.push_back(emission.emit(*context.scene, {columns.key, first_index + uint32_t(k)}));
    // Paths of one light to one place are traced together: rays of a packet then meet the same triangles.
    std::ranges::stable_sort(columns.emitted, {}, &EmittedPath::place);
    kernel.trace_light_paths(context, scratch);
}

} // namespace blush
