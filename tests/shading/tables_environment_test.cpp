// Environment: lookup, importance sampling, and their consistency.
#include "core/math.h"
#include "core/rec709.h"
#include "render/lights/environment_table.h"
#include "tests/shading/tables.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr double exact_pi = std::numbers::pi;
constexpr float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

struct NamedMap {
    std::string name;
    Environment environment;
    EnvironmentSampling sampling = EnvironmentSampling::full;
};

Environment map_of(int width, int height, float rotation_degrees, const std::function<float()>& value) {
    Environment e;
    e.kind = Environment::Kind::image;
    e.image = make_float_image(width, height, 3, value);
    e.rotation_degrees = rotation_degrees;
    return e;
}

// `value` in all channels of one texel, `background` in all others.
Environment one_texel(int width, int height, int x, int y, float value, float background) {
    int next = 0;
    const int at = 3 * (y * width + x);
    return map_of(width, height, 100, [&] {
        const int i = next++;
        return i >= at && i < at + 3 ? value : background;
    });
}

std::vector<NamedMap> maps() {
    Random random(1);
    Environment constant;
    constant.kind = Environment::Kind::constant;
    constant.color = {1, 2, 3};
    return {{"random", map_of(16, 8, 30, [&] { return random.below(3) == 0 ? 0 : std::exp(random.between(-4, 4)); })},
            {"odd height", map_of(7, 5, -200, [&] { return random.unit(); })},
            {"sun", one_texel(16, 8, 5, 2, 1e6f, 1)},
            {"only one texel", one_texel(16, 8, 9, 4, 1, 0)},
            {"only one texel, top", one_texel(16, 8, 9, 0, 1, 0)},
            {"only one texel, bottom", one_texel(16, 8, 9, 7, 1, 0)},
            {"only one texel, left", one_texel(16, 8, 0, 3, 1, 0)},
            {"only one texel, right", one_texel(16, 8, 15, 3, 1, 0)},
            {"1 x 1", map_of(1, 1, 10, [] { return 5.f; })},
            {"2 x 1", map_of(2, 1, 10, [&] { return random.unit(); })},
            {"1 x 2", map_of(1, 2, 10, [&] { return random.unit(); })},
            {"black", map_of(4, 2, 0, [] { return 0.f; })},
            {"constant", constant}};
}

// With each way of sampling that has a density.
std::vector<NamedMap> sampled_maps() {
    std::vector<NamedMap> all = maps();
    for (NamedMap map : maps())
        for (const EnvironmentSampling sampling : {EnvironmentSampling::compensated, EnvironmentSampling::compensated_alone}) {
            map.sampling = sampling;
            if (build_environment_table(map.environment, sampling).sampled_share > 0) all.push_back(map);
        }
    return all;
}

// ---- a double-precision model of the map and its cells

struct MapPoint {
    double x, y; // in cells: cell c spans [c, c + 1); columns wrap
};

class Model {
public:
    const int width, height;

    explicit Model(const EnvironmentTable& table) : width(table.width), height(table.height), table_(table) {}

