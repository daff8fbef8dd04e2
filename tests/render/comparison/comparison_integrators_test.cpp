// Biased integrators: right where their assumption holds, caught as biased where it does not.
#include "measure/convergence/reference.h"
#include "measure/statistics/intervals.h"
#include "render/comparison/comparison_integrator.h"
#include "render/comparison/light_probes.h"
#include "tests/render/comparison/comparison_images.h"

#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

ComparisonIntegrator integrator(const std::string& text) { return *parse_integrator(text); }

// Walls that emit 1 nit and reflect half: radiance 1 / (1 - 0.5) everywhere.
Scene glowing_room() {
    Scene scene = glowing_walls();
    scene.view = looking({0, 0, 0.9f}, {0, 0, 0}, 1);
    return scene;
}

double rms_difference(const Frame& a, const Frame& b) {
    double sum = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i) sum += std::pow(double(a.rgba[i]) - double(b.rgba[i]), 2);
    return std::sqrt(sum / double(a.rgba.size()));
}

// Seeds are independent images, records included.
TEST(IrradianceCache, IsRightWhereIndirectLightIsEven) {
    const Scene room = glowing_room();
    BlockMoments moments;
    for (uint32_t seed = 0; seed < 16; ++seed) {
        RenderSettings settings = settings_for(16, 16, 4);
        settings.seed = seed;
        const auto renderer = integrator_render(room, settings, "irradiance-cache,rays=64");
        const Measured whole = image_of(*renderer).whole();
        moments.add({&whole, 1});
    }
    EXPECT_TRUE(is_mean(moments.measured()[0], 2));
}

TEST(IrradianceCache, WithoutRecordsIsUnbiased) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(48, 48, 64);
    const MeasuredImage without = measured_image(*integrator_render(scene, settings, "irradiance-cache,a=0"));
    settings.seed = 1;
    settings.spp = 512;
    const BiasTest test = test_bias(without, measured_image(*integrator_render(scene, settings, "path")));
    EXPECT_FALSE(test.biased) << test.worst.percent() << " % at z " << test.worst.z();
}

// The middle of a wall, far from the edges, where disks leave the surface. Images of several seeds, with records and photons of their own.
Measured wall(const Scene& room, const std::string& text) {
    BlockMoments moments;
    for (uint32_t seed = 0; seed < 16; ++seed) {
        RenderSettings settings = settings_for(8, 8, 8);
        settings.seed = seed;
        const Measured whole = image_of(*integrator_render(room, settings, text)).whole();
        moments.add({&whole, 1});
    }
    return moments.measured()[0];
}

TEST(PhotonMap, IsRightInTheMiddleOfGlowingWalls) {
    Scene room = glowing_room();
    room.view = looking({0, 0, 0.9f}, {0, 0, -1}, 0.3f);
    EXPECT_TRUE(is_mean(wall(room, "photon-map,photons=20000,radius=0.2"), 2));
}

// Disks that reach beyond an edge, where gather rays meet them, lack photons: a strip of the radius along the edges of the cube is a
// share of at most 4 radii of a face, and the light of one reflection is a quarter of the radiance.
TEST(PhotonMap, FinalGatherIsRightWithSmallDisks) {
    EXPECT_TRUE(is_mean(wall(glowing_room(), "photon-map,photons=100000,radius=0.02,gather=4"), 2, significance, 4 * 0.02 * 0.5));
}

TEST(PhotonMap, FinalGatherHidesTheSizeOfTheDisks) {
    // All of the picture, with its edges.
    const Scene room = glowing_room();
    const double map = std::abs(wall(room, "photon-map,photons=20000,radius=0.2").mean.x - 2),
                 gathered = std::abs(wall(room, "photon-map,photons=20000,radius=0.2,gather=8").mean.x - 2);
    EXPECT_LT(gathered, map);
}

// Lights without size, and the sky through a window, send photons, too.
TEST(PhotonMap, AgreesWithPathTracingForEachKindOfLight) {
    Scene room;
    place(room, cube(true), lambert(0.7f));
    room.view = looking({0, 0, 0.9f}, {0, 0, -1}, 0.3f);
    Scene spot = room, bulb = room, window;
    place_light(spot, {.kind = Light::Kind::spot, .intensity = 5}, aimed({0, 0.5f, 0}, {0, -1, 0}));
    place_light(bulb, {.kind = Light::Kind::sphere, .intensity = 5, .radius = 0.1f}, at({0.5f, 0.5f, 0.5f}));
    place(window, floor_quad(1, -0.5f), lambert(0.7f));
    place(window, ceiling_quad(1, 0.5f), lambert(0.7f));
    constant_world(window, 1);
    window.view = looking({0, 0, 0}, {0, -0.5f, 0.001f}, 0.3f);
    for (const auto& [name, scene] : {std::pair{"spot", &spot}, {"bulb", &bulb}, {"window", &window}})
        EXPECT_TRUE(same_mean(wall(*scene, "photon-map,photons=50000,radius=0.1"), wall(*scene, "path"), sidak(significance, 3))) << name;
}

