// Each kind of light on a diffuse floor, against its closed form, from several positions and angles.
#include "core/math.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/expanded_lights.h"
#include "render/lights/light_limits.h"
#include "scene/affine.h"
#include "tests/render/irradiance.h"

#include <algorithm>
#include <map>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;
constexpr double pi = std::numbers::pi;
constexpr Vec3d up{0, 1, 0};

Light light_of(Light::Kind kind, float intensity) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    return light;
}

// Positions and directions of the light.
struct Pose {
    Vec3 position, direction;
};
const std::vector<Pose> poses = {
    {{0, 2, 0}, {0, -1, 0}}, {{0.5f, 0.6f, -0.3f}, {0.2f, -1, 0.1f}}, {{-3, 2, 1}, {1, -0.7f, -0.2f}}, {{20, 30, -10}, {-2, -3, 1}}};

Scene lit_by(const Light& light, const Pose& pose) {
    Scene scene;
    place_light(scene, light, aimed(pose.position, pose.direction));
    return scene;
}

TEST(PointLight, FallsOffWithTheSquare) {
    for (const Pose& pose : poses) {
        const Vec3d p = to_double(pose.position);
        const auto expected = [&](const Vec3d& x) {
            const Vec3d to = p - x;
            return 5 * to.y / std::pow(length(to), 3);
        };
        EXPECT_TRUE(shows_on_floor(lit_by(light_of(Light::Kind::point, 5), pose), expected, sidak(significance, 4)));
    }
}

// KHR_lights_punctual: inside the inner cone as a point, between the cones the square of a linear ramp of the cosine.
TEST(SpotLight, HasTheSpecifiedCone) {
    Light light = light_of(Light::Kind::spot, 5);
    light.inner_cone_radians = 0.2f;
    light.outer_cone_radians = 0.7f;
    for (const Pose& pose : poses) {
        const Vec3d p = to_double(pose.position), axis = normalize(to_double(pose.direction));
        const double inner = std::cos(double(light.inner_cone_radians)), outer = std::cos(double(light.outer_cone_radians));
        const auto expected = [&](const Vec3d& x) {
            const Vec3d to = p - x;
            const double ramp = std::clamp((-dot(normalize(to), axis) - outer) / (inner - outer), 0.0, 1.0);
            return 5 * ramp * ramp * to.y / std::pow(length(to), 3);
        };
        EXPECT_TRUE(shows_on_floor(lit_by(light, pose), expected, sidak(significance, 4)));
    }
}

// Lux are measured facing the sun, for any angular size, as long as it is entirely above the horizon.
TEST(Sun, IrradianceFollowsTheCosine) {
    for (const float angle : {0.f, 0.0092f, 0.3f})
        for (const Vec3& direction : {Vec3{0, -1, 0}, Vec3{1, -1, 0.5f}, Vec3{-1, -0.3f, 0.2f}}) {
            Light light = light_of(Light::Kind::sun, 7);
            light.angle_radians = angle;
            const double cos = -normalize(to_double(direction)).y;
            EXPECT_TRUE(shows_on_floor(
                lit_by(light, {{0, 0, 0}, direction}), [&](const Vec3d&) { return 7 * cos; }, sidak(significance, 9)))
                << "angle " << angle << ", cosine " << cos;
        }
}

TEST(RectangleLight, IsLambertsPolygon) {
    Light light = light_of(Light::Kind::rectangle, 3);
    light.width = 0.8f;
    light.height = 0.3f;
    for (const Pose& pose : poses) {
        const auto corners = rectangle_corners(light, aimed(pose.position, pose.direction));
        EXPECT_TRUE(shows_on_floor(
            lit_by(light, pose), [&](const Vec3d& x) { return 3 * polygon_irradiance(x, up, corners); }, sidak(significance, 4)));
    }
}

TEST(RectangleLight, EmitsForwardsOnlyUnlessTwoSided) {
    Light light = light_of(Light::Kind::rectangle, 3);
    const Pose away{{0.2f, 1, 0.3f}, {0.3f, 1, 0}};
    EXPECT_TRUE(shows_on_floor(lit_by(light, away), [](const Vec3d&) { return 0; }));
    light.two_sided = true;
    const auto corners = rectangle_corners(light, aimed(away.position, away.direction));
    EXPECT_TRUE(shows_on_floor(lit_by(light, away), [&](const Vec3d& x) { return 3 * polygon_irradiance(x, up, corners); }));
}