    MapPoint locate(const Vec3d& d) const {
        const double u = std::atan2(d.x, -d.z) / (2 * exact_pi) + 0.5 + table_.rotation;
        const double v = std::atan2(std::hypot(d.x, d.z), d.y) / exact_pi;
        return {(u - std::floor(u)) * width + 0.5, v * height + 0.5};
    }
    double radiance(const Vec3d& d, int channel) const {
        const MapPoint p = locate(d);
        const int column = int(p.x), row = int(p.y);
        const double fx = p.x - column, fy = p.y - row;
        const auto texel = [&](int x, int y) {
            const int wrapped = (x + width) % width, clamped = std::clamp(y, 0, height - 1);
            return double(table_.texel_data()[3 * size_t(clamped * width + wrapped) + size_t(channel)]);
        };
        const auto mixed = [&](int y) { return (1 - fx) * texel(column - 1, y) + fx * texel(column, y); };
        const double scale[3] = {table_.scale.x, table_.scale.y, table_.scale.z};
        return scale[channel] * ((1 - fy) * mixed(row - 1) + fy * mixed(row));
    }
    double row_border(int row) const { return row == 0 ? 0 : row == height + 1 ? exact_pi : exact_pi * (row - 0.5) / height; }
    // Point (s, t) of the unit square is row s * (height + 1), column t * width of the cells, uniform in solid angle in each.
    statistics::Chart::Point point(double s, double t) const {
        const double at = s * (height + 1);
        const int row = std::min(int(at), height);
        const double begin = std::cos(row_border(row)), end = std::cos(row_border(row + 1));
        const double y = begin + (end - begin) * (at - row), r = std::sqrt(std::max(0.0, 1 - y * y));
        const double phi = 2 * exact_pi * (t - 0.5 / width - 0.5 - table_.rotation);
        return {{r * std::sin(phi), y, -r * std::cos(phi)}, (height + 1) * (begin - end) * 2 * exact_pi};
    }
    statistics::Chart chart() const {
        return {[*this](double s, double t) { return std::optional(point(s, t)); },
                [*this](const Vec3d& d) {
                    const MapPoint p = locate(d);
                    const int row = std::min(int(p.y), height);
                    const double begin = std::cos(row_border(row)), end = std::cos(row_border(row + 1));
                    const double within = std::clamp((begin - d.y) / (begin - end), 0.0, 1.0);
                    return std::optional(std::array{(row + within) / (height + 1), std::fmod(p.x, width) / width});
                }};
    }
    // Integral over the sphere of fn(direction), by the midpoint rule on a grid in every cell.
    template <class Fn> double integrate(Fn fn, int points) const {
        const int rows = (height + 1) * points, columns = width * points;
        double sum = 0;
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; j < columns; ++j) {
                const statistics::Chart::Point p = point((i + 0.5) / rows, (j + 0.5) / columns);
                sum += p.solid_angle * fn(p.direction);
            }
        }
        return sum / (double(rows) * columns);
    }

    // Rounding may move a direction by this much, in columns and rows: an arc tangent (error 1e-7 turns) and its neighbours.
    double column_error() const { return 4e-7 * width; }
    double row_error() const { return 4e-7 * height; }
    // A texel further along, radiance differs by the brightest texel at most.
    double radiance_error() const {
        const std::span texels(table_.texel_data(), 3 * size_t(table_.width) * size_t(table_.height));
        const double brightest = *std::ranges::max_element(texels) * std::max({table_.scale.x, table_.scale.y, table_.scale.z});
        return brightest * (column_error() + row_error() + 16 * 0x1p-24);
    }

private:
    const EnvironmentTable& table_;
};

EnvironmentSample<float> draw(const EnvironmentTables& tables, Random& random) {
    const float u = random.unit();
    return sample_environment<float>(tables, u, random.bits());
}
Vec3d widened(const Vec3& d) { return {d.x, d.y, d.z}; }
Vec3 narrowed(const Vec3d& d) { return {float(d.x), float(d.y), float(d.z)}; }

} // namespace

TEST(EnvironmentLookup, LooksWhereTheConventionSays) {
    // 4 x 2: texel centres at -135, -45, 45, 135 degrees to the right of the centre, 45 degrees above and below the horizon.
    int next = 0;
    const EnvironmentTable table = build_environment_table(map_of(4, 2, 0, [&] { return float(next++ / 3); }));
    const auto seen = [&](Vec3 d) { return environment_radiance<float>(table.tables(), d, true).x; };
    const float r = std::sqrt(0.5f);
    const double error = Model(table).radiance_error();
    EXPECT_NEAR(seen({0.5f, r, -0.5f}), 2, error);
    EXPECT_NEAR(seen({-0.5f, r, -0.5f}), 1, error);
    EXPECT_NEAR(seen({-0.5f, -r, 0.5f}), 4, error);
    EXPECT_NEAR(seen({0, 0, -1}), 3.5, error); // the centre of the map
}

