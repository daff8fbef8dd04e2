// Chi-squared tests of sampling each kind of light with a size, as in the estimator: points are distributed by their stated pdf.
// Points, spots, and suns of zero size need no sampling; their IES profiles and cones scale the emission.
#include "core/math.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/integrator/light_sampling.h"
#include "scene/affine.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <array>
#include <cmath>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr double pi = std::numbers::pi;

struct Drawn {
    LightPoint<float> point;
    Vec3 direction; // from the receiver, unit
    Vec3d position; // world space; unused for lights at infinity
    double pdf = 0; // per solid angle
};

// A scene with one light, and a receiver at the world origin that faces all directions.
struct Desk {
    Scene scene;
    RenderScene compiled;
    std::mt19937 bits{29};

    void compile() { compiled.update(expand_area_lights(scene), settings_for(8, 8, 1), full_plan(), Workers(1)); }
    void place_light(const Light& light, const Transform& transform) {
        stability::place_light(scene, light, transform);
        compile();
    }
    Vec3 receiver() const { return to_float(compiled.origin() * -1); }
    Drawn draw() {
        const Receiver<float> to{receiver(), {0, 0, 0}};
        Drawn d{sample_light_point<all_features, float>(compiled.tables(), {uint32_t(bits()), uint32_t(bits())}, to, true), {}, {}};
        const Vec3 way = d.point.infinite ? d.point.position : d.point.position - to.position;
        const float distance2 = dot(way, way);
        d.direction = way / std::sqrt(distance2);
        d.position = to_double(d.point.position) + compiled.origin();
        d.pdf = double(incident_light<all_features, float>(compiled.tables(), d.point, d.direction, distance2).pdf);
        return d;
    }
};

constexpr int kinds = 7, side = 12;
constexpr int64_t samples = 60'000;

// Points mapped to the unit square such that the expected density is uniform; `pdf` is the stated pdf.
template <class Map, class Pdf> void expect_even(const char* kind, Desk& desk, const Map& to_square, const Pdf& pdf) {
    std::vector<int64_t> counts(size_t(side * side));
    for (int64_t i = 0; i < samples; ++i) {
        const Drawn d = desk.draw();
        ASSERT_TRUE(d.point.valid) << kind;
        const std::array<double, 2> at = to_square(d);
        const auto cell = [](double v) { return std::clamp(int(v * side), 0, side - 1); };
        ++counts[size_t(cell(at[0]) * side + cell(at[1]))];
        const double expected = pdf(d);
        ASSERT_NEAR(d.pdf, expected, 1e-4 * expected) << kind;
    }
    EXPECT_TRUE(
        chi_squared_test(counts, std::vector<double>(counts.size(), double(samples) / double(counts.size())), sidak(significance, kinds)))
        << kind;
}

Light light_of(Light::Kind kind) {
    Light light;
    light.kind = kind;
    light.two_sided = true;
    return light;
}

// The area pdf 1 / area converted to solid angle.
double over_area(const Drawn& d, double area) {
    const Vec3d way = d.position;
    const double facing = std::abs(dot(normalize(way), to_double(d.point.normal)));
    return dot(way, way) / (area * facing);
}

TEST(LightSamples, OfRectanglesAreUniformInArea) {
    Desk desk;
    Light light = light_of(Light::Kind::rectangle);
    light.width = 2;
    light.height = 0.5f;
    desk.place_light(light, at({0.5f, -0.25f, 3}));
    expect_even(
        "rectangle", desk,
        [](const Drawn& d) {
            return std::array{(d.position.x - 0.5) / 2 + 0.5, (d.position.y + 0.25) / 0.5 + 0.5};
        },
        [](const Drawn& d) { return over_area(d, 1); });
}

// A polygon with as many corners and the disk's area.
TEST(LightSamples, OfDisksAreUniformInArea) {
    constexpr double corners = 96, step = 2 * pi / corners;
    const double radius = std::sqrt(2 * pi / (corners * std::sin(step)));
    Desk desk;
    Light light = light_of(Light::Kind::disk);
    light.radius = 1;
    desk.place_light(light, at({0, 0.5f, 2}));
    expect_even(
        "disk", desk,
        [&](const Drawn& d) {
            const double x = d.position.x, y = d.position.y - 0.5, angle = std::atan2(y, x) + 2 * pi;
            const double edge = radius * std::cos(step / 2) / std::cos(std::fmod(angle, step) - step / 2);
            return std::array{(x * x + y * y) / (edge * edge), std::fmod(angle / (2 * pi), 1.0)};
        },
        [](const Drawn& d) { return over_area(d, pi); });
}

