// A light meter measures the illuminance at exactly the clicked point, also at edges and on slopes, in all shipped scenes: with z
// tests of a common significance (Sidak), and a count of the clicks beyond three standard errors.
#include "core/math.h"
#include "io/gltf/read/import.h"
#include "measure/metrics/light_meter.h"
#include "render/renderer.h"
#include "scene/affine.h"
#include "scene/geometry/ray_queries.h"
#include "scene/world_transforms.h"
#include "tests/support/statistics.h"
#include "ui/viewport/picking.h"
#include "ui/views/meters_view.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <tuple>

namespace blush::TEST_FILE {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int width = 160, height = 90;

struct EmissiveTriangle {
    Vec3d a, b, c, normal;
    double nits, area;
};

// Direct illumination from its definition, in double precision and independent of the renderer: emissive triangles, suns, and a
// constant sky, with visibility from cast_ray.
class DirectLight {
public:
    explicit DirectLight(const Scene& scene) : scene_(scene) {
        WorldTransforms transforms(scene);
        for (const auto& [id, node] : scene.nodes) {
            const Affined& world = transforms(id).world_from_node;
            if (const Light* light = node.light ? scene.lights.find(node.light) : nullptr) {
                EXPECT_EQ(light->kind, Light::Kind::sun);
                suns_.push_back(
                    {normalize(world.z), double(light->angle_radians) / 2, double(light->intensity) * double(luminance(light->color))});
            }
            if (!node.mesh) continue;
            for (const MeshPart& part : scene.meshes.find(node.mesh)->parts) {
                const Material* m = scene.materials.find(part.material);
                const double nits = m ? double(luminance(m->emissive)) * double(m->emissive_strength) : 0;
                if (nits > 0) add(*part.geometry, world, nits);
            }
        }
    }

    // Estimates lux with `samples` random samples per source, and the standard error.
    std::pair<double, double> at(const Vec3d& x, const Vec3d& n, int samples, std::mt19937_64& random) const {
        std::uniform_real_distribution<double> uniform;
        double sum = 0, variance = 0;
        const auto add = [&](const auto& estimate) {
            double s = 0, s2 = 0;
            for (int i = 0; i < samples; ++i) {
                const double e = estimate(uniform(random), uniform(random), uniform(random));
                s += e;
                s2 += e * e;
            }
            sum += s / samples;
            variance += std::max(0.0, s2 / samples - s * s / samples / samples) / (samples - 1);
        };
        if (power_ > 0)
            add([&](double pick, double u, double v) {
                const EmissiveTriangle& t = *std::ranges::lower_bound(
                    triangles_, pick * power_, {}, [&](const EmissiveTriangle& e) { return until_[size_t(&e - triangles_.data())]; });
                const double r = std::sqrt(u);
                const Vec3d y = t.a * (1 - r) + t.b * (r * (1 - v)) + t.c * (r * v), to = y - x;
                const double d2 = dot(to, to), cos_x = dot(n, to), cos_y = -dot(t.normal, to);
                if (!(cos_x > 0 && cos_y > 0) || first_occluder(scene_, x, y, [](Id<Node>) { return true; })) return 0.0;
                return cos_x * cos_y / (d2 * d2) * power_; // nits * area / (nits * area / power)
            });
        for (const Sun& sun : suns_)
            add([&](double, double u, double v) {
                const Vec3d s = any_perpendicular(sun.towards), t = cross(sun.towards, s);
                const double edge = std::cos(sun.half_angle), height = 1 - u * (1 - edge), phi = 2 * pi * v; // uniform in solid angle
                const double width = std::sqrt(1 - height * height);
                const Vec3d wi = sun.towards * height + (s * std::cos(phi) + t * std::sin(phi)) * width;
                // The cone has 2 pi (1 - edge) steradians, and the lux are those of a surface that faces the sun: pi (1 - edge^2).
                return std::max(0.0, dot(n, wi)) * sun.lux * 2 / (1 + edge) * sees(x, wi);
            });
        if (scene_.environment.kind == Environment::Kind::constant && scene_.environment.intensity > 0)
            add([&](double, double u, double v) {
                const Vec3d s = any_perpendicular(n), t = cross(n, s);
                const double r = std::sqrt(u), phi = 2 * pi * v;
                const Vec3d wi = s * (r * std::cos(phi)) + t * (r * std::sin(phi)) + n * std::sqrt(1 - u);
                return pi * double(scene_.environment.intensity) * double(luminance(scene_.environment.color)) * sees(x, wi);
            });
        return {sum, std::sqrt(variance)};
    }

private:
    struct Sun {
        Vec3d towards;
        double half_angle, lux;
    };
    void add(const Geometry& g, const Affined& world, double nits) {
        for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
            const auto corner = [&](size_t k) { return transform_point(world, to_double(g.positions[g.indices[i + k]])); };
            EmissiveTriangle t{corner(0), corner(1), corner(2), {}, nits, 0};
            const Vec3d normal = cross(t.b - t.a, t.c - t.a);
            t.area = length(normal) / 2;
            if (!(t.area > 0)) continue;
            t.normal = normalize(normal);
            power_ += t.nits * t.area;
            triangles_.push_back(t);
            until_.push_back(power_);
        }
    }
    double sees(const Vec3d& x, const Vec3d& wi) const {
        return cast_ray(scene_, x, wi, [](Id<Node>) { return true; }) ? 0 : 1;
    }