TEST(EnvironmentLookup, RotatesCounterClockwiseSeenFromAbove) {
    Random random(2);
    Environment e = map_of(16, 8, 0, [&] { return random.unit(); });
    const EnvironmentTable straight = build_environment_table(e);
    e.rotation_degrees = 90;
    const EnvironmentTable turned = build_environment_table(e);
    // +90 degrees about +Y takes -Z to -X and -X to +Z.
    const double error = 2 * Model(turned).radiance_error();
    for (int k = 0; k < 100; ++k) {
        const Vec3 d = random.direction(), rotated{d.z, d.y, -d.x};
        EXPECT_NEAR(environment_radiance<float>(turned.tables(), rotated, true).x,
                    environment_radiance<float>(straight.tables(), d, true).x, error);
    }
}

TEST(EnvironmentLookup, AgreesWithADoublePrecisionModel) {
    Random random(3);
    for (const NamedMap& map : maps()) {
        const EnvironmentTable table = build_environment_table(map.environment);
        const Model model(table);
        for (int k = 0; k < 2000; ++k) {
            const Vec3 d = random.direction();
            ASSERT_NEAR(environment_radiance<float>(table.tables(), d, true).y, model.radiance(widened(d), 1), model.radiance_error())
                << map.name;
        }
    }
}

TEST(EnvironmentLookup, ConstantIsConstant) {
    Environment e;
    e.kind = Environment::Kind::constant;
    e.color = {0.25f, 1, 3};
    e.intensity = 2;
    const EnvironmentTable table = build_environment_table(e);
    Random random(4);
    for (int k = 0; k < 1000; ++k) {
        const Vec3 d = random.direction();
        ASSERT_EQ(environment_radiance<float>(table.tables(), d, true), (Vec3{0.5f, 2, 6}));
        ASSERT_FLOAT_EQ(environment_pdf<float>(table.tables(), d), float(1 / (4 * exact_pi)));
    }
    EXPECT_NEAR(table.integral().z, 6 * 4 * exact_pi, 1e-9);
}

TEST(EnvironmentLookup, NoDirectionLeavesTheMap) {
    Random random(5);
    const EnvironmentTable table = build_environment_table(map_of(5, 3, 77, [&] { return random.unit(); }));
    const auto any_float = [&] {
        return random.below(4) == 0 ? nan : random.below(4) == 0 ? infinite : std::bit_cast<float>(random.bits());
    };
    for (int k = 0; k < 100000; ++k) {
        const Vec3 d{any_float(), any_float(), any_float()};
        const EnvironmentCell<float> cell = environment_cell<float>(table.tables(), d);
        ASSERT_TRUE(cell.column >= 0 && cell.column < 5 && cell.row >= 0 && cell.row <= 3) << d.x << ' ' << d.y << ' ' << d.z;
    }
    for (const Vec3 d : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{-0.f, 0, 1}, Vec3{0, 0, 0}}) {
        EXPECT_GT(environment_radiance<float>(table.tables(), d, true).x, 0);
        EXPECT_GT(environment_pdf<float>(table.tables(), d), 0);
    }
}

TEST(EnvironmentSampling, FollowsItsDensity) {
    Random random(6);
    const std::vector<NamedMap> all = sampled_maps();
    for (const NamedMap& map : all) {
        const EnvironmentTable table = build_environment_table(map.environment, map.sampling);
        const Model model(table);
        statistics::DirectionTest test;
        test.charts = {model.chart()};
        test.rows = 3 * (table.height + 1); // thirds of cells: the density is uniform within them
        test.columns = 3 * table.width;
        test.points = 1;
        test.alpha = statistics::sidak(statistics::significance, int64_t(all.size()));
        EXPECT_TRUE(statistics::directions_follow(
            test, [&] { return std::optional(draw(table.tables(), random).direction); },
            [&](const Vec3& d) { return environment_pdf<float>(table.tables(), d); }))
            << map.name;
    }
}

