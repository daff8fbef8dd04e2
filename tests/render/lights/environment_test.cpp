// Environment light: constant environments, maps of one bright texel, and what the camera sees of them.
#include "core/math.h"
#include "tests/render/irradiance.h"
#include "tests/support/images.h"

#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;
constexpr double pi = std::numbers::pi;

TEST(Environment, ConstantEnvironmentGivesIrradiancePi) {
    Scene scene;
    constant_world(scene, 3);
    EXPECT_TRUE(shows_on_floor(scene, [](const Vec3d&) { return 3 * pi; }));
}

constexpr int map_width = 16, map_height = 8;

Scene under_map(const std::vector<Vec3>& texels, float rotation_degrees) {
    Scene scene;
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = float_image(map_width, map_height, texels);
    scene.environment.intensity = 2;
    scene.environment.rotation_degrees = rotation_degrees;
    return scene;
}

// Radiance of the map, bilinear between texel centres, rotated
// counter-clockwise as seen from above; a second implementation, in double.
Vec3d map_radiance(const std::vector<Vec3>& texels, double rotation_degrees, const Vec3d& direction) {
    const double a = rotation_degrees * pi / 180, c = std::cos(a), s = std::sin(a);
    const Vec3d d{direction.x * c - direction.z * s, direction.y, direction.x * s + direction.z * c};
    const double u = (std::atan2(d.x, -d.z) / (2 * pi) + 0.5) * map_width - 0.5;
    const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * map_height - 0.5;
    const double left = std::floor(u), top = std::floor(v);
    Vec3d sum{0, 0, 0};
    for (const int i : {0, 1})
        for (const int j : {0, 1}) {
            const int column = (int(left) + i + map_width) % map_width, row = std::clamp(int(top) + j, 0, map_height - 1);
            const Vec3& t = texels[size_t(row * map_width + column)];
            sum = sum + Vec3d{t.x, t.y, t.z} * ((i ? u - left : 1 - u + left) * (j ? v - top : 1 - v + top));
        }
    return sum * 2.0;
}

