// Lights with directional emission or hidden from the camera: against quadrature, and equal for all strategies.
#include "core/math.h"
#include "render/lights/light_profiles.h"
#include "scene/affine.h"
#include "scene/lights/ies_profile.h"
#include "tests/render/irradiance.h"

#include <map>
#include <memory>
#include <numbers>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;
constexpr double pi = std::numbers::pi;

Light light_of(Light::Kind kind, float intensity) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    return light;
}
Scene lit_by(const Light& light, const Transform& pose) {
    Scene scene;
    place_light(scene, light, pose);
    return scene;
}

// Irradiance of the floor from a flat light: `point(s, t)` maps the unit square onto it, uniformly by area.
template <class Point, class Radiance> double from_area(const Vec3d& x, double area, const Vec3d& normal, Point point, Radiance radiance) {
    constexpr int n = 24;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3d to = point((i + 0.5) / n, (j + 0.5) / n) - x, wi = normalize(to);
            sum += radiance(wi * -1.0) * std::max(0.0, wi.y) * std::max(0.0, -dot(wi, normal)) / dot(to, to);
        }
    return sum * area / (double(n) * n);
}

// Smooth functions of the floor that are slow to compute: cached per 1/32 m.
template <class Fn> FloorIrradiance coarse(Fn fn) {
    return [fn, cache = std::make_shared<std::map<std::pair<int, int>, double>>()](const Vec3d& x) {
        const std::pair key{int(std::floor(x.x * 32)), int(std::floor(x.z * 32))};
        const auto [it, is_new] = cache->try_emplace(key);
        if (is_new) it->second = fn(Vec3d{(key.first + 0.5) / 32, 0, (key.second + 0.5) / 32});
        return it->second;
    };
}

// The documented falloff: max(0, tan h - tan theta) / (tan h - h).
double spread_factor(double spread, double cos_theta) {
    const double h = spread / 2, tangent = std::sqrt(1 / (cos_theta * cos_theta) - 1);
    return cos_theta > 0 ? std::max(0.0, std::tan(h) - tangent) / (std::tan(h) - h) : 0;
}

TEST(Spread, KeepsTheFluxOfEveryAngle) {
    for (const double spread : {0.01, 0.5, 1.5, 2.5, 3.1}) {
        double flux = 0;
        constexpr int n = 200'000;
        const double h = spread / 2;
        for (int i = 0; i < n; ++i) {
            const double theta = h * (i + 0.5) / n;
            flux += 2 * pi * spread_factor(spread, std::cos(theta)) * std::cos(theta) * std::sin(theta) * h / n;
        }
        EXPECT_NEAR(flux / pi, 1, 1e-6) << spread;
    }
}

TEST(Spread, NarrowsRectanglesAndDisks) {
    for (const float spread : {0.6f, 2.f}) {
        const Transform pose = aimed({0.1f, 1.5f, 0.2f}, {0.2f, -1, 0.1f});
        const Affined world = to_affine(pose);
        const Vec3d normal = world.z * -1.0;
        const auto radiance = [&](const Vec3d& away) { return 3 * spread_factor(double(spread), dot(away, normal)); };
        Light panel = light_of(Light::Kind::rectangle, 3);
        panel.width = 0.8f;
        panel.height = 0.3f;
        panel.spread_radians = spread;
        const auto on_panel = [&](double s, double t) { return transform_point(world, Vec3d{0.8 * (s - 0.5), 0.3 * (t - 0.5), 0}); };
        EXPECT_TRUE(shows_on_floor(lit_by(panel, pose),
                                   coarse([&](const Vec3d& x) { return from_area(x, 0.24, normal, on_panel, radiance); }),
                                   sidak(significance, 4)));
        Light disk = light_of(Light::Kind::disk, 3);
        disk.radius = 0.4f;
        disk.spread_radians = spread;
        const auto on_disk = [&](double s, double t) {
            const double r = 0.4 * std::sqrt(s);
            return transform_point(world, Vec3d{r * std::cos(2 * pi * t), r * std::sin(2 * pi * t), 0});
        };
        EXPECT_TRUE(shows_on_floor(lit_by(disk, pose),
                                   coarse([&](const Vec3d& x) { return from_area(x, pi * 0.16, normal, on_disk, radiance); }),
                                   sidak(significance, 4)));
    }
}

// For a sphere, radiance in each direction is candela / disk area, integrated over the cone that it subtends.
template <class Candela> double from_sphere(const Vec3d& x, const Vec3d& center, double radius, Candela candela) {
    const Vec3d to = center - x;
    const double sin2 = radius * radius / dot(to, to), height = 1 - std::sqrt(1 - sin2);
    const Basis<double> frame = basis_around(normalize(to));
    constexpr int n = 24;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double cos = 1 - height * (i + 0.5) / n, sin = std::sqrt(1 - cos * cos), turn = 2 * pi * (j + 0.5) / n;
            const Vec3d wi = frame.to_world(Vec3d{sin * std::cos(turn), sin * std::sin(turn), cos});
            sum += std::max(0.0, wi.y) * candela(wi * -1.0);
        }
    return sum / (double(n) * n) * 2 * pi * height / (pi * radius * radius);
}