TEST(EnvironmentSampling, DensityIntegratesToOne) {
    for (const NamedMap& map : sampled_maps()) {
        const EnvironmentTable table = build_environment_table(map.environment, map.sampling);
        const double total = Model(table).integrate([&](const Vec3d& d) { return environment_pdf<float>(table.tables(), narrowed(d)); }, 2);
        EXPECT_NEAR(total, 1, 8 * 0x1p-24) << map.name;
    }
}

// A cell's share of the samples equals its share of the light.
TEST(EnvironmentSampling, CellProbabilitiesFollowTheFilteredMap) {
    for (const NamedMap& map : maps()) {
        const EnvironmentTable table = build_environment_table(map.environment);
        const Model model(table);
        const Vec3d integral = table.integral();
        const double total = luminance(integral);
        if (total == 0) continue;
        const auto mean = [&](int row, int column, int points) {
            double sum = 0;
            for (int i = 0; i < points * points; ++i) {
                const Vec3d d = model
                                    .point((row + (i / points + 0.5) / points) / (table.height + 1),
                                           (column + (i % points + 0.5) / points) / table.width)
                                    .direction;
                sum += luminance(Vec3d{model.radiance(d, 0), model.radiance(d, 1), model.radiance(d, 2)});
            }
            return sum / (points * points);
        };
        for (int row = 0; row <= table.height; ++row) {
            for (int column = 0; column < table.width; ++column) {
                const statistics::Chart::Point center = model.point((row + 0.5) / (table.height + 1), (column + 0.5) / table.width);
                const double coarse = mean(row, column, 8), fine = mean(row, column, 16);
                // Thresholds are multiples of 2^-32; every cell with light gets at least one.
                const double quantum =
                    (table.width + table.height + 3) * 0x1p-32 / (center.solid_angle / ((table.height + 1) * table.width));
                const double expected = fine / total;
                ASSERT_NEAR(environment_pdf<float>(table.tables(), narrowed(center.direction)), expected,
                            std::abs(fine - coarse) / total + quantum + 8 * 0x1p-24 * expected)
                    << map.name << ", cell " << column << ", " << row;
            }
        }
    }
}

TEST(EnvironmentSampling, EveryEmissiveCellCanBeSampled) {
    Random random(7);
    for (const NamedMap& map : maps()) {
        const EnvironmentTable table = build_environment_table(map.environment);
        for (int k = 0; k < 20000; ++k) {
            const Vec3 d = random.direction();
            if (max_component(environment_radiance<float>(table.tables(), d, true)) > 0) {
                ASSERT_GT(environment_pdf<float>(table.tables(), d), 0) << map.name;
            }
        }
    }
}

TEST(EnvironmentSampling, SamplesKnowTheirDensityAndRadiance) {
    Random random(8);
    std::vector<NamedMap> all = sampled_maps();
    all.push_back({"large", map_of(2048, 1024, 33, [&] { return random.below(50) == 0 ? 1000 * random.unit() : random.unit(); })});
    for (const NamedMap& map : all) {
        const EnvironmentTable table = build_environment_table(map.environment, map.sampling);
        const EnvironmentTables tables = table.tables();
        const Model model(table);
        int64_t apart = 0;
        for (int k = 0; k < 50000; ++k) {
            const EnvironmentSample<float> s = draw(tables, random);
            ASSERT_NEAR(length(s.direction), 1, 1e-6) << map.name;
            ASSERT_GT(s.pdf, 0) << map.name;
            ASSERT_EQ(s.radiance, environment_radiance<float>(tables, s.direction, true));
            if (s.pdf == environment_pdf<float>(tables, s.direction)) continue;
            // Rounding may carry a direction over the border of its cell, and no further.
            ++apart;
            const MapPoint p = model.locate(widened(s.direction));
            ASSERT_TRUE(std::abs(p.x - std::round(p.x)) < model.column_error() || std::abs(p.y - std::round(p.y)) < model.row_error())
                << map.name;
        }
        EXPECT_LE(double(apart), 50000 * 4 * (model.column_error() + model.row_error())) << map.name;
    }
}