double map_irradiance(const std::vector<Vec3>& texels, double rotation_degrees) {
    constexpr int rows = 64 * map_height, columns = 64 * map_width;
    double sum = 0;
    for (int i = 0; i < rows / 2; ++i) // above the horizon
        for (int j = 0; j < columns; ++j) {
            const double theta = pi * (i + 0.5) / rows, phi = 2 * pi * (j + 0.5) / columns;
            const Vec3d w{std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
            sum += map_radiance(texels, rotation_degrees, w).x * w.y * std::sin(theta);
        }
    return sum * (pi / rows) * (2 * pi / columns);
}

TEST(Environment, OneBrightTexelLightsAsItsIntegral) {
    constexpr int count = 12;
    for (const int row : {0, 1, 3})
        for (const int column : {0, 11})
            for (const float rotation : {0.f, 70.f}) {
                std::vector<Vec3> texels(map_width * map_height, Vec3{0, 0, 0});
                texels[size_t(row * map_width + column)] = {100, 100, 100};
                const double expected = map_irradiance(texels, double(rotation));
                EXPECT_TRUE(shows_on_floor(
                    under_map(texels, rotation), [&](const Vec3d&) { return expected; }, sidak(significance, count)))
                    << "texel " << column << ", " << row << ", rotated by " << rotation;
            }
}

TEST(Environment, CameraSeesTheMapInTheDirectionOfItsLight) {
    std::vector<Vec3> texels;
    for (int i = 0; i < map_width * map_height; ++i) texels.push_back({float(i % 7), float(i % 11), float(i % 5)});
    for (const float rotation : {0.f, -110.f}) {
        Scene scene = under_map(texels, rotation);
        const Vec3 towards = unit({0.7f, 0.4f, -0.6f});
        scene.view = looking({0, 0, 0}, towards, 0.002f);
        // In a tiny view the map is linear, and its middle is its mean.
        EXPECT_TRUE(is_mean(render(scene, settings_for(16, 16, 4)).whole(),
                            map_radiance(texels, double(rotation), {towards.x, towards.y, towards.z}), sidak(significance, 2), 1e-4));
    }
}

// MIS compensation: light sampling leaves the even part of the environment to BSDF sampling, and an even one takes no part in it.
class Compensated : public ::testing::Test {
protected:
    // A floor, a rough and a smooth ball and a lamp or many, under `sky`.
    static Scene under(const Environment& sky, int lamps) {
        Scene scene;
        scene.environment = sky;
        place(scene, floor_quad(2), lambert(0.7f));
        place(scene, sphere(true), metal(0.3f), at({-0.7f, 0.5f, 0}, 0.5f));
        place(scene, sphere(true), glass(0, 1.5f), at({0.7f, 0.5f, 0}, 0.5f));
        for (int i = 0; i < lamps; ++i) {
            Light lamp;
            lamp.kind = i % 2 ? Light::Kind::sphere : Light::Kind::point;
            lamp.radius = i % 2 ? 0.1f : 0;
            lamp.intensity = 3.f / float(lamps);
            place_light(scene, lamp, at({float(i % 7) * 0.5f - 1.5f, 1.2f, float(i / 7) * 0.5f - 1.5f}));
        }
        scene.view = looking({0, 2, 4}, {0, 0.4f, 0}, 0.5f);
        return scene;
    }
    static Environment even() {
        Environment sky;
        sky.kind = Environment::Kind::constant;
        sky.color = {0.3f, 0.5f, 0.7f};
        return sky;
    }
    static Environment uneven() {
        std::vector<Vec3> texels(map_width * map_height, Vec3{0.2f, 0.3f, 0.4f});
        for (int column = 0; column < map_width; ++column) texels[size_t(2 * map_width + column)] = {0.6f, 0.6f, 0.6f};
        texels[size_t(map_width + 3)] = {15, 12, 9};
        return under_map(texels, 30).environment;
    }
    static RenderSettings settings(bool compensates, Strategy strategy = Strategy::mis) {
        RenderSettings s = settings_for(16, 16, strategy == Strategy::mis ? 1024 : 4096);
        s.mis_compensation = compensates;
        s.strategy = strategy;
        s.caustics = CausticStrategy::off; // some lamps have no size: only MIS with light paths finds their caustics
        s.seed = 1 + uint32_t(strategy) + (compensates ? 8 : 0);
        return s;
    }
    static std::vector<Measured> blocks(const Scene& scene, const RenderSettings& s) { return render(scene, s).blocks(8, 8); }
};

TEST_F(Compensated, AgreesWithAllStrategies) {
    const std::pair<Environment, int> cases[] = {{even(), 0}, {even(), 1}, {even(), 40}, {uneven(), 0}, {uneven(), 1}, {uneven(), 40}};
    for (const auto& [sky, lamps] : cases) {
        const Scene scene = under(sky, lamps);
        const double alpha = sidak(significance, 3 * std::ssize(cases));
        const auto compensated = blocks(scene, settings(true));
        const std::string name = std::to_string(lamps) + " lamps, sky " + std::to_string(int(sky.kind));
        EXPECT_TRUE(same_means(compensated, blocks(scene, settings(false)), alpha)) << name;
        EXPECT_TRUE(same_means(compensated, blocks(scene, settings(false, Strategy::bsdf)), alpha)) << name << ", bsdf";
        RenderSettings shared = settings(true);
        shared.reuse = 8;
        shared.seed = 77;
        EXPECT_TRUE(same_means(compensated, blocks(scene, shared), alpha)) << name << ", path reuse";
    }
}

// Of other strategies it changes nothing.
TEST_F(Compensated, OnlyChangesMis) {
    for (const Strategy strategy : {Strategy::light, Strategy::bsdf, Strategy::mis}) {
        RenderSettings on = settings(true, strategy), off = on;
        on.spp = off.spp = 4;
        off.mis_compensation = false;
        const Scene scene = under(uneven(), 1);
        EXPECT_EQ(same_pixels(fresh_image(scene, on, 4), fresh_image(scene, off, 4)), strategy != Strategy::mis);
    }
}

TEST_F(Compensated, AnEvenSkyTakesNoSamplesOfLamps) {
    const auto shadow_rays = [](const Scene& scene, bool compensates) {
        RenderSettings s = settings(compensates);
        s.spp = 4;
        return fresh_image(scene, s, 4).rays.shadow;
    };
    EXPECT_EQ(shadow_rays(under(even(), 0), true), 0);
    EXPECT_GT(shadow_rays(under(even(), 0), false), 0);
    // All shadow rays go to the lamps: as many as without a sky, up to where paths end.
    EXPECT_GT(shadow_rays(under(even(), 1), true), 0);
    EXPECT_GT(shadow_rays(under(uneven(), 0), true), 0);
}

TEST(Environment, HiddenFromTheCameraItStillLights) {
    Scene scene;
    constant_world(scene, 1);
    scene.environment.visible_to_camera = false;
    place(scene, floor_quad(0.5f), lambert(0.5f));
    scene.view = looking_down(1, 1);
    const RenderedImage image = render(scene, settings_for(16, 16, 16));
    EXPECT_TRUE(is_mean(image.region(4, 4, 8, 8), 0.5));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool floor = x >= 4 && x < 12 && y >= 4 && y < 12;
            EXPECT_EQ(image.frame.rgba[size_t(4 * (16 * y + x) + 3)], floor ? 1 : 0);
            EXPECT_TRUE(floor || image.at(x, y) == (Vec3d{0, 0, 0}));
        }
}

} // namespace
} // namespace blush::test::TEST_FILE
