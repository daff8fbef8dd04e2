#include "render/comparison/bidirectional_paths.h"

#include "render/integrator/estimator.h"
#include "render/integrator/splat_pixel.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr Features s = comparison_features;

// Dimensions of the light path, in pairs, behind all of the camera path's (estimator.h): those of the emission, then those of each vertex.
constexpr uint32_t light_dimensions = 1u << 24;
enum EmissionDimension : uint32_t { pair_dimension, point_dimension, direction_dimension, first_vertex_dimension };
enum VertexDimension : uint32_t { vertex_bsdf, vertex_choice, vertex_lens, vertex_pixel, dimensions_per_vertex };
uint32_t dimension_at(int vertex) { return light_dimensions + first_vertex_dimension + dimensions_per_vertex * uint32_t(vertex); }

// Salts of opacity_random(), one for each ray of the two paths and their connections.
constexpr int light_salt = 1 << 20, connection_salt = 1 << 21, camera_salt = 1 << 22;

constexpr MisSettings light_sampling{.strategy = Strategy::light, .default_heuristic = true, .heuristic = {}};
constexpr MisSettings bsdf_sampling{.strategy = Strategy::bsdf, .default_heuristic = true, .heuristic = {}};

// One ray, in arrays that packets may read past.
struct OneRay {
    alignas(64) float ox[16]{}, oy[16]{}, oz[16]{}, dx[16]{}, dy[16]{}, dz[16]{}, distance[16]{};
    alignas(64) uint32_t random[16]{};

    OneRay(const Ray<float>& ray, float far_distance, uint32_t by_chance) {
        ox[0] = ray.origin.x, oy[0] = ray.origin.y, oz[0] = ray.origin.z;
        dx[0] = ray.direction.x, dy[0] = ray.direction.y, dz[0] = ray.direction.z;
        distance[0] = far_distance;
        random[0] = by_chance;
    }
    RayArrays arrays(bool blends, uint32_t mask) const { return {ox, oy, oz, dx, dy, dz, distance, blends ? random : nullptr, mask}; }
};

// Like a surface's point in the estimator.
template <class V> ShadingPoint<float> point_of(const V& v) {
    return {
        v.p.surface,    v.p.material.bsdf, v.p.shading, v.p.bsdf, v.p.beta, v.p.scatters, v.p.scatters && is_lambertian<s, float>(v.p.bsdf),
        v.p.side.solid, v.dispersed};
}

bool same_side(const ShadingFrame<float>& shading, const Vec3& wi) {
    return (shading.frame.to_local(wi).z > 0) == (dot(wi, shading.ng) > 0);
}

} // namespace

Hit<float> BidirectionalPaths::hit_by(const Path<float>& path, int salt, uint32_t mask) {
    const OneRay ray(path.ray, infinity, opacity_random<float>(path.key, path.index, uint32_t(salt)));
    alignas(64) float t[16], u[16], v[16];
    alignas(64) int32_t geometry[16], instance[16], triangle[16];
    trace_closest<float>(*context_.accel, ray.arrays(context_.scene->blends, mask), 1, false, {t, u, v, geometry, instance, triangle});
    return {t[0], u[0], v[0], geometry[0], instance[0], triangle[0]};
}

bool BidirectionalPaths::reaches(const Ray<float>& to, float distance, int salt, uint32_t mask) {
    const OneRay ray(to, distance, opacity_random<float>(sampler_.key, sampler_.index, uint32_t(salt)));
    uint8_t blocked[16];
    trace_any<float>(*context_.accel, ray.arrays(context_.scene->blends, mask), 1, false, blocked);
    return !blocked[0];
}

BidirectionalPaths::Vertex BidirectionalPaths::vertex_at(const Path<float>& path, const Hit<float>& hit, float width) const {
    Path<float> colourless = path;
    colourless.dispersed = 1; // the colour of the wavelength is that of the connected path, once
    Vertex v;
    v.p = shade_hit(context_, colourless, hit, width);
    v.cos_wo = clamped_cosine<float>(v.p.shading.ng, v.p.side.wo);
    v.dispersed = path.dispersed != 0 || (v.p.scatters && v.p.side.solid && v.p.material.dispersion > 0);
    return v;
}

double BidirectionalPaths::reverse_density(const Vertex& v, const Vec3& wi) const {
    const auto view =
        view_point<s, float>(*context_.scene, context_.settings.energy, v.p.surface, v.p.material, v.p.bsdf, wi, v.p.side.wo, false, true);
    return double(view.value.pdf) / double(v.cos_wo);
}

