// Each kind of light on a matte floor, against its closed form, from several places and angles.
#include "core/math.h"
#include "irradiance.h"
#include "render/lowering.h"
#include "scene/affine.h"

#include <map>
#include <numbers>

namespace blush::test {
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

// Places and where the light points.
struct Pose {
    Vec3 position, direction;
};
const std::vector<Pose> poses = {
    {{0, 2, 0}, {0, -1, 0}}, {{0.5f, 0.6f, -0.3f}, {0.2f, -1, 0.1f}}, {{-3, 2, 1}, {1, -0.7f, -0.2f}}, {{20, 30, -10}, {-2, -3, 1}}};

Scene lit_by(const Light& light, const Pose& pose) {
    Scene scene;
    shine(scene, light, aimed(pose.position, pose.direction));
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

// Lux are measured facing the sun, whatever its angle, as long as none of it has set.
TEST(Sun, LightsWithTheCosine) {
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

TEST(RectangleLight, ShinesForwardsOnlyUnlessTwoSided) {
    Light light = light_of(Light::Kind::rectangle, 3);
    const Pose away{{0.2f, 1, 0.3f}, {0.3f, 1, 0}};
    EXPECT_TRUE(shows_on_floor(lit_by(light, away), [](const Vec3d&) { return 0; }));
    light.two_sided = true;
    const auto corners = rectangle_corners(light, aimed(away.position, away.direction));
    EXPECT_TRUE(shows_on_floor(lit_by(light, away), [&](const Vec3d& x) { return 3 * polygon_irradiance(x, up, corners); }));
}

// A sphere lights like a point in its middle. Ours is a polyhedron, whose exact light is the sum over its triangles.
TEST(SphereLight, LightsAsThePointWouldWithinItsFacets) {
    Light light = light_of(Light::Kind::point, 5);
    for (const auto& [pose, radius] : {std::pair{poses[0], 0.5f}, {poses[2], 0.2f}, {poses[3], 5.f}}) {
        light.radius = radius;
        const Scene scene = lit_by(light, pose);
        const Scene lowered = lower_area_lights(scene);
        const Id<Node> body{lowered_bit | scene.nodes.begin()->id.value};
        const Mesh& mesh = *lowered.meshes.find(lowered.nodes.find(body)->mesh);
        const Geometry& g = *mesh.parts[0].geometry;
        const Material& material = *lowered.materials.find(mesh.parts[0].material);
        const Affined world = world_from_node(lowered, body);
        std::vector<Vec3d> corners;
        for (const uint32_t i : g.indices) corners.push_back(transform_point(world, to_double(g.positions[i])));
        const auto of_polyhedron = [&](const Vec3d& x) {
            double sum = 0;
            for (size_t i = 0; i < corners.size(); i += 3) {
                const Vec3d& a = corners[i];
                if (dot(cross(corners[i + 1] - a, corners[i + 2] - a), x - a) > 0)
                    sum += polygon_irradiance(x, up, std::span(&corners[i], 3));
            }
            return sum * double(material.emissive.x * material.emissive_strength);
        };
        const Vec3d to = to_double(pose.position);
        // The projected area of the polyhedron differs by direction, within what it lacks to the ball's.
        EXPECT_NEAR(of_polyhedron({0, 0, 0}) / (5 * to.y / std::pow(length(to), 3)), 1, 0.003);
        // One value per pixel quarter would do: the light is smooth and its sum over two thousand triangles slow.
        const auto expected = [&, cache = std::map<std::pair<int, int>, double>()](const Vec3d& x) mutable {
            const std::pair key{int(std::floor(x.x * 16)), int(std::floor(x.z * 16))};
            const auto it = cache.find(key);
            if (it != cache.end()) return it->second;
            return cache[key] = of_polyhedron({(key.first + 0.5) / 16, 0, (key.second + 0.5) / 16});
        };
        EXPECT_TRUE(shows_on_floor(scene, expected, sidak(significance, 3))) << "radius " << radius;
    }
}

// Direct light is the first bounce: without any there is nothing but what emits, and more change nothing where nothing faces the floor.
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

// Choosing among lights by power must not change what any of them gives.
TEST(Lights, AddUp) {
    const Vec3 place_of_point{0.5f, 0.6f, -0.3f};
    Scene scene;
    shine(scene, light_of(Light::Kind::point, 5), at(place_of_point));
    constant_world(scene, 0.25f);
    Light off = light_of(Light::Kind::point, 100);
    off.enabled = false;
    shine(scene, off, at({0, 1, 0}));
    const auto of_point = [&](const Vec3d& x) {
        const Vec3d to = to_double(place_of_point) - x;
        return 5 * to.y / std::pow(length(to), 3);
    };
    Scene with_sun = scene;
    shine(with_sun, light_of(Light::Kind::sun, 2), aimed({0, 0, 0}, {1, -1, 0}));
    EXPECT_TRUE(shows_on_floor(
        with_sun, [&](const Vec3d& x) { return of_point(x) + 0.25 * pi + 2 * std::sqrt(0.5); }, sidak(significance, 2)));

    // The rectangle hides as much of the world as it lights.
    const Light area = light_of(Light::Kind::rectangle, 3);
    const Transform pose = aimed({-1, 1, 0.5f}, {1, -2, 0});
    Scene with_area = scene;
    shine(with_area, area, pose);
    const auto corners = rectangle_corners(area, pose);
    const auto expected = [&](const Vec3d& x) { return of_point(x) + 0.25 * pi + (3 - 0.25) * polygon_irradiance(x, up, corners); };
    EXPECT_TRUE(shows_on_floor(with_area, expected, sidak(significance, 2)));
}

} // namespace
} // namespace blush::test