// With MIS compensation the density is proportional to what a cell's mean has above the map's mean, or above 3/4 of it.
TEST(EnvironmentSampling, CompensatedDensityIsTheLightAboveTheMean) {
    size_t uneven = 0;
    for (const auto& [sampling, share] :
         {std::pair{EnvironmentSampling::compensated, 1.0}, std::pair{EnvironmentSampling::compensated_alone, 0.75}})
        for (const NamedMap& map : maps()) {
            const EnvironmentTable full = build_environment_table(map.environment);
            const EnvironmentTable table = build_environment_table(map.environment, sampling);
            const Model model(table);
            // Before the parameters' scale; the density of the full map is known (CellProbabilitiesFollowTheFilteredMap).
            const double total = dot(luminance_weights, full.texel_integral), mean = total / (4 * exact_pi);
            const auto above = [&](const Vec3d& d, double level) {
                return std::max(0.0, environment_pdf<float>(full.tables(), narrowed(d)) * total - level);
            };
            const double above_mean = model.integrate([&](const Vec3d& d) { return above(d, mean); }, 2);
            EXPECT_NEAR(table.sampled_share, total > 0 ? above_mean / total : 0, 1e-5) << map.name;
            if (table.sampled_share == 0) continue;
            ++uneven;
            const double sampled = model.integrate([&](const Vec3d& d) { return above(d, share * mean); }, 2);
            for (int row = 0; row <= table.height; ++row)
                for (int column = 0; column < table.width; ++column) {
                    const statistics::Chart::Point center = model.point((row + 0.5) / (table.height + 1), (column + 0.5) / table.width);
                    const double expected = above(center.direction, share * mean) / sampled;
                    const double cell = center.solid_angle / ((table.height + 1) * table.width);
                    // Of the densities in single precision, and of thresholds: a cell at the end of a row may keep 2^-32.
                    const double error = 1e-6 * (mean / sampled + expected) + (table.width + table.height + 3) * 0x1p-32 / cell;
                    ASSERT_NEAR(environment_pdf<float>(table.tables(), narrowed(center.direction)), expected, error)
                        << map.name << ", cell " << column << ", " << row;
                }
        }
    EXPECT_GE(uneven, 16u);
}

TEST(EnvironmentSampling, AnEvenMapIsLeftToBsdfSampling) {
    Random random(10);
    const auto share = [](const Environment& e) { return build_environment_table(e, EnvironmentSampling::compensated).sampled_share; };
    EXPECT_EQ(share(map_of(16, 8, 0, [] { return 3.f; })), 0);
    EXPECT_EQ(share(map_of(16, 8, 0, [&] { return 3 + 0.01f * random.unit(); })), 0);
    EXPECT_GT(share(map_of(16, 8, 0, [&] { return 3 * random.unit(); })), 0.05);
    EXPECT_GT(share(one_texel(64, 32, 9, 4, 1e6f, 1)), 0.95);
}

TEST(EnvironmentSampling, EstimatesTheIrradianceOfEveryMap) {
    Random random(9);
    const std::vector<NamedMap> all = maps();
    for (const NamedMap& map : all) {
        const EnvironmentTable table = build_environment_table(map.environment);
        const Model model(table);
        for (int trial = 0; trial < 3; ++trial) {
            const Vec3 n = random.direction();
            const auto cosine = [&](const Vec3d& d) { return std::max(0.0, n.x * d.x + n.y * d.y + n.z * d.z); };
            const double expected =
                model.integrate([&](const Vec3d& d) { return cosine(d) * model.radiance(d, 0); }, 96 / std::min(table.height, 12));
            const statistics::Moments m = statistics::estimate(20000, [&] {
                const EnvironmentSample<float> s = draw(table.tables(), random);
                return cosine(widened(s.direction)) * double(s.radiance.x) / double(s.pdf);
            });
            EXPECT_TRUE(statistics::z_test(m, expected, statistics::sidak(statistics::significance, int64_t(3 * all.size())))) << map.name;
        }
    }
}