double BidirectionalPaths::nee_density(const Vertex& v, const Vec3& wi, const EmissionPoint<float>& at) const {
    const Receiver<float> to = scatter_setup<s, float>(*context_.scene, v.p.material, point_of(v)).receiver;
    return double(nee_pdf<s, float>(*context_.scene, to, at, true)) / double(clamped_cosine<float>(v.p.shading.ng, wi));
}

Vec3 BidirectionalPaths::colored(const Vec3& radiance, bool dispersed) const {
    return dispersed ? radiance * wavelength_of(sampler_).rgb : radiance;
}

void BidirectionalPaths::add(const Vec3& radiance, int scatterings, int32_t light) {
    if (!has_light<float>(radiance)) return;
    const int32_t* groups = context_.scene->groups.of_light;
    const int pixel = camera_.y * int(context_.settings.width) + camera_.x;
    out_->push_back({pixel, radiance, uint16_t(std::min(scatterings, 65535)), uint16_t(groups && light >= 0 ? groups[light] : 0)});
}

PathDensities BidirectionalPaths::densities(int strategy, int camera_vertices) const {
    PathDensities d;
    const int on_light = std::max(strategy - 1, 0);
    d.edges = camera_vertices + on_light + 1;
    d.light_paths = double(context_.scene->emission.paths);
    const int last = std::min(d.edges - 1, PathDensities::size - 1);
    for (int i = 1; i <= last; ++i) {
        const auto at = size_t(i);
        if (i <= on_light) {
            d.delta[at] = from_light_[at - 1].delta;
            if (i == on_light) continue;
            d.toward_camera[at] = from_light_[at].density;
            d.geometry[at] = from_light_[at].geometry;
            d.toward_light[at - 1] = from_light_[at - 1].reverse;
        } else {
            const Vertex& v = from_camera_[size_t(d.edges - 1 - i)];
            d.delta[at] = v.delta;
            d.toward_light[at] = v.density;
            d.geometry[at] = v.geometry;
            d.toward_camera[at] = v.reverse;
        }
    }
    // The ends of the connection leave by no lobe.
    if (strategy >= 1 && strategy <= last) d.delta[size_t(strategy)] = false;
    if (strategy >= 2) d.delta[size_t(strategy - 1)] = false;
    if (strategy < 2) return d;
    d.nee = emitted_nee_;
    d.emission = double(emitted_.density);
    d.light_can_be_hit = !emitted_.delta;
    return d;
}

bool BidirectionalPaths::extend_camera_path(RandomPairs& random, Vertex& v, int bounce, const Path<float>& arrived, float cone,
                                            Direction& next) {
    const uint32_t dimension = first_scatter_dimension + dimensions_per_scatter * uint32_t(bounce);
    const ShadingPoint<float> p = point_of(v);
    const ScatterSetup<float> setup = scatter_setup<s, float>(*context_.scene, v.p.material, p);
    const Pair<float> choice = random.pair(dimension + choice_dimension);
    const IndirectSample<float> sampled =
        sample_indirect<s, float>(*context_.scene, p, setup, choice.x(), random.pair(dimension + bsdf_dimension));
    Vec3 beta = p.beta * sampled.bsdf.weight;
    Step<float> step = ended_step<float>(beta);
    step.continues = sampled.bsdf.valid && (sampled.bsdf.wi.z > 0) == sampled.outward && has_light<float>(beta);
    roulette<s, float>(*context_.scene, context_.settings, arrived, p, setup.receiver, sampled, bounce, choice.y(), beta, step);
    if (!step.continues) return false;
    if (!std::isfinite(beta.x + beta.y + beta.z)) return add(beta, bounce + 1, -1), false; // the film reports it
    next_path<s, float>(arrived, p, setup, sampled, beta, cone, next.path);
    next.path.part = p.surface.part;
    next.path.dispersed = v.dispersed;
    v.delta = sampled.bsdf.delta;
    next.density = v.delta ? 1 : double(sampled.bsdf.pdf / clamped_cosine<float>(p.shading.ng, sampled.wi));
    v.reverse = v.delta ? 1 : reverse_density(v, sampled.wi);
    return true;
}