// Points of the floor that see the whole sphere get the irradiance
// of a point at its centre, at any distance: E = pi L (r / d)^2 cos.
TEST(SphereLight, IrradianceIsThatOfAPointAtItsCentre) {
    for (const auto& [pose, radius] :
         {std::pair{poses[0], 0.5f}, {poses[2], 0.2f}, {poses[3], 5.f}, {Pose{{0.3f, 0.7f, 0}, {0, -1, 0}}, 0.55f}, {poses[1], 1e-4f}}) {
        const Vec3d p = to_double(pose.position);
        Light light = light_of(Light::Kind::sphere, 3);
        light.radius = radius;
        const double candela = 3 * pi * double(radius) * double(radius);
        const auto of_sphere = [&](const Vec3d& x) { return candela * (p - x).y / std::pow(length(p - x), 3); };
        EXPECT_TRUE(shows_on_floor(lit_by(light, pose), of_sphere, sidak(significance, 10))) << "sphere of radius " << radius;

        light.kind = Light::Kind::point;
        light.intensity = 5;
        const auto of_point = [&](const Vec3d& x) { return 5 * (p - x).y / std::pow(length(p - x), 3); };
        EXPECT_TRUE(shows_on_floor(lit_by(light, pose), of_point, sidak(significance, 10))) << "point of radius " << radius;
    }
}

// A node scales its light: a sphere keeps its nits, a point its candela.
TEST(SphereLight, IsScaledByItsNode) {
    for (const Light::Kind kind : {Light::Kind::sphere, Light::Kind::point}) {
        Light light = light_of(kind, 3);
        light.radius = 0.1f;
        Scene scene;
        place_light(scene, light, at({0, 2, 0}, 4));
        const double candela = kind == Light::Kind::sphere ? 3 * pi * 0.16 : 3;
        EXPECT_TRUE(shows_on_floor(
            scene,
            [&](const Vec3d& x) {
                const Vec3d to = Vec3d{0, 2, 0} - x;
                return candela * to.y / std::pow(length(to), 3);
            },
            sidak(significance, 2)));
    }
}

TEST(SphereLight, IsBlackFromInside) {
    Light light = light_of(Light::Kind::sphere, 3);
    light.radius = 5;
    EXPECT_TRUE(shows_on_floor(lit_by(light, poses[0]), [](const Vec3d&) { return 0; }));
}

// Floor and disk in parallel planes: Howell's catalogue of configuration factors, B-12, exact everywhere.
double parallel_disk_irradiance(const Vec3d& x, const Vec3d& center, double radius) {
    const double h = center.y - x.y, a2 = (center.x - x.x) * (center.x - x.x) + (center.z - x.z) * (center.z - x.z);
    const double z = a2 + h * h + radius * radius;
    return pi / 2 * (1 - (z - 2 * radius * radius) / std::sqrt(z * z - 4 * radius * radius * a2));
}

TEST(DiskLight, IsItsConfigurationFactor) {
    for (const auto& [height, radius] : {std::pair{2.f, 0.3f}, {0.5f, 1.f}, {1.f, 4.f}}) {
        Light light = light_of(Light::Kind::disk, 3);
        light.radius = radius;
        const Vec3 center{0.2f, height, -0.1f};
        EXPECT_TRUE(shows_on_floor(
            lit_by(light, {center, {0, -1, 0}}),
            [&](const Vec3d& x) { return 3 * parallel_disk_irradiance(x, to_double(center), double(radius)); }, sidak(significance, 3)))
            << "height " << height << ", radius " << radius;
    }
}

// Tilted disks, compared with a polygon of many corners.
TEST(DiskLight, EmitsObliquelyAndOnTwoSides) {
    Light light = light_of(Light::Kind::disk, 3);
    light.radius = 0.4f;
    for (const Pose& pose : {poses[1], poses[2], Pose{{0.2f, 1, 0.3f}, {0.3f, 1, 0}}}) {
        light.two_sided = pose.direction.y > 0;
        const Affined world = to_affine(aimed(pose.position, pose.direction));
        std::vector<Vec3d> rim;
        for (int i = 0; i < 3000; ++i) {
            const double turn = 2 * pi * i / 3000, r = double(light.radius);
            rim.push_back(transform_point(world, Vec3d{r * std::cos(turn), r * std::sin(turn), 0}));
        }
        // Smooth: cached per 1/16 m.
        const auto expected = [&, cache = std::map<std::pair<int, int>, double>()](const Vec3d& x) mutable {
            const std::pair key{int(std::floor(x.x * 16)), int(std::floor(x.z * 16))};
            const auto [it, is_new] = cache.try_emplace(key);
            if (is_new) it->second = 3 * polygon_irradiance({(key.first + 0.5) / 16, 0, (key.second + 0.5) / 16}, up, rim);
            return it->second;
        };
        EXPECT_TRUE(shows_on_floor(lit_by(light, pose), expected, sidak(significance, 3)));
    }
}