TEST(SpotLight, WithASizeKeepsItsCandela) {
    Light light = light_of(Light::Kind::spot, 5);
    light.inner_cone_radians = 0.1f;
    light.outer_cone_radians = 0.5f;
    light.radius = 0.3f;
    const Transform pose = aimed({-0.5f, 1.5f, 0.3f}, {0.4f, -1, 0});
    const Vec3d axis = to_affine(pose).z * -1.0, center{-0.5, 1.5, double(0.3f)};
    const auto candela = [&](const Vec3d& away) {
        const double ramp = std::clamp((dot(away, axis) - std::cos(0.5)) / (std::cos(0.1) - std::cos(0.5)), 0.0, 1.0);
        return 5 * ramp * ramp;
    };
    EXPECT_TRUE(shows_on_floor(lit_by(light, pose), coarse([&](const Vec3d& x) { return from_sphere(x, center, double(0.3f), candela); })));
}

IesPtr lamp(IesProfile::Type type) {
    IesProfile p;
    p.type = type;
    const bool c = type == IesProfile::Type::c;
    p.vertical = c ? std::vector<float>{0, 20, 50, 90} : std::vector<float>{-60, 0, 30, 60};
    p.horizontal = c ? std::vector<float>{0, 90, 180, 270, 360} : std::vector<float>{-90, -30, 0, 45, 90};
    p.candela = {800, 500, 200, 0, 800, 900, 100, 20, 800, 300, 250, 10, 800, 1000, 0, 0, 800, 500, 200, 0};
    p.peak = 1000;
    return std::make_shared<const IesProfile>(std::move(p));
}

TEST(IesLight, HasTheCandelaOfEachDirection) {
    for (const IesProfile::Type type : {IesProfile::Type::b, IesProfile::Type::c})
        for (const float radius : {0.f, 0.2f}) {
            Light light = light_of(Light::Kind::point, 5);
            light.ies = lamp(type);
            light.radius = radius;
            const Transform pose = aimed({0.3f, 1, -0.2f}, {0.2f, -1, 0.3f});
            const Affined world = to_affine(pose);
            const auto candela = [&](const Vec3d& away) {
                return 5 * candela_towards(*light.ies, Vec3d{dot(away, world.x), dot(away, world.y), dot(away, world.z)}) / 1000;
            };
            const auto expected = [&](const Vec3d& x) {
                const Vec3d center = to_double(pose.translation), to = center - x;
                return radius > 0 ? from_sphere(x, center, double(radius), candela)
                                  : candela(normalize(to) * -1.0) * to.y / std::pow(length(to), 3);
            };
            EXPECT_TRUE(
                shows_on_floor(lit_by(light, pose), radius > 0 ? coarse(expected) : FloorIrradiance(expected), sidak(significance, 4)))
                << "type " << int(type) << ", radius " << radius;
        }
}

// The kernel's lookup matches the table for all directions, including a rotated and mirrored node.
TEST(IesLight, TheKernelReadsTheTable) {
    std::mt19937 rng(3);
    std::normal_distribution<double> normal;
    for (const IesProfile::Type type : {IesProfile::Type::b, IesProfile::Type::c})
        for (const double mirror : {1.0, -1.0}) {
            Light light = light_of(Light::Kind::point, 1);
            light.ies = lamp(type);
            Affined world = to_affine(aimed({0, 0, 0}, {0.3f, -0.5f, 0.8f}));
            world.x = world.x * mirror;
            LightProfiles profiles;
            ASSERT_EQ(profiles.add(light, world).profile, 0);
            for (int i = 0; i < 20'000; ++i) {
                const Vec3d local = normalize(Vec3d{normal(rng), normal(rng), normal(rng)});
                const Vec3 w = to_float(transform_vector(world, local));
                const double expected = candela_towards(*light.ies, local) / 1000;
                // The arc tangent has an error of 1.4e-7 turns, and the table rises by at most a thousandth of its peak in a
                // tenth of a degree; at its edge either side is valid.
                const double seen = double(profile_factor<float>(profiles.tables(), 0, w, true));
                if ((seen == 0) != (expected == 0)) continue;
                EXPECT_NEAR(seen, expected, 1e-4);
            }
        }
}

std::vector<Measured> blocks(const Scene& scene, Strategy strategy, int64_t spp) {
    RenderSettings settings = settings_for(16, 16, spp);
    settings.strategy = strategy;
    settings.seed = 1 + uint32_t(strategy);
    return render(scene, settings).blocks(8, 8);
}