// As continue_light_path() in light_paths.h.
bool BidirectionalPaths::extend_light_path(RandomPairs& random, Vertex& v, int bounce, const Path<float>& arrived, Direction& next) {
    const uint32_t dimension = dimension_at(bounce);
    const Pair<float> direction = random.pair(dimension + vertex_bsdf), choice = random.pair(dimension + vertex_choice);
    const BsdfSample<float> b = sample<s, float>(v.p.bsdf, v.p.shading.wo, direction.x(), direction.y(), choice.x());
    const Vec3 wi = normalize(v.p.shading.frame.to_world(b.wi));
    const bool outward = dot(wi, v.p.shading.ng) > 0;
    if (!b.valid || (b.wi.z > 0) != outward) return false;
    const float cosine = clamped_cosine<float>(v.p.shading.ng, wi);
    Vec3 beta;
    v.delta = b.delta;
    if (v.delta) {
        const float tilt =
            cosine / v.cos_wo * delta_adjoint<s, float>(v.p.bsdf, v.p.material.bsdf.layers, v.p.shading.wo, b.wi, choice.x());
        beta = v.p.beta * b.weight * tilt;
        next.density = v.reverse = 1;
    } else {
        const auto view = view_point<s, float>(*context_.scene, context_.settings.energy, v.p.surface, v.p.material, v.p.bsdf, wi,
                                               v.p.side.wo, false, true);
        const float forward = b.pdf / cosine;
        beta = v.p.beta * view.value.f_cos * (1 / (v.cos_wo * std::max(forward, 1e-30f)));
        next.density = double(forward);
        v.reverse = double(view.value.pdf) / double(v.cos_wo);
    }
    if (!has_light<float>(beta)) return false;
    const Roulette& rule = context_.settings.roulette;
    if (bounce + 1 >= rule.start && rule.rule != Roulette::Rule::off && (!v.delta || bounce + 1 >= first_rr_bounce_at_delta)) {
        // Of the share of the flux that is left.
        const float q = survival_probability<float>(rule, beta * (1 / std::max(luminance(emitted_.flux), 1e-30f)));
        if (choice.y() >= q) return false;
        beta = beta * (1 / std::max(q, 1e-30f));
    }
    if (!std::isfinite(beta.x + beta.y + beta.z)) return add(beta, bounce + 1, -1), false;
    next.path = arrived;
    next.path.ray = {offset_origin(v.p.surface.position, v.p.surface.error, v.p.shading.ng, outward), wi};
    next.path.beta = beta;
    next.path.dispersed = v.dispersed;
    return true;
}

void BidirectionalPaths::trace_light_path(RandomPairs& random) {
    from_light_.clear();
    const SceneTables& scene = *context_.scene;
    if (scene.emission.empty() || context_.settings.max_bounces == 0) return;
    emitted_ = emission_.emit_by(scene, {random.pair(light_dimensions + pair_dimension), random.pair(light_dimensions + point_dimension),
                                         random.pair(light_dimensions + direction_dimension)});
    if (!(emitted_.density > 0)) return;
    Direction next;
    next.path.ray = {emitted_.origin, emitted_.direction};
    next.path.beta = emitted_.flux;
    next.path.key = sampler_.key, next.path.index = sampler_.index;
    next.path.dispersed = 0;
    for (int bounce = 0; bounce < PathDensities::max_light_vertices; ++bounce) {
        const Path<float> path = next.path;
        const Hit<float> hit = hit_by(path, light_salt + bounce, other_ray_mask);
        if (hit.geometry < 0 || hit.instance == sphere_instance) return;
        Vertex v = vertex_at(path, hit, 0); // textures are not filtered: see ray_cone.h
        if (!v.p.scatters) return;
        v.density = next.density;
        if (bounce == 0) {
            if (scene.links.lit_sets && !is_lit<float>(scene.links, emitted_.light, v.p.surface.part, true)) return;
            const auto at =
                emission_point<s, float>(scene, emitted_.light, emitted_.light_position, emitted_.light_normal, v.p.side.wo, true);
            emitted_nee_ = nee_density(v, v.p.side.wo, at);
        } else {
            const float left = clamped_cosine<float>(from_light_.back().p.shading.ng, path.ray.direction);
            v.geometry = double(left) * double(v.cos_wo) / std::max(double(hit.t) * double(hit.t), 1e-30);
        }
        from_light_.push_back(v);
        if (bounce + 1 >= context_.settings.max_bounces || !extend_light_path(random, from_light_.back(), bounce, path, next)) return;
    }
}