// The triangles of one face are selected by power, that is by area.
TEST(LightSamples, OfEmissiveFacesAreUniformInArea) {
    Desk desk;
    Material glow = emitter(2);
    glow.double_sided = true;
    place(desk.scene, quad({2, 0, 3}, {2, 0, 5}, {2, 4, 5}, {2, 4, 3}), glow);
    desk.compile();
    expect_even(
        "face", desk,
        [](const Drawn& d) {
            return std::array{d.position.y / 4, (d.position.z - 3) / 2};
        },
        [](const Drawn& d) { return over_area(d, 8); });
}

// Of a box, the tree selects no face that is turned away.
TEST(LightSamples, OfEmissiveBoxesAreOnFacesTowardsTheReceiver) {
    Desk desk;
    place(desk.scene, cube(false), emitter(2), at({2, 1, 3}, 0.5f));
    desk.compile();
    for (int i = 0; i < 1000; ++i) {
        const Drawn d = desk.draw();
        ASSERT_TRUE(d.point.valid);
        ASSERT_LT(dot(d.direction, d.point.normal), 0);
    }
}

// Cone coordinates: height in the cone, and azimuth.
std::array<double, 2> in_cone(const Vec3& direction, const Vec3& axis, double height) {
    const Vec3 w = basis_around(axis).to_local(direction);
    const double sin2 = double(w.x) * w.x + double(w.y) * w.y;
    return {sin2 / (1 + std::sqrt(1 - sin2)) / height, std::atan2(w.y, w.x) / (2 * pi) + 0.5};
}

TEST(LightSamples, OfSpheresAreUniformInSolidAngle) {
    Desk desk;
    Light light = light_of(Light::Kind::sphere);
    light.radius = 0.5f;
    desk.place_light(light, at({1, 2, 2}));
    const double sin2 = 0.25 / 9, height = sin2 / (1 + std::sqrt(1 - sin2));
    expect_even(
        "sphere", desk,
        [&](const Drawn& d) {
            return in_cone(d.direction, unit({1, 2, 2}), height);
        },
        [&](const Drawn&) { return 1 / (2 * pi * height); });
}

TEST(LightSamples, OfSunsAreUniformInSolidAngle) {
    Desk desk;
    Light light = light_of(Light::Kind::sun);
    light.angle_radians = 0.3f;
    const Vec3 towards = unit({0.3f, 1, -0.4f});
    desk.place_light(light, aimed({0, 0, 0}, {-towards.x, -towards.y, -towards.z}));
    const double height = 1 - std::cos(0.15);
    expect_even(
        "sun", desk, [&](const Drawn& d) { return in_cone(d.direction, towards, height); },
        [&](const Drawn&) { return 1 / (2 * pi * height); });
}

// Environments, compared with the pdf that is used to weight hits.
void expect_follows(Desk& desk, const char* kind) {
    const DirectionTest test{.rows = 24, .columns = 24, .points = 12, .samples = samples, .alpha = sidak(significance, kinds)};
    const auto pdf = [&](const Vec3& w) { return environment_pdf<float>(desk.compiled.tables().environment, w); };
    EXPECT_TRUE(directions_follow(
        test, [&] { return std::optional(desk.draw().direction); }, pdf))
        << kind;
}

TEST(LightSamples, OfAnImageFollowItsRadiance) {
    Desk desk;
    std::vector<Vec3> texels;
    std::mt19937 bits{3};
    for (int i = 0; i < 16 * 8; ++i) texels.push_back(splat<float>(float(bits() % 1000) / 100));
    desk.scene.environment.kind = Environment::Kind::image;
    desk.scene.environment.image = float_image(16, 8, texels);
    desk.scene.environment.rotation_degrees = 40;
    desk.compile();
    expect_follows(desk, "image");
}

TEST(LightSamples, OfTheSkyFollowItsRadiance) {
    Desk desk;
    desk.scene.environment.kind = Environment::Kind::sky;
    desk.scene.environment.sky.sun_disk = false;
    desk.scene.environment.sky.elevation_degrees = 20;
    desk.compile();
    expect_follows(desk, "sky");
}

} // namespace
} // namespace blush::test::TEST_FILE
