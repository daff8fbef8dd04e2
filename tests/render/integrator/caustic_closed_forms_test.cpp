// Light paths, and what pilots choose by themselves, against answers that do not come from this renderer: closed forms, and rays in double
// precision. Floors are almost black, so that light that they scatter does not come back.
#include "render/integrator/dispersion.h"
#include "tests/render/integrator/caustic_images.h"
#include "tests/render/integrator/ray_tracer.h"
#include "tests/render/irradiance.h"
#include "tests/support/statistics.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr float albedo = 0.001f;
constexpr double pi_ = std::numbers::pi;

struct Ways {
    const char* name;
    CausticStrategy setting;
    CausticOptions options;
};
const Ways automatic{"auto", CausticStrategy::automatic, {}};
const Ways light_paths{"light paths", CausticStrategy::light_paths, {.light_path_share = 1.f, .manifold_sampling = false}};
const Ways manifold_sampling{"manifold sampling", CausticStrategy::manifold, {.light_path_share = 0.f, .manifold_sampling = true}};

std::vector<Measured> blocks_of(const Scene& scene, RenderSettings settings, const Ways& ways, int images = 10) {
    settings.caustics = ways.setting;
    return image_blocks(scene, settings, ways.options, images, 1, [](Renderer&) {});
}

// ---- a small lamp over a ball and a floor

constexpr float lamp_radius = 0.04f, candela = 500, half = 1.2f;
const Vec3 lamp_at{0.3f, 1.9f, 0.2f}, ball_at{0, 0.9f, 0};
constexpr float ball_radius = 0.5f;

Scene lamp_over(const Material& ball, float radius) {
    Scene scene;
    place(scene, floor_quad(50), lambert(albedo));
    place(scene, sphere(false), ball, at(ball_at, ball_radius));
    place_light(scene, caustic_light(Light::Kind::point, candela, radius), at(lamp_at));
    scene.view = looking_down(half, 0.1f);
    return scene;
}
// Radiance of the nine blocks of the floor by Snell's and Fresnel's laws, from rays that carry equal flux: what does not arrive in them
// arrives elsewhere, as nothing is absorbed.
std::vector<Measured> traced_floor(double ior, float radius) {
    constexpr int rays = 1'000'000, n = 3;
    RayTracer tracer(*sphere(false), to_double(ball_at), double(ball_radius), ior);
    std::vector<int64_t> counts(n * n);
    for (int i = 0; i < rays; ++i) {
        const std::optional<Vec3d> p = tracer.arrival(to_double(lamp_at), double(radius));
        if (!p || std::abs(p->x) >= double(half) || std::abs(p->z) >= double(half)) continue;
        const auto cell = [](double x) { return size_t((x / double(half) + 1) / 2 * n); };
        ++counts[cell(p->z) * n + cell(p->x)];
    }
    std::vector<Measured> blocks;
    const double area = std::pow(2 * double(half) / n, 2), radiance = 4 * pi_ * double(candela) / area * double(albedo) / pi_;
    for (const int64_t count : counts) {
        const double share = double(count) / rays, error = std::sqrt(double(count) + 1) / rays; // of a rare event
        const double l = radiance * share, e = radiance * error;
        blocks.push_back({{l, l, l}, {e, e, e}});
    }
    return blocks;
}

TEST(CausticClosedForms, FluxThroughAGlassBallArrivesOnTheFloor) {
    for (const float radius : {lamp_radius, 0.f}) {
        const std::vector<Measured> traced = traced_floor(1.5, radius), thinner = traced_floor(1.45, radius);
        for (const Ways& ways : {automatic, light_paths}) {
            SCOPED_TRACE(testing::Message() << ways.name << ", lamp of radius " << radius);
            const std::vector<Measured> seen = blocks_of(lamp_over(glass(0, 1.5f), radius), settings_for(36, 36, 48), ways);
            EXPECT_TRUE(same_means(seen, traced));
            EXPECT_FALSE(same_means(seen, thinner)) << "the test is too weak to see an index of 1.45";
        }
    }
}

TEST(CausticClosedForms, FluxFromAMirrorBallArrivesOnTheFloor) {
    for (const float radius : {lamp_radius, 0.f}) {
        const std::vector<Measured> traced = traced_floor(0, radius);
        for (const Ways& ways : {automatic, light_paths}) {
            SCOPED_TRACE(testing::Message() << ways.name << ", lamp of radius " << radius);
            EXPECT_TRUE(same_means(blocks_of(lamp_over(metal(0), radius), settings_for(36, 36, 48), ways), traced));
        }
    }
}