void BidirectionalPaths::find_light(const Direction& arrived, const Lit& lit, int bounce) {
    const SceneTables& scene = *context_.scene;
    const Vertex& v = from_camera_.back();
    if (scene.links.lit_sets && !is_lit<float>(scene.links, lit.light, v.p.surface.part, true)) return;
    PathDensities d = densities(0, bounce);
    d.toward_light[0] = arrived.density;
    d.light_can_be_hit = true;
    if (lit.light >= 0 && lit.light < scene.emission.lights) {
        const Vec3& wi = arrived.path.ray.direction;
        const auto at = emission_point<s, float>(scene, lit.light, lit.position, lit.normal, wi, true);
        d.emission = double(emission_density<float>(scene.emission, at, true));
        d.nee = nee_density(v, wi, at);
    }
    add(colored(lit.radiance * float(d.weight(0)), v.dispersed), bounce, lit.light);
}

void BidirectionalPaths::find_background(const Direction& arrived, int bounce) {
    EstimatorSettings settings = context_.settings;
    settings.mis = bsdf_sampling;
    const Path<float>& path = arrived.path;
    for_each_background_light<s, float>(*context_.scene, settings, path, bounce, true,
                                        [&](int32_t light, const Vec3& radiance, const float&, bool seen) {
                                            if (seen)
                                                find_light(arrived, {light, path.beta * radiance, path.ray.origin, {0, 0, 0}}, bounce);
                                        });
}

// Emission of the surface that the camera path has hit.
void BidirectionalPaths::find_emission(const Direction& arrived, const Hit<float>& hit, const Vertex& v, int bounce) {
    const SceneTables& scene = *context_.scene;
    const MaterialPoint<float>& m = v.p.material;
    if (m.unlit) return add(colored(v.p.beta * m.bsdf.base_color, v.dispersed), bounce, -1);
    if (!(max_component(m.emission) > 0) || !(v.p.side.front || m.double_sided)) return;
    const float facing = std::abs(v.p.side.cos_wo);
    const Vec3 emission = m.emission * through_clearcoat(m.bsdf.layers.clearcoat, facing);
    const Surface<float>& at = v.p.surface;
    const EmissionHit<float> found =
        emission_hit<s, float>(scene, bsdf_sampling, arrived.path, {at.part, at.position, at.ng}, hit, facing, emission, true);
    find_light(arrived, {light_of_triangle<float>(scene, at.part, hit.triangle), v.p.beta * found.radiance, at.position, at.ng}, bounce);
}

void BidirectionalPaths::trace_camera_path(RandomPairs& random, const CameraSample& sample) {
    from_camera_.clear();
    const SceneTables& scene = *context_.scene;
    const EstimatorSettings& settings = context_.settings;
    const float px = float(sample.x) + 0.5f + filter_offset<float>(*settings.filter, sample.in_pixel.x());
    const float py = float(sample.y) + 0.5f + filter_offset<float>(*settings.filter, sample.in_pixel.y());
    Direction next;
    Path<float>& begin = next.path;
    begin.ray = camera_ray<s, float>(scene.camera, px, py, settings.width, settings.height, sample.on_lens.x(), sample.on_lens.y());
    begin.beta = {1, 1, 1};
    begin.pdf = infinity;
    begin.normal = {0, 0, 0};
    begin.key = sampler_.key, begin.index = sampler_.index;
    begin.slot = begin.chain = begin.dispersed = 0;
    begin.part = from_camera;
    begin.light_ratio = begin.emission_ratio = 0;
    begin.cone = cone_at_camera<float>(scene.camera, settings);
    for (int bounce = 0; bounce <= max_path_length; ++bounce) {
        const Path<float> path = next.path;
        const Hit<float> hit = hit_by(path, camera_salt + bounce, bounce == 0 ? camera_ray_mask : other_ray_mask);
        if (hit.geometry < 0) return bounce > 0 ? find_background(next, bounce) : void();
        if (hit.instance == sphere_instance) {
            if (bounce == 0) return;
            const auto found = sphere_emission_hit<s, float>(scene, bsdf_sampling, path, hit.triangle, hit.t, true);
            const int32_t light = hit.triangle + scene.lights.first_sphere;
            const Vec3 at = path.ray.origin + path.ray.direction * hit.t;
            return find_light(next, {light, path.beta * found.radiance, at, normalize(at - scene.lights.lights[light].position)}, bounce);
        }
        const float cone = cone_width<float>(scene.camera, settings, path, hit.t);
        Vertex v = vertex_at(path, hit, filter_width<s, float>(scene, hit, cone, bounce, true));
        if (bounce > 0) find_emission(next, hit, v, bounce);
        if (!v.p.scatters || bounce >= settings.max_bounces) return;
        if (bounce == 0) {
            v.density = double(camera_density<float>(scene.camera, settings, path.ray.direction, hit.t)) * double(v.cos_wo);
        } else {
            const float left = clamped_cosine<float>(from_camera_.back().p.shading.ng, path.ray.direction);
            v.density = next.density;
            v.geometry = double(left) * double(v.cos_wo) / std::max(double(hit.t) * double(hit.t), 1e-30);
        }
        from_camera_.push_back(v);
        if (!extend_camera_path(random, from_camera_.back(), bounce, path, cone, next)) return;
    }
}

