// A light meter measures the illuminance at exactly the clicked point, also at edges and on slopes, in all shipped scenes.
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

#include <gtest/gtest.h>
#include <numbers>
#include <random>

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
                const double angle = sun.half_angle * std::sqrt(u), phi = 2 * pi * v; // a disk this small can be treated as flat
                const Vec3d wi = normalize(sun.towards + (s * std::cos(phi) + t * std::sin(phi)) * std::tan(angle));
                return std::max(0.0, dot(n, wi)) * sun.lux * sees(x, wi);
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

class MeterClicks : public testing::TestWithParam<std::string> {};

TEST_P(MeterClicks, MeasureTheClickedPoint) {
    auto imported = import_gltf(std::string(BLUSH_ASSETS) + "/scenes/" + GetParam() + ".gltf");
    ASSERT_TRUE(imported) << imported.error().what;
    const Scene& scene = imported->scene;
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.max_bounces = 1; // only direct light
    Renderer renderer({.threads = 1, .planes = {.normal = true, .depth = true, .ids = true}});
    renderer.update(scene, settings);
    renderer.render(0, 4);
    const Frame frame = renderer.resolve();
    const Projection projection(scene.view, double(width) / height);
    const DirectLight truth(scene);

    std::mt19937_64 random(uint64_t(GetParam().size()));
    std::uniform_real_distribution<double> uniform;
    constexpr int clicks = 40;
    int lit = 0;
    for (int i = 0; i < clicks; ++i) {
        std::optional<LightMeter> meter;
        double u = 0, v = 0;
        for (int tries = 0; !meter && tries < 1000; ++tries) {
            u = uniform(random);
            v = uniform(random);
            meter = meter_at(frame, scene, projection, u, v, "Meter");
        }
        ASSERT_TRUE(meter);
        const std::vector<MeterPlace> places = places_of(scene, {*meter});
        const auto [lux, truth_error] =
            truth.at(places[0].position + places[0].normal * places[0].clearance, places[0].normal, 400, random);

        LightMeters meters({.threads = 1});
        meters.begin(scene, settings, places);
        for (int round = 0; round < 64; ++round) meters.round(32);
        const MeterReading& r = meters.readings()[0];
        if (!r.lux.known) {
            EXPECT_EQ(lux, 0) << GetParam() << " at " << u << ", " << v;
            EXPECT_EQ(reading_text(r), "no light found yet");
            continue;
        }
        ++lit;
        const double error = (r.lux.high - r.lux.low) / 2 / student_95(r.rounds - 1);
        EXPECT_TRUE(statistics::z_verdict("illuminance", r.lux.value - lux, std::max(std::hypot(error, truth_error), 1e-4 * lux), lux,
                                          statistics::sidak(statistics::significance, 5 * clicks)))
            << GetParam() << " at " << u << ", " << v;
    }
    // The visible part of the corridor only has indirect light.
    if (GetParam() != "corridor")
        EXPECT_GT(lit, clicks / 2) << "most of a shipped scene is lit";
    else
        EXPECT_EQ(lit, 0);
}
INSTANTIATE_TEST_SUITE_P(Shipped, MeterClicks, testing::Values("card-and-mug", "cornell", "corridor", "furnace", "veach-mis"));

} // namespace
} // namespace blush::TEST_FILE