// ---- a lamp and its image in a mirror

constexpr double mirror = -1.5;
// A floor beside a mirror in the plane x = `mirror`, `size` metres high and twice as wide.
Scene mirrored_floor(float size) {
    Scene scene;
    place(scene, floor_quad(50), lambert(albedo));
    place(scene, quad({float(mirror), 0, size}, {float(mirror), 0, -size}, {float(mirror), size, -size}, {float(mirror), size, size}),
          metal(0));
    scene.view = looking_down(1, 0.1f);
    return scene;
}
// Radiance of the nine blocks of the floor; `irradiance` is that of a point of it.
template <class Irradiance> std::vector<Measured> floor_blocks(const Irradiance& irradiance) {
    constexpr int n = 3, steps = 32;
    std::vector<Measured> blocks;
    for (int block = 0; block < n * n; ++block) {
        double sum = 0;
        for (int i = 0; i < steps * steps; ++i) {
            const auto along = [&](int cell, int step) { return (cell + (step + 0.5) / steps) * 2 / n - 1; };
            sum += irradiance(Vec3d{along(block % n, i % steps), 0, along(block / n, i / steps)});
        }
        const double l = sum / (steps * steps) * double(albedo) / pi_;
        blocks.push_back({{l, l, l}, {0, 0, 0}});
    }
    return blocks;
}
// `floor`: its blocks if the mirror reflects this share.
void expect_mirrored_light(const Scene& scene, const std::function<std::vector<Measured>(double)>& floor) {
    const Ways manifolds{"manifold sampling", CausticStrategy::manifold, {.light_path_share = 0.f, .manifold_sampling = true}};
    for (const Ways& ways : {automatic, light_paths, manifolds}) {
        SCOPED_TRACE(ways.name);
        const std::vector<Measured> seen = blocks_of(scene, settings_for(36, 36, 48), ways);
        EXPECT_TRUE(same_means(seen, floor(1)));
        EXPECT_FALSE(same_means(seen, floor(0.95))) << "the test is too weak to see a mirror that absorbs 5 %";
    }
}

// Irradiance by the lamp, and by the lamp that the mirror shows behind it.
TEST(CausticClosedForms, AMirrorShowsASecondLamp) {
    Light lamp = caustic_light(Light::Kind::rectangle, 100);
    lamp.width = 0.3f, lamp.height = 0.2f;
    const Transform place_of_lamp = aimed({0.4f, 1.2f, 0.3f}, {-0.6f, -1, 0});
    Scene scene = mirrored_floor(20);
    place_light(scene, lamp, place_of_lamp);
    const std::array<Vec3d, 4> corners = rectangle_corners(lamp, place_of_lamp);
    std::array<Vec3d, 4> mirrored = corners;
    for (Vec3d& c : mirrored) c.x = 2 * mirror - c.x;
    expect_mirrored_light(scene, [&](double reflected) {
        return floor_blocks([&](const Vec3d& p) {
            return 100 * (polygon_irradiance(p, {0, 1, 0}, corners) + reflected * polygon_irradiance(p, {0, 1, 0}, mirrored));
        });
    });
}

// No ray hits a light without size.
TEST(CausticClosedForms, AMirrorShowsAPointWithoutSize) {
    Scene scene = mirrored_floor(20);
    const Vec3d lamp{0.4, 1.2, 0.3}, behind{2 * mirror - lamp.x, lamp.y, lamp.z};
    place_light(scene, caustic_light(Light::Kind::point, 100), at(to_float(lamp)));
    const auto irradiance = [](const Vec3d& p, const Vec3d& light) { return 100 * light.y / std::pow(length(light - p), 3); };
    expect_mirrored_light(scene, [&](double reflected) {
        return floor_blocks([&](const Vec3d& p) { return irradiance(p, lamp) + reflected * irradiance(p, behind); });
    });
}
TEST(CausticClosedForms, AMirrorShowsASunWithoutSize) {
    Scene scene = mirrored_floor(5);
    const Vec3d to_sun = normalize(Vec3d{0.6, 1, 0.2});
    place_light(scene, caustic_light(Light::Kind::sun, 100), aimed({0, 5, 0}, to_float(to_sun * -1.0)));
    // The mirror is large enough to light the whole view.
    expect_mirrored_light(scene,
                          [&](double reflected) { return floor_blocks([&](const Vec3d&) { return 100 * to_sun.y * (1 + reflected); }); });
}