// Direct light is the first bounce: with 0 bounces only emission is visible; more change nothing if nothing faces the floor.
TEST(Lights, TakeOneBounce) {
    const Scene scene = lit_by(light_of(Light::Kind::rectangle, 3), poses[0]);
    const auto corners = rectangle_corners(light_of(Light::Kind::rectangle, 3), aimed(poses[0].position, poses[0].direction));
    for (const int bounces : {0, 1, 2, 7}) {
        RenderSettings settings = settings_for(16, 16, 64);
        settings.max_bounces = bounces;
        const auto expected = [&](const Vec3d& x) { return bounces == 0 ? 0 : 3 * polygon_irradiance(x, up, corners); };
        EXPECT_TRUE(shows_on_floor(scene, expected, sidak(significance, 4), settings)) << bounces << " bounces";
    }
}

// Light selection by power must not change any light's contribution.
TEST(Lights, AddUp) {
    const Vec3 place_of_point{0.5f, 0.6f, -0.3f};
    Scene scene;
    place_light(scene, light_of(Light::Kind::point, 5), at(place_of_point));
    constant_world(scene, 0.25f);
    Light off = light_of(Light::Kind::point, 100);
    off.enabled = false;
    place_light(scene, off, at({0, 1, 0}));
    const auto of_point = [&](const Vec3d& x) {
        const Vec3d to = to_double(place_of_point) - x;
        return 5 * to.y / std::pow(length(to), 3);
    };
    Scene with_sun = scene;
    place_light(with_sun, light_of(Light::Kind::sun, 2), aimed({0, 0, 0}, {1, -1, 0}));
    EXPECT_TRUE(shows_on_floor(
        with_sun, [&](const Vec3d& x) { return of_point(x) + 0.25 * pi + 2 * std::sqrt(0.5); }, sidak(significance, 2)));

    // The rectangle blocks as much of the environment as it illuminates.
    const Light area = light_of(Light::Kind::rectangle, 3);
    const Transform pose = aimed({-1, 1, 0.5f}, {1, -2, 0});
    Scene with_area = scene;
    place_light(with_area, area, pose);
    const auto corners = rectangle_corners(area, pose);
    const auto expected = [&](const Vec3d& x) { return of_point(x) + 0.25 * pi + (3 - 0.25) * polygon_irradiance(x, up, corners); };
    EXPECT_TRUE(shows_on_floor(with_area, expected, sidak(significance, 2)));
}

// Each takes a hundred bytes of a file. The polygons keep the area, so also the lumens.
TEST(DiskLight, AnyNumberIsBoundedInMemory) {
    const auto disks = [](int count) {
        Scene scene;
        Light light = light_of(Light::Kind::disk, 3);
        light.radius = 0.4f;
        Node node;
        node.light = scene.lights.add(light);
        for (int i = 0; i < count; ++i) {
            node.local.translation = {float(i % 100), 0, float(i / 100)};
            scene.nodes.add(node);
        }
        return scene;
    };
    for (const auto& [count, corners] : std::map<int, int>{{1, 96}, {10922, 96}, {10923, 48}, {43690, 24}, {200'000, 6}}) {
        const Scene scene = disks(count);
        EXPECT_EQ(disk_corners(scene, nodes_with_lights(scene)), corners) << count;
    }
    constexpr int count = 90'000;
    const Scene scene = disks(count);
    const Scene expanded = expand_area_lights(scene);
    const Geometry& shape = *expanded.meshes.begin()->value.parts[0].geometry;
    ASSERT_EQ(shape.triangle_count(), 6u);
    double area = 0;
    for (size_t t = 0; t < 6; ++t) {
        const Vec3d a = to_double(shape.positions[shape.indices[3 * t]]);
        area += 0.5 * length(cross(to_double(shape.positions[shape.indices[3 * t + 1]]) - a,
                                   to_double(shape.positions[shape.indices[3 * t + 2]]) - a));
    }
    EXPECT_NEAR(area, pi, 1e-6);
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(scene, settings_for(8, 8, 1));
    EXPECT_EQ(renderer.info().emissive_triangles, 6 * count);
    EXPECT_LT(renderer.info().memory_mb, 300);
    EXPECT_TRUE(std::ranges::any_of(renderer.info().warnings,
                                    [](const Diagnostic& d) { return d.what.find("polygon of 6 corners") != d.what.npos; }));
}

} // namespace
} // namespace blush::test::TEST_FILE
