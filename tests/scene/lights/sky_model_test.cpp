// The sky is the published model's: zenith and horizontal illuminance by independent quadrature; the sun position matches the
// almanac.
#include "core/math.h"
#include "scene/lights/sky_model.h"
#include "scene/lights/sun_position.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

constexpr double degree = std::numbers::pi / 180;

Sky sky_of(float turbidity, float elevation, float azimuth = 0) {
    Sky sky;
    sky.turbidity = turbidity;
    sky.elevation_degrees = elevation;
    sky.azimuth_degrees = azimuth;
    return sky;
}
double luminance_of(const Vec3d& c) { return 0.2126729 * c.x + 0.7151522 * c.y + 0.0721750 * c.z; }

// Almanac: Meeus, example 25.a has the sun's declination at -7.78507 degrees and its right ascension at 198.38083 on 1992 October 13, 0 h;
// the Solar Position Algorithm of NREL (Reda and Andreas 2004), appendix, gives 39.87205 degrees without refraction and 194.34024 in
// Golden, Colorado on 2003 October 17, 19:30:30 UTC.
TEST(SunPosition, IsTheAlmanacs) {
    EXPECT_NEAR(sun_position(90, 0, 1992, 10, 13, 0).elevation, -7.785, 0.01) << "at the pole the elevation is the declination";
    const SunPosition golden = sun_position(39.742476, -105.1786, 2003, 10, 17, 19 + 30.0 / 60 + 30.0 / 3600);
    EXPECT_NEAR(golden.elevation, 39.872, 0.01);
    EXPECT_NEAR(golden.azimuth, 194.340, 0.01);
    // Solstices: within a day of them the declination is 23.44 degrees, north or south.
    EXPECT_NEAR(sun_position(90, 0, 2026, 6, 21, 8).elevation, 23.44, 0.01);
    EXPECT_NEAR(sun_position(-90, 0, 2026, 12, 21, 21).elevation, 23.43, 0.02);
    EXPECT_LT(std::abs(sun_position(90, 0, 2026, 3, 20, 14 + 46.0 / 60).elevation), 0.01) << "the equinox of 2026";
}

TEST(SunPosition, GoesFromEastThroughSouthToWest) {
    EXPECT_LT(sun_position(52, 5, 2026, 6, 21, 8).azimuth, 135);
    EXPECT_NEAR(sun_position(52, 5, 2026, 6, 21, 11.7).azimuth, 180, 3) << "solar noon at 5 degrees east";
    EXPECT_GT(sun_position(52, 5, 2026, 6, 21, 16).azimuth, 225);
    const Vec3d east = direction_of({0, 90}), north = direction_of({0, 0});
    EXPECT_NEAR(east.x, 1, 1e-12);
    EXPECT_NEAR(north.z, -1, 1e-12);
}

// The formulas of the paper's appendix A.2, written out once more.
TEST(SkyModel, ZenithIsTheModels) {
    for (const float turbidity : {2.f, 3.f, 6.f, 9.f})
        for (const float elevation : {5.f, 30.f, 60.f, 85.f}) {
            const double t = double(turbidity), theta = (90 - double(elevation)) * degree;
            const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * theta);
            const double kilocandela = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
            const SkyModel::Yxy zenith = SkyModel(sky_of(turbidity, elevation)).sky({0, 1, 0});
            EXPECT_NEAR(zenith.luminance / (1000 * kilocandela), 1, 1e-9) << turbidity << ", " << elevation;
            const double th[4] = {theta * theta * theta, theta * theta, theta, 1}, tt[3] = {t * t, t, 1};
            const double mx[3][4] = {
                {0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}};
            const double my[3][4] = {
                {0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}};
            double x = 0, y = 0;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 4; ++j) x += tt[i] * mx[i][j] * th[j], y += tt[i] * my[i][j] * th[j];
            EXPECT_NEAR(zenith.x, x, 1e-9);
            EXPECT_NEAR(zenith.y, y, 1e-9);
        }
}

// Perez's ratio between two directions: the same sun height, the formula itself.
TEST(SkyModel, DirectionsFollowPerez) {
    const double t = 3, theta = 50 * degree;
    const SkyModel model(sky_of(3, 40, 90));
    const auto perez = [&](double cosine, double gamma) {
        const double a = 0.1787 * t - 1.4630, b = -0.3554 * t + 0.4275, c = -0.0227 * t + 5.3251, d = 0.1206 * t - 2.5771,
                     e = -0.0670 * t + 0.3703;
        return (1 + a * std::exp(b / cosine)) * (1 + c * std::exp(d * gamma) + e * std::cos(gamma) * std::cos(gamma));
    };
    const double at_zenith = model.sky({0, 1, 0}).luminance;
    for (const double height : {10.0, 40.0, 70.0})
        for (const double azimuth : {0.0, 90.0, 200.0}) {
            const Vec3d d = direction_of({height, azimuth});
            const double gamma = std::acos(std::clamp(dot(d, direction_of({40, 90})), -1.0, 1.0));
            EXPECT_NEAR(model.sky(d).luminance / at_zenith, perez(d.y, gamma) / perez(1, theta), 1e-9) << height << ", " << azimuth;
        }
}

