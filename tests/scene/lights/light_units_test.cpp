// Units of light: known values, and conversions that do not change the light.
#include "scene/lights/ies_profile.h"
#include "scene/lights/light_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

constexpr double pi = std::numbers::pi;
using Kind = Light::Kind;
using Unit = Light::Unit;
constexpr Kind kinds[] = {Kind::point, Kind::spot, Kind::sun, Kind::rectangle, Kind::disk, Kind::sphere};
constexpr Unit units[] = {Unit::own, Unit::watt, Unit::lumen, Unit::candela, Unit::lux, Unit::nits, Unit::ev};

Light light_of(Kind kind, float intensity = 2) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    light.radius = 0.3f;
    light.angle_radians = 0.01f;
    light.width = 2;
    light.height = 3;
    return light;
}

TEST(LightUnits, KnownValues) {
    const Light point = light_of(Kind::point);
    EXPECT_NEAR(in_unit(point, Unit::lumen), 8 * pi, 1e-9);
    EXPECT_NEAR(in_unit(point, Unit::watt), 8 * pi / 683, 1e-9);
    EXPECT_NEAR(in_unit(point, Unit::lux), 2, 1e-9) << "a metre away";
    EXPECT_NEAR(in_unit(light_of(Kind::sun, 81920), Unit::ev), 15, 1e-9) << "2.5 lx * 2^15: the sun at noon";
    EXPECT_NEAR(in_unit(light_of(Kind::rectangle, 4096), Unit::ev), 15, 1e-9) << "2^15 / 8 nits";

    Light panel = light_of(Kind::rectangle);
    EXPECT_NEAR(in_unit(panel, Unit::lumen), 2 * pi * 6, 1e-9);
    EXPECT_NEAR(in_unit(panel, Unit::candela), 12, 1e-9);
    EXPECT_NEAR(in_unit(panel, Unit::lumen, 4), 2 * pi * 24, 1e-9) << "twice as wide and high by its node";
    panel.two_sided = true;
    EXPECT_NEAR(in_unit(panel, Unit::lumen), 4 * pi * 6, 1e-9);
    EXPECT_NEAR(in_unit(light_of(Kind::sphere), Unit::lumen), 8 * pi * pi * 0.09, 1e-6);
    EXPECT_NEAR(in_unit(light_of(Kind::disk), Unit::candela), 2 * pi * 0.09, 1e-6);
    const double sine = std::sin(0.005);
    EXPECT_NEAR(in_unit(light_of(Kind::sun), Unit::nits) / (2 / (pi * sine * sine)), 1, 1e-6);
}

// The flux of a spot is the integral of its falloff, not an upper bound.
TEST(LightUnits, ASpotsFluxIsThatOfItsFalloff) {
    for (const auto& [inner, outer] : {std::pair{0.f, 0.7f}, {0.3f, 0.5f}, {0.5f, 0.5f}, {0.f, float(pi / 2)}, {0.2f, 0.21f}}) {
        Light spot = light_of(Kind::spot, 1);
        spot.inner_cone_radians = inner;
        spot.outer_cone_radians = outer;
        const double ci = std::cos(double(inner)), co = std::cos(double(outer));
        double flux = 0;
        constexpr int n = 1'000'000;
        for (int i = 0; i < n; ++i) {
            const double c = (i + 0.5) / n, f = std::clamp((c - co) / std::max(0.001, ci - co), 0.0, 1.0);
            flux += 2 * pi * f * f / n;
        }
        EXPECT_NEAR(in_unit(spot, Unit::lumen) / flux, 1, 1e-4) << inner << " to " << outer;
    }
}

TEST(LightUnits, SpreadKeepsTheFluxAndRaisesTheCandela) {
    Light panel = light_of(Kind::disk);
    const double flux = in_unit(panel, Unit::lumen), candela = in_unit(panel, Unit::candela);
    panel.spread_radians = 1;
    EXPECT_NEAR(in_unit(panel, Unit::lumen), flux, 1e-9);
    EXPECT_NEAR(in_unit(panel, Unit::candela) / candela, std::tan(0.5) / (std::tan(0.5) - 0.5), 1e-9);
}

TEST(LightUnits, AnIesProfileHasItsOwnFlux) {
    IesProfile half;
    half.vertical = {0, 90};
    half.horizontal = {0};
    half.candela = {50, 50};
    half.peak = 50;
    for (const Kind kind : {Kind::point, Kind::spot}) {
        Light light = light_of(kind, 3);
        light.inner_cone_radians = light.outer_cone_radians = 0.7f;
        const double bare = in_unit(light, Unit::lumen);
        light.ies = std::make_shared<const IesProfile>(half);
        EXPECT_NEAR(in_unit(light, Unit::lumen) / bare, kind == Kind::point ? 0.5 : 1, 1e-3) << "the upper half is dark";
    }
}

TEST(LightUnits, RoundTrip) {
    for (const Kind kind : kinds)
        for (const Unit unit : units) {
            const Light light = light_of(kind, 0.37f);
            if (!has_unit(light, unit)) continue;
            EXPECT_NEAR(intensity_of(light, unit, in_unit(light, unit, 2.5), 2.5) / 0.37f, 1, 1e-5) << int(kind) << " in " << int(unit);
        }
    for (const Kind kind : kinds) EXPECT_DOUBLE_EQ(in_unit(light_of(kind), own_unit(kind)), 2);
}

TEST(LightUnits, InvalidStrengthsAreZero) {
    EXPECT_FALSE(has_unit(light_of(Kind::sun), Unit::lumen));
    EXPECT_FALSE(has_unit(light_of(Kind::point), Unit::nits));
    EXPECT_EQ(intensity_of(light_of(Kind::sun), Unit::lumen, 5), 0);
    EXPECT_EQ(intensity_of(light_of(Kind::point), Unit::lumen, -5), 0);
    EXPECT_EQ(intensity_of(light_of(Kind::point), Unit::ev, 1e6), 0) << "not finite";
    EXPECT_EQ(in_unit(light_of(Kind::point, 0), Unit::ev), -INFINITY);
}

TEST(LightUnits, ResizingKeepsThePowerIfAsked) {
    Light before = light_of(Kind::disk);
    Light after = before;
    after.radius = 0.6f;
    EXPECT_EQ(with_same_power(before, after).intensity, 2);
    after.keep_power = true;
    EXPECT_NEAR(with_same_power(before, after).intensity, 0.5, 1e-6);
    EXPECT_NEAR(luminous_flux(with_same_power(before, after)) / luminous_flux(before), 1, 1e-6);
}

} // namespace
} // namespace blush::TEST_FILE