    const Scene& scene_;
    std::vector<EmissiveTriangle> triangles_;
    std::vector<double> until_; // prefix sums of nits * area
    std::vector<Sun> suns_;
    double power_ = 0;
};

const auto any_node = [](Id<Node>) { return true; };

struct Click {
    double u, v;
    RayHit seen; // the first surface on its ray
};

// Clicks of three kinds: anywhere, in pixels at the border of two objects, and at the most grazing of many places.
std::vector<Click> clicks_into(const Frame& frame, const Scene& scene, const Projection& projection, std::mt19937_64& random) {
    constexpr size_t anywhere = 20, edges = 10, slants = 10, candidates_for_slants = 400;
    std::uniform_real_distribution<double> uniform;
    std::vector<Click> clicks;
    const auto add = [&](std::vector<Click>& to, double u, double v) {
        const ViewRay ray = projection.ray(u, v);
        if (const auto seen = cast_ray(scene, ray.origin, ray.direction, any_node)) to.push_back({u, v, *seen});
    };
    while (clicks.size() < anywhere) add(clicks, uniform(random), uniform(random));

    std::vector<std::array<int, 2>> borders;
    for (int y = 1; y < height; ++y)
        for (int x = 1; x < width; ++x) {
            const size_t i = size_t(y) * width + size_t(x);
            if (frame.object_id[i] != frame.object_id[i - 1] || frame.object_id[i] != frame.object_id[i - width]) borders.push_back({x, y});
        }
    while (!borders.empty() && clicks.size() < anywhere + edges) {
        const auto [x, y] = borders[size_t(uniform(random) * double(borders.size()))];
        add(clicks, (x + uniform(random)) / width, (y + uniform(random)) / height);
    }

    std::vector<Click> grazing;
    while (grazing.size() < candidates_for_slants) add(grazing, uniform(random), uniform(random));
    const auto cosine = [&](const Click& c) { return std::abs(dot(c.seen.normal, projection.ray(c.u, c.v).direction)); };
    std::ranges::sort(grazing, {}, cosine);
    clicks.insert(clicks.end(), grazing.begin(), grazing.begin() + slants);
    return clicks;
}

double standard_error(const MeterReading& r) { return (r.lux.high - r.lux.low) / 2 / student_95(r.rounds - 1); }

MeterReading read(const Scene& scene, const RenderSettings& settings, const MeterPlace& place, int rounds) {
    LightMeters meters({.threads = 1});
    meters.begin(scene, settings, {&place, 1});
    for (int round = 0; round < rounds; ++round) meters.round(32);
    return meters.readings()[0];
}