// Illuminance of the ground, by quadrature in angles rather than the model's own in areas; and of the baked map by its texels.
TEST(SkyModel, HorizontalIlluminanceIsTheIntegral) {
    for (const float elevation : {10.f, 45.f, 80.f}) {
        const Sky sky = sky_of(3, elevation, 120);
        const SkyModel model(sky);
        Vec3d sum{0, 0, 0};
        constexpr int rings = 400, sectors = 400;
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < sectors; ++j) {
                const double theta = std::numbers::pi / 2 * (i + 0.5) / rings, turn = 2 * std::numbers::pi * (j + 0.5) / sectors;
                const Vec3d d{std::sin(theta) * std::sin(turn), std::cos(theta), std::sin(theta) * std::cos(turn)};
                sum = sum + model.radiance(d) *
                                (std::sin(theta) * std::cos(theta) * std::numbers::pi / 2 / rings * 2 * std::numbers::pi / sectors);
            }
        EXPECT_NEAR(luminance_of(model.sky_illuminance()) / luminance_of(sum), 1, 1e-3) << elevation;
        EXPECT_NEAR(model.sky_illuminance().x / sum.x, 1, 2e-3);
        EXPECT_NEAR(model.sky_illuminance().z / sum.z, 1, 2e-3);

        const ImagePtr image = sky_image(sky, 256, 128);
        double baked = 0;
        for (int row = 0; row < 64; ++row)
            for (int column = 0; column < 256; ++column) {
                const double top = std::numbers::pi * row / 128, bottom = std::numbers::pi * (row + 1) / 128;
                const float* c = &image->floats[3 * size_t(row * 256 + column)];
                const double projected =
                    (std::sin(bottom) * std::sin(bottom) - std::sin(top) * std::sin(top)) / 2 * 2 * std::numbers::pi / 256;
                baked += luminance_of({c[0], c[1], c[2]}) * projected;
            }
        EXPECT_NEAR(baked / luminance_of(sum), 1, 2e-3);
    }
}

// Ordinary clear days: typical measured illuminance, within the variation of the weather.
TEST(SkyModel, IsAsBrightAsDaylight) {
    const SkyModel noon(sky_of(2.5f, 60));
    EXPECT_GT(luminance_of(noon.sun_illuminance()), 80e3);
    EXPECT_LT(luminance_of(noon.sun_illuminance()), 115e3);
    EXPECT_GT(luminance_of(noon.sky_illuminance()), 8e3);
    EXPECT_LT(luminance_of(noon.sky_illuminance()), 30e3);
    const Vec3d high = noon.sun_illuminance(), low = SkyModel(sky_of(2.5f, 3)).sun_illuminance();
    EXPECT_LT(luminance_of(low), 0.2 * luminance_of(high));
    EXPECT_LT(low.z / low.x, 0.4 * high.z / high.x) << "red at sunset";
    EXPECT_GT(noon.radiance({0, 1, 0}).z, noon.radiance({0, 1, 0}).x) << "blue above";
}

TEST(SkyModel, GroundIsDiffuseAndNightIsBlack) {
    Sky sky = sky_of(3, 40);
    const SkyModel day(sky);
    const Vec3d lux = day.sky_illuminance() + day.sun_illuminance() * day.sun_direction().y;
    EXPECT_NEAR(day.radiance({0, -1, 0}).y, 0.3 / std::numbers::pi * lux.y, 1e-3 * lux.y);
    EXPECT_EQ(day.radiance({0, -1, 0}), day.radiance({0.6, -0.8, 0}));
    sky.sun_disk = false;
    EXPECT_EQ(SkyModel(sky).sun_illuminance(), (Vec3d{0, 0, 0}));
    EXPECT_EQ(luminance_of(SkyModel(sky_of(3, -7)).radiance({0, 1, 0})), 0);
    EXPECT_EQ(SkyModel(sky_of(3, -1)).sun_illuminance(), (Vec3d{0, 0, 0}));
    EXPECT_GT(luminance_of(SkyModel(sky_of(3, -3)).radiance({0, 1, 0})), 0);
    EXPECT_NEAR(SkyModel(sky_of(3, -3)).sky({0, 1, 0}).luminance / SkyModel(sky_of(3, 0)).sky({0, 1, 0}).luminance, 0.5, 1e-6);
}

TEST(SkySun, TurnsAndScalesWithTheEnvironment) {
    Environment e;
    e.kind = Environment::Kind::sky;
    e.sky = sky_of(3, 0.0001f, 0); // due north, -Z
    e.rotation_degrees = 90;
    EXPECT_NEAR(sun_of(e).direction.x, -1, 1e-5) << "counter-clockwise seen from above";
    e.sky = sky_of(3, 40);
    const Vec3 once = sun_of(e).lux;
    e.intensity = 2;
    e.color = {1, 0.5f, 1};
    EXPECT_NEAR(sun_of(e).lux.x / once.x, 2, 1e-5);
    EXPECT_NEAR(sun_of(e).lux.y / once.y, 1, 1e-5);
    e.lights_scene = false;
    EXPECT_EQ(sun_of(e).lux, (Vec3{0, 0, 0}));
}

} // namespace
} // namespace blush::TEST_FILE