// s = 1.
void BidirectionalPaths::connect_light(RandomPairs& random, int j) {
    const SceneTables& scene = *context_.scene;
    const Vertex& v = from_camera_[size_t(j)];
    if (scene.lights.count == 0 || is_delta_only<float>(v.p.bsdf)) return;
    const ShadingPoint<float> p = point_of(v);
    const ScatterSetup<float> setup = scatter_setup<s, float>(scene, v.p.material, p);
    const uint32_t dimension = first_scatter_dimension + dimensions_per_scatter * uint32_t(j);
    Step<float> step = ended_step<float>(p.beta);
    sample_direct<s, float>(scene, light_sampling, p, setup, random.pair(dimension + light_dimension), nullptr, step);
    if (!step.connects || !reaches(step.shadow, step.shadow_distance, connection_salt + j * PathDensities::size, other_ray_mask)) return;
    const Vec3& wi = step.shadow.direction;
    const LightPoint<float>& light = step.sampled;
    const double cosine = double(clamped_cosine<float>(p.shading.ng, wi));
    PathDensities d = densities(1, j + 1);
    d.toward_light[0] = double(step.weights.light_bsdf_pdf) / cosine;
    d.toward_camera[1] = reverse_density(v, wi);
    const auto at =
        emission_point<s, float>(scene, light.light, light.infinite ? p.surface.position : light.position, light.normal, wi, true);
    d.nee = nee_density(v, wi, at);
    d.emission = light.light < scene.emission.lights ? double(emission_density<float>(scene.emission, at, true)) : 0;
    d.light_can_be_hit = !light.delta;
    add(colored(step.direct * float(d.weight(1)), v.dispersed), j + 1, light.light);
}

// 2 <= s < k.
void BidirectionalPaths::connect_vertices(int j, int i) {
    const SceneTables& scene = *context_.scene;
    const Vertex &c = from_camera_[size_t(j)], &l = from_light_[size_t(i)];
    if (is_delta_only<float>(c.p.bsdf) || is_delta_only<float>(l.p.bsdf)) return;
    const Vec3 rough = l.p.surface.position - c.p.surface.position;
    const Vec3 from = offset_origin(c.p.surface.position, c.p.surface.error, c.p.shading.ng, dot(rough, c.p.shading.ng) > 0);
    const Vec3 end = offset_origin(l.p.surface.position, l.p.surface.error, l.p.shading.ng, dot(rough, l.p.shading.ng) < 0);
    const Vec3 to = end - from;
    const float d2 = dot(to, to), distance = std::sqrt(d2);
    if (!(distance > 0)) return;
    const Vec3 wi = to * (1 / distance);
    if (!same_side(c.p.shading, wi)) return;
    const BsdfValue<float> at_camera = eval<s, float>(c.p.bsdf, c.p.shading.wo, c.p.shading.frame.to_local(wi));
    const auto at_light =
        view_point<s, float>(scene, context_.settings.energy, l.p.surface, l.p.material, l.p.bsdf, -wi, l.p.side.wo, false, true);
    const float cos_c = clamped_cosine<float>(c.p.shading.ng, wi), cos_l = clamped_cosine<float>(l.p.shading.ng, wi);
    Vec3 value = c.p.beta * at_camera.f_cos * l.p.beta * at_light.value.f_cos * (cos_l / (l.cos_wo * d2));
    // Absorption between two surfaces of a solid, as of a camera path that has hit the second one from within.
    HitSide<float> side = l.p.side;
    side.front = dot(l.p.surface.ng, wi) < 0;
    value = attenuate<s, float>(value, l.p.material, distance, side, true);
    value = colored(value, c.dispersed || l.dispersed);
    if (!has_light<float>(value)) return;
    const int salt = connection_salt + j * PathDensities::size + i + 1;
    if (!reaches({from, wi}, distance * (1 - 4e-7f), salt, other_ray_mask)) return;
    const int strategy = i + 2;
    PathDensities d = densities(strategy, j + 1);
    const auto first = size_t(strategy - 1); // the edge between both
    d.toward_light[first] = double(at_camera.pdf) / double(cos_c);
    d.toward_light[first - 1] = double(at_light.value.pdf) / double(l.cos_wo);
    d.geometry[first] = double(cos_c) * double(cos_l) / double(d2);
    d.toward_camera[first] = double(eval<s, float>(l.p.bsdf, l.p.shading.wo, l.p.shading.frame.to_local(-wi)).pdf) / double(cos_l);
    if (first + 1 < PathDensities::size) d.toward_camera[first + 1] = reverse_density(c, wi);
    add(value * float(d.weight(strategy)), i + j + 2, emitted_.light);
}