// ---- the spectrum behind a prism

constexpr double sun_radius = 1e-3, apex = pi_ / 3, tilt = 49 * pi_ / 180; // tilt: of the first face
constexpr double slit = 0.01, spectrum_at = 0.95;                          // half width, and where the middle of the image is
constexpr float view_half = 0.24f, lux = 1000, flint_ior = 1.5f, flint_dispersion = 3;

// Sunlight from above passes a slit at x = 0 and enters the prism at a height of 1.2 m. Its faces are at right angles to the x-y plane.
Scene prism_in_the_sun() {
    const auto shifted = [](double x, double y, double z) { return to_float(Vec3d{x - spectrum_at, y, z}); };
    Scene scene;
    place(scene, floor_quad(2), lambert(albedo)); // within the shadow of the slit's sides
    for (const double s : {-1.0, 1.0}) {
        const double near = s * slit, far = s * 5;
        place(scene, quad(shifted(near, 2, -5), shifted(near, 2, 5), shifted(far, 2, 5), shifted(far, 2, -5)), lambert(0));
    }
    const Vec3d a{-0.2 * std::cos(tilt), 1.2 - 0.2 * std::sin(tilt), 0};
    const Vec3d b = a + Vec3d{std::cos(tilt), std::sin(tilt), 0} * 0.6,
                c = a + Vec3d{std::cos(tilt - apex), std::sin(tilt - apex), 0} * 0.6;
    const auto corner = [&](const Vec3d& p, double z) { return shifted(p.x, p.y, z); };
    Material flint = glass(0, flint_ior);
    flint.dispersion = flint_dispersion;
    Geometry body;
    for (const double z : {-2.0, 2.0})
        for (const Vec3d& p : {a, b, c}) body.positions.push_back(corner(p, z));
    // Counter-clockwise seen from outside; a, b, c is clockwise seen from +z.
    body.indices = {0, 1, 2, 3, 5, 4, 0, 4, 1, 0, 3, 4, 1, 5, 2, 1, 4, 5, 2, 3, 0, 2, 5, 3};
    place(scene, std::make_shared<const Geometry>(std::move(body)), flint);
    Light sun = caustic_light(Light::Kind::sun, lux);
    sun.angle_radians = float(2 * sun_radius);
    place_light(scene, sun, aimed({0, 5, 0}, {0, -1, 0}));
    scene.view = looking_down(view_half, 0.1f);
    return scene;
}

// Where a ray through the slit at x, `lean` radians off the vertical, meets the floor, and the share of its light that does (Fresnel).
struct Landing {
    double x, share;
};
Landing landing(double x, double lean, double n) {
    const auto passes = [](double n1, double n2, double sine) {
        const double other = n1 / n2 * sine, c = std::sqrt(1 - sine * sine), d = std::sqrt(1 - other * other);
        const double s = (n1 * c - n2 * d) / (n1 * c + n2 * d), p = (n1 * d - n2 * c) / (n1 * d + n2 * c);
        return 1 - (s * s + p * p) / 2;
    };
    // Deviation of a prism: angles to the two normals, i1 -> r1, r2 = apex - r1 -> i2.
    const double i1 = tilt - lean, r1 = std::asin(std::sin(i1) / n), r2 = apex - r1, i2 = std::asin(n * std::sin(r2));
    const double deviation = i1 + i2 - apex;
    // The first face: through (0, 1.2), along (cos tilt, sin tilt). The ray comes from (x, 2) along (sin lean, -cos lean).
    const double t = (0.8 - x * std::tan(tilt)) / (std::cos(lean) + std::sin(lean) * std::tan(tilt));
    const double x1 = x + t * std::sin(lean), y1 = 2 - t * std::cos(lean);
    // Within the prism, then the second face, through the apex.
    const double inside = lean + i1 - r1, ax = -0.2 * std::cos(tilt), ay = 1.2 - 0.2 * std::sin(tilt), slope = std::tan(tilt - apex);
    const double u = (y1 - ay - (x1 - ax) * slope) / (std::cos(inside) + std::sin(inside) * slope);
    const double x2 = x1 + u * std::sin(inside), y2 = y1 - u * std::cos(inside);
    return {x2 + y2 * std::tan(lean + deviation), passes(1, n, std::sin(i1)) * passes(n, 1, std::sin(r2))};
}