// Every light kind that scattered rays can hit, above a diffuse floor and a half-rough wall.
Scene with_all_kinds_of_lights(bool seen) {
    Scene scene;
    place(scene, floor_quad(3), lambert(0.6f));
    place(scene, quad({-2, 0, -1}, {2, 0, -1}, {2, 2, -1}, {-2, 2, -1}), plastic(0.5f));
    Light light = light_of(Light::Kind::sphere, 3);
    light.visible_to_camera = seen;
    light.radius = 0.3f;
    place_light(scene, light, at({-0.7f, 0.6f, 0}));
    light.kind = Light::Kind::spot;
    light.intensity = 2;
    light.outer_cone_radians = 1.2f;
    light.radius = 0.25f;
    place_light(scene, light, aimed({0.8f, 1.2f, 0}, {0, -1, -0.5f}));
    light.kind = Light::Kind::point;
    light.ies = lamp(IesProfile::Type::c);
    place_light(scene, light, aimed({0, 1.4f, 0.6f}, {0, -1, 0}));
    light.kind = Light::Kind::rectangle;
    light.intensity = 5;
    light.spread_radians = 1.8f;
    light.width = light.height = 0.6f;
    place_light(scene, light, aimed({0.2f, 1, 0.8f}, {0, -0.3f, -1}));
    light.kind = Light::Kind::disk;
    light.radius = 0.4f;
    place_light(scene, light, aimed({-1, 1.5f, 0.5f}, {0.3f, -1, -0.3f}));
    scene.view = looking({0, 1, 4}, {0, 0.6f, 0}, 0.7f);
    return scene;
}

TEST(LightProfiles, StrategiesAgree) {
    const Scene scene = with_all_kinds_of_lights(true);
    const auto mis = blocks(scene, Strategy::mis, 256);
    EXPECT_TRUE(same_means(mis, blocks(scene, Strategy::light, 256), sidak(significance, 2))) << "light";
    EXPECT_TRUE(same_means(mis, blocks(scene, Strategy::bsdf, 2048), sidak(significance, 2))) << "bsdf";
}

TEST(HiddenLights, AreInvisibleButEmitAndAreReflected) {
    for (const Light::Kind kind : {Light::Kind::rectangle, Light::Kind::disk, Light::Kind::sphere}) {
        Light light = light_of(kind, 3);
        light.radius = 0.4f;
        // From above, with the light between the eye and the floor and turned to either.
        const auto brightness = [&](bool seen, const Vec3& direction, const Material& floor, int bounces) {
            light.visible_to_camera = seen;
            Scene scene = lit_by(light, aimed({0, 0.8f, 0}, direction));
            place(scene, floor_quad(3), floor);
            scene.view = looking({0, 3, 4}, {0, 0, 0}, 0.9f);
            RenderSettings settings = settings_for(16, 16, 16);
            settings.max_bounces = bounces;
            return render(scene, settings).whole().mean.x;
        };
        const Vec3 up_again{0, 1, 0.5f}, down{0, -1, -0.5f};
        EXPECT_GT(brightness(true, up_again, metal(0), 0), 0.05);
        EXPECT_EQ(brightness(false, up_again, metal(0), 0), 0) << "not seen";
        EXPECT_GT(brightness(false, down, metal(0), 1), 0.01) << "reflected";
        EXPECT_GT(brightness(false, down, lambert(0.5f), 1), 0.01) << "shining";
    }
}

TEST(HiddenLights, ASunIsNotSeenInTheSky) {
    Light sun = light_of(Light::Kind::sun, 2);
    sun.angle_radians = 0.5f;
    for (const bool seen : {true, false}) {
        sun.visible_to_camera = seen;
        Scene scene = lit_by(sun, aimed({0, 0, 0}, {0, -0.2f, 1}));
        scene.view = looking({0, 1, 4}, {0, 1.8f, 0}, 0.7f);
        EXPECT_EQ(render(scene, settings_for(16, 16, 4)).whole().mean.x > 0, seen);
        EXPECT_TRUE(shows_on_floor(
            lit_by(sun, aimed({0, 0, 0}, {0, -1, 0})), [](const Vec3d&) { return 2; }, sidak(significance, 2)));
    }
}

TEST(Backdrop, IsSeenAndLightsNothing) {
    Scene scene;
    constant_world(scene, 0.7f);
    scene.environment.lights_scene = false;
    EXPECT_TRUE(shows_on_floor(scene, [](const Vec3d&) { return 0; }));
    scene.view = looking({0, 1, 0}, {0, 2, 0.1f}, 0.7f);
    EXPECT_TRUE(is_mean(render(scene, settings_for(16, 16, 4)).whole(), double(0.7f)));
    scene.environment.visible_to_camera = false;
    EXPECT_EQ(render(scene, settings_for(16, 16, 4)).whole().mean.x, 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