// Noise of the map alone: the direct light is the same.
TEST(PhotonMap, ErrorFallsWithTheNumberOfPhotons) {
    Scene room = glowing_room();
    room.view = looking({0, 0, 0.9f}, {0, 0, -1}, 0.3f);
    const RenderSettings settings = settings_for(8, 8, 4);
    const Frame exact = integrator_frame(room, settings, "photon-map,photons=3000000,radius=0.1");
    std::vector<double> photons, error;
    for (const int n : {1000, 4000, 16000, 64000}) {
        photons.push_back(n);
        error.push_back(rms_difference(integrator_frame(room, settings, "photon-map,radius=0.1,photons=" + std::to_string(n)), exact));
    }
    const PowerFit fitted = fit_power(photons, error);
    EXPECT_LT(fitted.slope.low, -0.5) << fitted.slope.value;
    EXPECT_GT(fitted.slope.high, -0.5) << fitted.slope.value;
    EXPECT_LT(fitted.slope.high, 0) << fitted.slope.value;
}

// The direct light of images with the same seed is the same, so differences are those of indirect light.
TEST(IrradianceCache, ErrorFallsWithTheReachOfItsRecords) {
    const Scene scene = shipped_scene("cornell");
    const RenderSettings settings = settings_for(32, 32, 32);
    const Frame exact = integrator_frame(scene, settings_for(32, 32, 32), "irradiance-cache,a=0");
    std::vector<double> reach, error;
    for (const double a : {0.25, 0.4, 0.63, 1.0}) {
        reach.push_back(a);
        error.push_back(rms_difference(integrator_frame(scene, settings, "irradiance-cache,rays=1024,a=" + std::to_string(a)), exact));
    }
    const PowerFit fitted = fit_power(reach, error);
    EXPECT_GT(fitted.slope.low, 0) << fitted.slope.value;
}

TEST(ComparisonIntegrators, AreCaughtAsBiased) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(64, 64, 4096);
    settings.seed = 1;
    const MeasuredImage reference = measured_image(*integrator_render(scene, settings, "path"));
    settings.seed = 0;
    settings.spp = 512;
    EXPECT_FALSE(test_bias(measured_image(*integrator_render(scene, settings, "path")), reference).biased);
    for (const char* text : {"ambient", "light-probes", "irradiance-cache", "photon-map"})
        EXPECT_TRUE(test_bias(measured_image(*integrator_render(scene, settings, text)), reference).biased) << text;
}

TEST(ComparisonIntegrators, DoNotDependOnThreads) {
    const Scene scene = shipped_scene("card-and-mug");
    const RenderSettings settings = settings_for(40, 30, 2);
    for (const char* text : {"ambient", "light-probes,grid=2", "irradiance-cache,rays=16", "photon-map,photons=10000",
                             "photon-map,photons=10000,gather=2", "progressive-photon-map,photons=10000"})
        EXPECT_EQ(integrator_frame(scene, settings, text, 1).rgba, integrator_frame(scene, settings, text, 2).rgba) << text;
}

TEST(ComparisonIntegrators, FollowTheLimitOfBounces) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(16, 16, 2);
    settings.max_bounces = 1;
    for (const char* text : {"ambient", "light-probes,grid=2", "irradiance-cache,rays=16", "photon-map,photons=10000"})
        EXPECT_EQ(integrator_frame(scene, settings, text).rgba, integrator_frame(scene, settings, "path").rgba) << text;
    // The same renderer after an edit of the limit alone.
    const auto renderer = integrator_render(scene, settings, "irradiance-cache,rays=16");
    settings.max_bounces = unlimited_bounces;
    EXPECT_TRUE(renderer->update(scene, settings));
    renderer->render(0, 2);
    EXPECT_EQ(renderer->resolve().rgba, integrator_frame(scene, settings, "irradiance-cache,rays=16").rgba);
}

// Nothing occludes a plane: it reflects its albedo times the ambient light, without noise.
TEST(AmbientLight, OnAPlaneIsAlbedoTimesColor) {
    Scene scene;
    place(scene, floor_quad(100), lambert(0.5f));
    scene.view = looking_down(1, 5);
    const Frame frame = integrator_frame(scene, settings_for(8, 8, 4), "ambient,color=2:1:0.5");
    for (size_t i = 0; i < frame.rgba.size(); i += 4) {
        EXPECT_FLOAT_EQ(frame.rgba[i], 1);
        EXPECT_FLOAT_EQ(frame.rgba[i + 1], 0.5f);
        EXPECT_FLOAT_EQ(frame.rgba[i + 2], 0.25f);
    }
}