// The largest count with a probability of at least `alpha`, among n that each happen with probability p.
int most_by_chance(int n, double p, double alpha) {
    double term = std::pow(1 - p, n), below = 0;
    for (int k = 0; k < n; ++k) {
        if (below + term > 1 - alpha) return k;
        below += term;
        term *= p / (1 - p) * double(n - k) / double(k + 1);
    }
    return n;
}

class MeterClicks : public testing::TestWithParam<std::string> {};

TEST_P(MeterClicks, MeasureTheClickedPoint) {
    constexpr int scenes = 5, rounds = 64, reference_rounds = 2048;
    auto imported = import_gltf(std::string(BLUSH_ASSETS) + "/scenes/" + GetParam() + ".gltf");
    ASSERT_TRUE(imported) << imported.error().what;
    const Scene& scene = imported->scene;
    // In the corridor all visible light is indirect: the truth is then a long measurement without light sampling.
    const bool indirect = GetParam() == "corridor";
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    if (!indirect) settings.max_bounces = 1;
    RenderSettings other = settings;
    other.strategy = Strategy::bsdf;
    other.seed = settings.seed + 1;
    Renderer renderer({.threads = 1, .planes = {.normal = true, .depth = true, .ids = true}});
    renderer.update(scene, settings);
    renderer.render(0, 4);
    const Frame frame = renderer.resolve();
    const Projection projection(scene.view, double(width) / height);
    const DirectLight direct(scene);

    std::mt19937_64 random(uint64_t(GetParam().size()));
    const std::vector<Click> clicks = clicks_into(frame, scene, projection, random);
    int lit = 0, beyond_three_sigma = 0;
    for (const auto& [u, v, seen] : clicks) {
        const std::string where = fmt::format("{} at {}, {}", GetParam(), u, v);
        const std::optional<LightMeter> meter = meter_at(frame, scene, projection, u, v, "Meter");
        ASSERT_TRUE(meter) << where;
        const MeterPlace place = places_of(scene, {*meter})[0];
        const double distance = length(seen.position - projection.eye());
        EXPECT_LT(length(place.position - seen.position), statistics::float_rounding * distance) << where << ": not the clicked surface";
        EXPECT_GT(dot(place.normal, seen.normal), 1 - statistics::float_rounding) << where;
        const auto back = projection.project(place.position);
        ASSERT_TRUE(back) << where;
        EXPECT_LT(std::hypot((back->u - u) * width, (back->v - v) * height), 0.01) << where << ": beside the click, in pixels";

        const MeterReading r = read(scene, settings, place, rounds);
        double lux = 0, truth_error = 0;
        if (indirect) {
            const MeterReading reference = read(scene, other, place, reference_rounds);
            lux = reference.lux.value;
            truth_error = standard_error(reference);
        } else {
            std::tie(lux, truth_error) = direct.at(seen.position + seen.normal * place.clearance, seen.normal, 1000, random);
        }
        if (!r.lux.known) {
            EXPECT_EQ(lux, 0) << where;
            EXPECT_EQ(reading_text(r), "no light found yet");
            continue;
        }
        ++lit;
        const double error = std::hypot(standard_error(r), truth_error);
        beyond_three_sigma += std::abs(r.lux.value - lux) > 3 * error + statistics::float_rounding * lux;
        EXPECT_TRUE(statistics::z_verdict("illuminance", r.lux.value - lux, error, lux,
                                          statistics::sidak(statistics::significance, scenes * int64_t(clicks.size()))))
            << where;
    }
    EXPECT_GT(lit, int(clicks.size()) / 3) << "a shipped scene has light; in the Cornell box half of the clicks miss the box";
    // Each click alone is beyond 3 sigma with this probability.
    EXPECT_LE(beyond_three_sigma, most_by_chance(lit, statistics::normal_p(3), statistics::sidak(statistics::significance, scenes)))
        << "of " << lit;
}
INSTANTIATE_TEST_SUITE_P(Shipped, MeterClicks, testing::Values("card-and-mug", "cornell", "corridor", "furnace", "veach-mis"));

} // namespace
} // namespace blush::TEST_FILE
