// The translational gradient of irradiance against the closed form of a disk light.
#include "core/sampler.h"
#include "core/sampling.h"
#include "measure/statistics/intervals.h"
#include "render/comparison/irradiance_cache.h"
#include "render/comparison/irradiance_gradient.h"
#include "scene/affine.h"
#include "tests/render/rendered_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr double nearest = 1e-6;

// A disk of radius 1 that emits 1 nit, at height 1 above a receiver that faces it, `offset` from its axis along `across`.
struct DiskLight {
    Vec3 normal, across;
    double offset = 0.5;

    // Howell, "A catalog of radiation heat transfer configuration factors", B-13.
    static double irradiance(double offset) {
        const double h = 1 / offset, r = 1 / offset, z = 1 + h * h + r * r;
        return std::numbers::pi * 0.5 * (1 - (z - 2 * r * r) / std::sqrt(z * z - 4 * r * r));
    }
    static double gradient(double offset) { return (irradiance(offset + 1e-4) - irradiance(offset - 1e-4)) / 2e-4; }

    GatheredRays rays(int count, uint32_t key) const {
        const Basis<float> basis = basis_around(normal);
        GatheredRays rays;
        for (int i = 0; i < count; ++i) {
            const Pair<float> u = Sampler<float>{key, uint32_t(i)}.pair(0);
            const Vec3 d = basis.to_world(sample_cosine_hemisphere(u.x(), u.y()));
            const double up = dot(to_double(d), to_double(normal)), t = 1 / up;
            const Vec3d at = to_double(across) * offset + to_double(d) * t - to_double(normal);
            const bool hit = length_squared(at) < 1;
            rays.direction.push_back(d);
            rays.radiance.push_back(hit ? Vec3d{1, 2, 0} : Vec3d{0, 0, 0});
            rays.distance.push_back(hit ? float(t) : std::numeric_limits<float>::infinity());
        }
        return rays;
    }
};

DiskLight tilted() {
    const Vec3 normal = normalize(Vec3{0.3f, -0.5f, 0.8f});
    return {normal, basis_around(normal).to_world(normalize(Vec3{0.6f, 0.8f, 0}))};
}

// Root mean square over independent sets of rays.
double rms_error(const DiskLight& light, int count) {
    constexpr int sets = 64;
    double sum = 0;
    for (uint32_t set = 0; set < sets; ++set) {
        const auto gradient = translational_gradient(light.rays(count, pcg_hash(set)), light.normal, nearest);
        sum += length_squared(gradient[0] - to_double(light.across) * DiskLight::gradient(light.offset));
    }
    return std::sqrt(sum / sets);
}

TEST(IrradianceGradient, ConvergesToTheClosedForm) {
    const DiskLight light = tilted();
    std::vector<double> count, error;
    for (const int n : {64, 256, 1024, 4096}) {
        count.push_back(n);
        error.push_back(rms_error(light, n));
    }
    const PowerFit fitted = fit_power(count, error);
    EXPECT_LT(fitted.slope.high, -0.5) << fitted.slope.value << ": strata converge faster than random directions";
    EXPECT_LT(error.back(), 0.01 * std::abs(DiskLight::gradient(light.offset)));
}

TEST(IrradianceGradient, IsThatOfEachChannel) {
    const DiskLight light = tilted();
    const auto gradient = translational_gradient(light.rays(256, 1), light.normal, nearest);
    EXPECT_EQ(gradient[1], gradient[0] * 2.0);
    EXPECT_EQ(gradient[2], (Vec3d{0, 0, 0}));
}

// On the axis of the disk the irradiance is at its maximum.
TEST(IrradianceGradient, VanishesAtAMaximum) {
    DiskLight light = tilted();
    light.offset = 0;
    BlockMoments moments;
    for (uint32_t set = 0; set < 64; ++set) {
        const Measured gradient{translational_gradient(light.rays(256, pcg_hash(set)), light.normal, nearest)[0]};
        moments.add({&gradient, 1});
    }
    EXPECT_TRUE(is_mean(moments.measured()[0], 0));
}

// A step in radiance without a surface is at infinity: a move does not turn it.
TEST(IrradianceGradient, OfTheEnvironmentIsZero) {
    const DiskLight light = tilted();
    GatheredRays rays = light.rays(256, 1);
    rays.distance.assign(rays.distance.size(), std::numeric_limits<float>::infinity());
    for (const Vec3d& g : translational_gradient(rays, light.normal, nearest)) EXPECT_EQ(g, (Vec3d{0, 0, 0}));
}

TEST(IrradianceGradient, OfFewRaysIsFinite) {
    const DiskLight light = tilted();
    for (const int n : {0, 1, 2, 3, 5})
        for (const Vec3d& g : translational_gradient(light.rays(n, 1), light.normal, nearest)) EXPECT_TRUE(std::isfinite(length(g))) << n;
}

// A surface at distance 0 counts as `nearest`.
TEST(IrradianceGradient, OfTouchingSurfacesIsFinite) {
    const DiskLight light = tilted();
    GatheredRays rays = light.rays(256, 1);
    for (float& d : rays.distance) d = std::isinf(d) ? d : 0;
    EXPECT_TRUE(std::isfinite(length(translational_gradient(rays, light.normal, nearest)[0])));
}

// The largest error along a move of a tenth of the light's distance: of first order without a gradient, of second order with it.
TEST(IrradianceGradient, MakesRecordsRightNearby) {
    const DiskLight light = tilted();
    const GatheredRays rays = light.rays(256, 1);
    const Vec3d up = to_double(light.normal), across = to_double(light.across);
    IrradianceRecord record{.position = across * light.offset, .normal = up};
    record.flux[0] = up * DiskLight::irradiance(light.offset);
    const auto error = [&](double move) {
        return std::abs(record.irradiance(record.position + across * move, up).x - DiskLight::irradiance(light.offset + move));
    };
    const double without = std::max(error(-0.1), error(0.1));
    record.gradient = translational_gradient(rays, light.normal, nearest);
    EXPECT_LT(std::max(error(-0.1), error(0.1)), 0.25 * without);
    EXPECT_EQ(record.irradiance(record.position + across * 1e3, up).x, 0) << "never negative";
}

} // namespace
} // namespace blush::test::TEST_FILE