// Radiance of the columns of the image, for an index of refraction by wavelength.
constexpr int columns = 12;
std::vector<Vec3d> spectrum_of(const auto& index) {
    constexpr int angles = 65, places = 64;
    std::vector<Vec3d> seen(columns);
    const Spectrum& spectrum = visible_spectrum();
    double weights = 0;
    for (int k = 0; k < angles; ++k) weights += std::sqrt(1 - std::pow((k + 0.5) * 2 / angles - 1, 2));
    for (int s = 0; s < Spectrum::steps; ++s) {
        const double n = index(double(spectrum.nanometres[s]));
        const Vec3d rgb{spectrum.rgb[3 * s], spectrum.rgb[3 * s + 1], spectrum.rgb[3 * s + 2]};
        for (int k = 0; k < angles; ++k) {
            const double off = (k + 0.5) * 2 / angles - 1, part = std::sqrt(1 - off * off) / weights; // of the sun's disk
            for (int i = 0; i < places; ++i) {
                const Landing l = landing(((i + 0.5) * 2 / places - 1) * slit, off * sun_radius, n);
                const double column = ((l.x - spectrum_at) / double(view_half) + 1) / 2 * columns;
                if (!(column >= 0 && column < columns)) continue;
                const double flux = double(lux) * 2 * slit / places * part * l.share / Spectrum::steps; // per metre of the slit
                Vec3d& to = seen[size_t(column)];
                to = to + rgb * (flux / (2 * double(view_half) / columns) * double(albedo) / pi_);
            }
        }
    }
    return seen;
}
// Cauchy's equation as KHR_materials_dispersion gives it: V = 20 / dispersion, n = 1.5 at 587.6 nm.
double flint_index(double nanometres, double dispersion) {
    const double n_d = double(flint_ior), b = (n_d - 1) / (20 / dispersion) / (1 / (0.4861 * 0.4861) - 1 / (0.6563 * 0.6563));
    return n_d + b * (1e6 / (nanometres * nanometres) - 1 / (0.5876 * 0.5876));
}

TEST(CausticClosedForms, APrismSendsEachWavelengthWhereSnellsLawDoes) {
    const double dispersion = double(flint_dispersion);
    const auto expected_with = [&](const auto& index) {
        std::vector<Measured> all;
        const std::vector<Vec3d> sums = spectrum_of(index);
        double peak = 0;
        for (const Vec3d& c : sums) peak = std::max({peak, c.x, c.y, c.z});
        const double error = peak / 1000; // of the quadrature: a thousandth of the light near the edge of a column
        for (const Vec3d& c : sums) all.push_back({c, {error, error, error}});
        return all;
    };
    RenderSettings settings = settings_for(columns * 3, columns * 3, 48);
    settings.max_bounces = 3; // the floor and two refractions
    for (const Ways& ways : {automatic, light_paths, manifold_sampling}) {
        SCOPED_TRACE(ways.name);
        settings.caustics = ways.setting;
        const auto seen = image_regions(prism_in_the_sun(), settings, ways.options, 10, 1, 3, columns * 3, [&](Renderer& renderer) {
            if (ways.options.manifold_sampling)
                EXPECT_EQ(feature_line(renderer, "manifold sampling").used, *ways.options.manifold_sampling);
        });
        EXPECT_TRUE(same_means(seen, expected_with([&](double l) { return flint_index(l, dispersion); })));
        EXPECT_FALSE(same_means(seen, expected_with([&](double l) { return flint_index(l, 0.95 * dispersion); }))) << "too weak for 5 %";
        // The place of the bands: their centre of light, red least deviated.
        const auto centre = [](const std::vector<Measured>& c, double Vec3d::*channel) {
            double sum = 0, moment = 0;
            for (size_t i = 0; i < c.size(); ++i) sum += c[i].mean.*channel, moment += c[i].mean.*channel * (double(i) + 0.5);
            return moment / sum;
        };
        const double red = centre(seen, &Vec3d::x), green = centre(seen, &Vec3d::y), blue = centre(seen, &Vec3d::z);
        EXPECT_LT(red + 0.2, green);
        EXPECT_LT(green + 0.5, blue);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
