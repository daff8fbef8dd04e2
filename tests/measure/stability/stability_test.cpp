// The stability battery, group by group; its sensitivity to wrong answers; and the validity of its list of limits.
#include "measure/stability/battery.h"
#include "measure/stability/groups.h"
#include "measure/stability/weak_points.h"
#include "measure/statistics/intervals.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>

namespace blush::stability::TEST_FILE {
namespace {

// ---- the verdict

TEST(Verdict, QuantilesAreThoseOfTheNormalDistribution) {
    EXPECT_NEAR(normal_quantile_two_sided(0.05), 1.959963985, 1e-8);
    EXPECT_NEAR(normal_quantile_two_sided(0.01), 2.575829304, 1e-8);
    EXPECT_NEAR(normal_quantile_two_sided(1e-6), 4.891638475, 1e-7);
    EXPECT_NEAR(sidak(0.01, 1), 0.01, 1e-15);
    EXPECT_NEAR(1 - std::pow(1 - sidak(0.01, 200), 200), 0.01, 1e-12);
}

TEST(Verdict, HoldsWithinRoundingAndStandardErrors) {
    EXPECT_TRUE(holds({1, 1, 0, 0, {}}, 4));
    EXPECT_TRUE(holds({1, 1 + 1e-6, 0, 0, {}}, 4)) << "single precision";
    EXPECT_FALSE(holds({1, 1.001, 0, 0, {}}, 4));
    EXPECT_TRUE(holds({1, 1.001, 0, 0.001, {}}, 4));
    EXPECT_TRUE(holds({1, 1.39, 0.1, 0, {}}, 4));
    EXPECT_FALSE(holds({1, 1.41, 0.1, 0, {}}, 4));
    EXPECT_FALSE(holds({1, 0.59, 0.1, 0, {}}, 4));
    EXPECT_FALSE(holds({0, 1e-30, 0, 0, {}}, 4)) << "an exact 0 has no tolerance";
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(holds({1, bad, 0.1, 0, {}}, 4));
        EXPECT_FALSE(holds({1, 1.1, bad, 0, {}}, 4));
    }
}

TEST(Verdict, OfSeveralFindingsTheWorstDecides) {
    const Findings findings{{1, 1, 0.1, 0, "a"}, {1, 1.2, 0.1, 0, "b"}, {1, 0.5, 0.1, 0, "c"}, {1, 1.1, 0.1, 0, "d"}};
    EXPECT_EQ(worst_of(findings, 4).where, "c");
    EXPECT_FALSE(holds(worst_of({}, 4), 4)) << "a case without measurements does not pass";
}

// A battery of correct cases fails at its stated rate: one in a hundred.
TEST(Verdict, FamiliesOfCorrectCasesHaveTheStatedFailureRate) {
    constexpr int families = 20000, cases = 50;
    const double k = normal_quantile_two_sided(sidak(family_wise_level, cases));
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    statistics::Moments failures;
    for (int i = 0; i < families; ++i) {
        bool all_hold = true;
        for (int j = 0; j < cases; ++j) all_hold &= holds({0, 0.3 * normal(random), 0.3, 0, {}}, k);
        failures.add(all_hold ? 0 : 1);
    }
    EXPECT_TRUE(statistics::z_test(failures, family_wise_level));
}

// ---- the runner

TEST(RunCase, DistinguishesRightFromWrong) {
    const auto answer = [](double expected) {
        return StabilityCase{"", 1, [expected] { return Findings{{expected, 2, 0.01, 0, {}}}; }, {}};
    };
    EXPECT_TRUE(run_case("", answer(2), 100).pass);
    EXPECT_TRUE(run_case("", answer(2.03), 100).pass);
    EXPECT_FALSE(run_case("", answer(2.1), 100).pass);
    EXPECT_GT(run_case("", answer(2), 1000).tolerance, run_case("", answer(2), 10).tolerance) << "more cases, more chances to fail";
}

TEST(RunCase, AnExceptionIsAFailureWithItsMessage) {
    const StabilityCase c{"", 1, []() -> Findings { throw std::runtime_error("out of glass"); }, {}};
    const CaseResult r = run_case("", c, 100);
    EXPECT_FALSE(r.pass);
    EXPECT_EQ(r.error, "out of glass");
}

// ---- the cases

TEST(Battery, ListIsConsistent) {
    std::set<std::string> groups;
    int cases = 0;
    for (const StabilityGroup& group : battery()) {
        EXPECT_TRUE(groups.insert(group.name).second) << group.name;
        std::set<std::string> names;
        for (const StabilityCase& c : group.cases) {
            EXPECT_TRUE(names.insert(c.name).second) << group.name << ": " << c.name;
            EXPECT_FALSE(weak_point(c.weak_point).name.empty()) << group.name << ": " << c.name;
            EXPECT_EQ(c.limit.empty(), group.name != "limits") << group.name << ": " << c.name;
            cases += c.limit.empty();
        }
    }
    EXPECT_GE(cases, 80);
}

// The relative error that noise may hide in the cases of each group, at most and in the median case: measured, rounded up to two digits.
// 0: exact up to rounding. docs/dev/testing.md has the same figures.
struct GroupNoise {
    const char* group;
    double max, median;
};
constexpr GroupNoise group_noise[] = {
    {"furnace", 0.065, 0.0031},     {"scale", 0.030, 0},           {"lights", 0.21, 0.0013}, {"worlds", 0.014, 0.0020},
    {"microfacet", 0.061, 0.00066}, {"dielectric", 0.18, 0.00054}, {"absorption", 0.070, 0}, {"mirrors", 0, 0},
    {"grazing", 0.00068, 0},        {"geometry", 0.014, 0},        {"camera", 0, 0},         {"film", 0.19, 0.0056},
    {"health", 0.013, 0},
};

class Battery : public testing::TestWithParam<std::string> {};

// One ctest entry for each group, and none for the limits.
TEST_P(Battery, Holds) {
    const auto allowed = std::ranges::find(group_noise, std::string_view(GetParam()), &GroupNoise::group);
    ASSERT_NE(allowed, std::end(group_noise)) << "no noise is stated for this group";
    const BatteryReport report = run_battery(GetParam(), 0);
    ASSERT_FALSE(report.cases.empty());
    EXPECT_TRUE(report.complete);
    std::vector<double> noise;
    for (const CaseResult& r : report.cases) {
        EXPECT_TRUE(r.pass) << r.name << " " << r.finding.where << ": " << r.finding.measured << " instead of " << r.finding.expected
                            << ", tolerance " << r.tolerance << " " << r.error;
        const double size = std::abs(r.finding.expected), hidden = r.tolerance - r.finding.rounding - float_rounding * size;
        noise.push_back(r.finding.sigma == 0 ? 0 : hidden / size);
        EXPECT_LE(noise.back(), allowed->max) << r.name << " " << r.finding.where;
    }
    std::ranges::sort(noise);
    // A limit that is far above the noise would let the noise grow unseen.
    EXPECT_GE(noise.back(), 0.8 * allowed->max) << "the group has become more precise: lower its limit";
    EXPECT_LE(noise[noise.size() / 2], allowed->median);
    EXPECT_GE(noise[noise.size() / 2], 0.8 * allowed->median) << "the group has become more precise: lower its median";
}

std::vector<std::string> group_names() {
    std::vector<std::string> names;
    for (const StabilityGroup& group : battery())
        if (group.name != "limits") names.push_back(group.name);
    return names;
}
INSTANTIATE_TEST_SUITE_P(Stability, Battery, testing::ValuesIn(group_names()), [](const auto& group) { return group.param; });

// The error of each known limit, as documented in docs/science/limits.md: a limit that grows is a regression. Those without noise count or
// measure exactly.
struct DocumentedLimit {
    const char* name;
    double measured;
    // Where the rounding of Embree's traversal decides: the value with its code for AVX2, the first one being that for AVX-512. All
    // kernels of Blush give the same.
    std::optional<double> measured_on_avx2 = {};
};
constexpr DocumentedLimit documented_limits[] = {
    {"white smooth dielectric in a furnace, seen at 75 degrees", 1.2027},
    {"closed room of rho 0.9999 without roulette: all bounces", 19995.80078125},
    {"rough glass of ior 1.001 in a furnace", 0.98426},
    {"ball of glass within a block of the same glass", 0.5437},
    {"absorbing sheet 1e-7 as thick as wide", 1},
    {"coarse ball with shading normals, half lit", 0.105716},
    {"two coincident lights", 0.4390},
    {"dark room at the edge of a wide world", 0.023614707467132234, 0.023566923148172866},
    {"closed ball of radius 1e-10 m", 1024},
    {"closed ball of radius 1e12 m", 517, 519},
    {"camera 0.3 m beside the metres at 1e7 m", 0.6501},
    {"parallel sun reflected within a plate onto a floor that a mirror shows", 0.011788},
    {"back of a surface that is not double-sided", 0},
};

// Known limits must fail, or they are no limits any more; and they must not fail worse than documented.
TEST(KnownLimits, AreAsDocumented) {
    const BatteryReport report = run_battery("limits", 0);
    EXPECT_EQ(report.passed + report.failed, 0) << "limits are not counted";
    EXPECT_GE(report.limits.size(), std::size(documented_limits));
    for (const CaseResult& r : report.limits) {
        EXPECT_FALSE(r.pass) << r.name << " holds: move it to the battery";
        EXPECT_TRUE(r.error.empty()) << r.name << ": " << r.error;
        const auto documented = std::ranges::find(documented_limits, std::string_view(r.name), &DocumentedLimit::name);
        ASSERT_NE(documented, std::end(documented_limits)) << r.name << " is not documented";
        const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
        const double measured = avx512 ? documented->measured : documented->measured_on_avx2.value_or(documented->measured);
        // Five standard errors of the measurement, and the last digit that is documented.
        EXPECT_NEAR(r.finding.measured, measured, 5 * r.finding.sigma + 1e-4 * std::abs(measured)) << r.name;
    }
}

// Albedo of appendix B's layering of a smooth reflection over white in a uniform environment, by quadrature: the mirror's share
// F(v.n), and for the base the integral of (1 - F(v.h)) cos / pi, F being Schlick's with 0.04 at normal incidence.
double layered_albedo(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto reflectance = [](double c) { return 0.04 + 0.96 * std::pow(1 - c, 5); };
    const double vx = std::sin(angle), vz = std::cos(angle);
    constexpr int n = 1000;
    double base = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            // Cosine-weighted directions by the square's midpoints.
            const double r = std::sqrt((i + 0.5) / n), phi = 2 * std::numbers::pi * (j + 0.5) / n;
            const double x = r * std::cos(phi), y = r * std::sin(phi), z = std::sqrt(1 - r * r);
            const double hx = vx + x, hy = y, hz = vz + z;
            base += 1 - reflectance((vx * hx + vz * hz) / std::sqrt(hx * hx + hy * hy + hz * hz));
        }
    return reflectance(vz) + base / (double(n) * n);
}

TEST(KnownLimits, TheGainAtGrazingAnglesIsThatOfTheSpecification) {
    for (const StabilityCase& c : limit_cases()) {
        if (c.name != grazing_gain_case) continue;
        const Finding finding = run_case("limits", c, 1).finding;
        const double expected = layered_albedo(75);
        EXPECT_NEAR(expected, 1.20, 0.005) << "the figure in docs/science/limits.md";
        EXPECT_GT(finding.sigma, 0);
        EXPECT_LT(finding.sigma, 0.01);
        EXPECT_NEAR(finding.measured, expected, normal_quantile_two_sided(statistics::significance) * finding.sigma + 1e-4);
        return;
    }
    FAIL() << "the case is missing";
}

TEST(RunBattery, StopsWhenAsked) {
    const BatteryReport report = run_battery("mirrors", 1, [](int finished, int, const std::string&) { return finished < 2; });
    EXPECT_EQ(report.passed, 2);
    EXPECT_FALSE(report.complete);
}

} // namespace
} // namespace blush::stability::TEST_FILE