// A ceiling of radius r at height h hides r^2 / (r^2 + h^2) of the cosine; here a large one within or beyond the distance.
TEST(AmbientLight, IsOccludedWithinItsDistance) {
    Scene scene;
    place(scene, floor_quad(1), lambert(1.f));
    place(scene, ceiling_quad(1e4f, 2), lambert(1.f));
    scene.view = looking({0, 1, 0}, {0, 0, 0.001f}, 0.5f);
    const RenderSettings settings = settings_for(16, 16, 64);
    // Rays reach the ceiling within 4 m if their cosine is at least 2 / 4: a share of 1 - 0.25 of the cosine distribution.
    const Measured dim = image_of(*integrator_render(scene, settings, "ambient,color=1:1:1,distance=4")).whole();
    EXPECT_TRUE(is_mean(dim, 0.25));
    EXPECT_FLOAT_EQ(float(image_of(*integrator_render(scene, settings, "ambient,color=1:1:1,distance=1.9")).whole().mean.x), 1);
}

// Integrals of products over the sphere, by the midpoint rule in cos(theta) and phi, which is exact for polynomials of this degree in phi.
TEST(LightProbes, HarmonicsAreOrthonormal) {
    constexpr int steps = 400;
    std::array<std::array<double, 9>, 9> products{};
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = 2 * (i + 0.5) / steps - 1, phi = 2 * std::numbers::pi * (j + 0.5) / steps, r = std::sqrt(1 - z * z);
            const auto y = spherical_harmonics({r * std::cos(phi), r * std::sin(phi), z});
            for (size_t a = 0; a < 9; ++a)
                for (size_t b = 0; b < 9; ++b) products[a][b] += y[a] * y[b] * 4 * std::numbers::pi / (steps * steps);
        }
    // Second-order error of the midpoint rule: f''(z) / 24 times the step squared times the length; f'' is at most 24 here.
    constexpr double bound = 2 * (2.0 / steps) * (2.0 / steps);
    for (size_t a = 0; a < 9; ++a)
        for (size_t b = 0; b < 9; ++b) EXPECT_NEAR(products[a][b], a == b, bound) << a << ' ' << b;
}

TEST(LightProbes, EvenRadianceGivesPiTimesIt) {
    LightProbe probe;
    probe.radiance[0] = Vec3d{1, 2, 3} / spherical_harmonics({0, 0, 1})[0];
    const Vec3d irradiance = probe.irradiance({0.6, 0, 0.8});
    EXPECT_NEAR(irradiance.x, std::numbers::pi, 1e-12);
    EXPECT_NEAR(irradiance.z, 3 * std::numbers::pi, 1e-12);
}

TEST(ComparisonIntegrators, AreReadAndWritten) {
    for (const char* text :
         {"path", "ambient,color=auto,distance=1", "ambient,color=0.1:0.2:0.3,distance=2.5", "irradiance-cache,a=0.1,rays=32",
          "light-probes,grid=3,rays=12", "photon-map,photons=1000,radius=auto,gather=0", "photon-map,photons=7,radius=0.25,gather=4",
          "progressive-photon-map,photons=7,radius=auto,alpha=0.5", "bidirectional", "metropolis,large=0.5,chain=100",
          "light-probes,grid=3,rays=12,baked", "irradiance-cache,a=0.1,rays=32,baked"})
        EXPECT_EQ(to_string(integrator(text)), text);
    for (const char* text : {"",
                             "photons",
                             "path,a=1",
                             "ambient,a=1",
                             "ambient,distance=0",
                             "ambient,distance=nan",
                             "ambient,color=1:2",
                             "ambient,color=1:2:-3",
                             "ambient,color=1:2:inf",
                             "irradiance-cache,a=2",
                             "irradiance-cache,rays=0",
                             "irradiance-cache,rays=2000",
                             "light-probes,grid=65",
                             "photon-map,photons=0",
                             "photon-map,radius=-1",
                             "photon-map,rays=4",
                             "photon-map,gather=-1",
                             "photon-map,alpha=0.5",
                             "progressive-photon-map,alpha=0",
                             "progressive-photon-map,gather=1",
                             "light-probes,grid",
                             "bidirectional,large=0.5",
                             "bidirectional,baked",
                             "ambient,baked",
                             "metropolis,large=0",
                             "metropolis,large=1.5",
                             "metropolis,chain=0",
                             "light-probes,"})
        EXPECT_FALSE(parse_integrator(text)) << text;
}

} // namespace
} // namespace blush::test::TEST_FILE