// s = k.
void BidirectionalPaths::connect_camera_to(RandomPairs& random, int i) {
    const SceneTables& scene = *context_.scene;
    const EstimatorSettings& settings = context_.settings;
    const Vertex& v = from_light_[size_t(i)];
    if (is_delta_only<float>(v.p.bsdf)) return;
    const Pair<float> lens = random.pair(dimension_at(i) + vertex_lens);
    const auto rough = connect_camera<s, float>(scene.camera, settings, v.p.surface.position, lens.x(), lens.y());
    const Vec3 from = offset_origin(v.p.surface.position, v.p.surface.error, v.p.shading.ng, dot(rough.to, v.p.shading.ng) > 0);
    const auto c = connect_camera<s, float>(scene.camera, settings, from, lens.x(), lens.y());
    if (!c.valid) return;
    const Pair<float> pixel = random.pair(dimension_at(i) + vertex_pixel);
    const SplatPixel x = splat_pixel(*settings.filter, c.x, pixel.x()), y = splat_pixel(*settings.filter, c.y, pixel.y());
    if (x.pixel < 0 || y.pixel < 0 || x.pixel >= int(settings.width) || y.pixel >= int(settings.height) || !(x.weight * y.weight > 0))
        return;
    const auto view = view_point<s, float>(scene, settings.energy, v.p.surface, v.p.material, v.p.bsdf, c.to, v.p.side.wo, false, true);
    const float density = c.density * clamped_cosine<float>(v.p.shading.ng, c.to);
    Vec3 value = v.p.beta * view.value.f_cos * (density * x.weight * y.weight / (v.cos_wo * scene.emission.paths));
    value = colored(value, v.dispersed);
    if (!has_light<float>(value)) return;
    const int salt = connection_salt - PathDensities::size + i;
    if (!reaches({from, c.to}, c.distance * (1 - 4e-7f), salt, camera_ray_mask)) return;
    const int strategy = i + 2;
    PathDensities d = densities(strategy, 0);
    d.toward_light[size_t(strategy - 1)] = double(density);
    d.geometry[size_t(strategy - 1)] = 1;
    d.toward_light[size_t(strategy - 2)] = double(view.value.pdf) / double(v.cos_wo);
    const int32_t* groups = scene.groups.of_light;
    out_->push_back({y.pixel * int(settings.width) + x.pixel, value * float(d.weight(strategy)), uint16_t(i + 1),
                     uint16_t(groups ? groups[emitted_.light] : 0)});
}

void BidirectionalPaths::trace(RandomPairs& random, const CameraSample& sample, const Sampler<float>& path, std::vector<Splat>& out) {
    out_ = &out;
    camera_ = sample;
    sampler_ = path;
    trace_light_path(random);
    trace_camera_path(random, sample);
    const int cameras = int(from_camera_.size()), lights = int(from_light_.size());
    for (int j = 0; j < cameras; ++j) {
        connect_light(random, j);
        for (int i = 0; i < lights && i + j + 2 <= context_.settings.max_bounces; ++i) connect_vertices(j, i);
    }
    for (int i = 0; i < lights; ++i) connect_camera_to(random, i);
}

} // namespace blush