// A row may be rarer than the 24 bits of the number that picks it.
TEST(EnvironmentSampling, RareRowsAreSampled) {
    int next = 0;
    const EnvironmentTable table = build_environment_table(map_of(1, 3, 0, [&] {
        const int texel = next++ / 3;
        return texel == 0 ? 1.f : texel == 1 ? 0.f : 3e-9f;
    }));
    const EnvironmentTables tables = table.tables();
    const double p_rare = environment_pdf<float>(tables, {0, -1, 0}) * 4 * exact_pi * std::pow(std::sin(exact_pi / 12), 2);
    ASSERT_LT(p_rare, 0x1p-24);
    // The last number below 1 represents 2^-24 of all, and the rarest row lies in its share.
    Random random(10);
    const statistics::Moments m = statistics::estimate(200000, [&] {
        const EnvironmentSample<float> s = sample_environment<float>(tables, one_minus_epsilon, random.bits());
        return environment_cell<float>(tables, s.direction).row == 3;
    });
    EXPECT_TRUE(statistics::z_test(m, p_rare * 0x1p24));
}

TEST(EnvironmentSampling, GuideTableEqualsPlainBisection) {
    Random random(11);
    for (const int n : {1, 2, 3, 7, 64, 1000}) {
        for (int guide_bits = 1; guide_bits <= 11; guide_bits += 2) {
            std::vector<double> weights(static_cast<size_t>(n));
            for (double& w : weights) w = random.below(3) == 0 ? 0 : std::exp(random.between(-20, 5));
            const std::vector<uint32_t> thresholds = make_thresholds(weights);
            const std::vector<int32_t> guide = make_guide(thresholds, guide_bits);
            const auto expect_same = [&](uint32_t bits) {
                const auto plain = sample_discrete<float>(thresholds.data(), 0, n, bits);
                const auto guided = sample_guided<float>(thresholds.data(), 0, n, guide.data(), 0, guide_bits, bits);
                ASSERT_EQ(guided.index, plain.index);
                ASSERT_EQ(guided.probability, plain.probability);
                ASSERT_EQ(guided.remainder, plain.remainder);
            };
            for (int k = 0; k < 500; ++k) expect_same(random.bits());
            for (const uint32_t t : thresholds) {
                expect_same(t);
                expect_same(t - 1); // of 0: the largest number there is
            }
        }
    }
}

TEST(EnvironmentTable, IntegralIsThatOfTheMap) {
    for (const NamedMap& map : maps()) {
        const EnvironmentTable table = build_environment_table(map.environment);
        const Model model(table);
        const auto quadrature = [&](int points) { return model.integrate([&](const Vec3d& d) { return model.radiance(d, 0); }, points); };
        // The midpoint rule's error falls to a quarter with twice the points: the change is three times the remaining error.
        const double coarse = quadrature(16), fine = quadrature(32);
        EXPECT_NEAR(table.integral().x, fine, std::abs(fine - coarse) + 1e-12 * fine) << map.name;
    }
}

TEST(EnvironmentTable, ParametersChangeWithoutTheMap) {
    Random random(12);
    Environment e = map_of(8, 4, 10, [&] { return random.unit(); });
    EnvironmentTable table = build_environment_table(e);
    e.color = {1, 0.5f, 0.25f};
    e.intensity = 3;
    e.rotation_degrees = 400;
    e.visible_to_camera = false;
    update_environment_parameters(table, e);
    const EnvironmentTable fresh = build_environment_table(e);
    EXPECT_EQ(table.scale, fresh.scale);
    EXPECT_EQ(table.scale, (Vec3{3, 1.5f, 0.75f}));
    EXPECT_EQ(table.rotation, fresh.rotation);
    EXPECT_FLOAT_EQ(table.rotation, float(40.0 / 360));
    EXPECT_FALSE(table.visible_to_camera);
    EXPECT_EQ(table.row_thresholds, fresh.row_thresholds);
    EXPECT_EQ(table.column_thresholds, fresh.column_thresholds);
    EXPECT_EQ(table.column_guides, fresh.column_guides);
}

} // namespace blush::TEST_FILE
