// White furnace tests: in uniform light, a lossless object is invisible.
#include "shading/energy.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;
constexpr double pi = std::numbers::pi;

// The material on a convex body that fills the image, in an environment of radiance 1.
Scene furnace(const GeometryPtr& body, const Material& material) {
    Scene scene;
    place(scene, body, material);
    constant_world(scene, 1);
    scene.view = looking({0.4f, 1.1f, 3}, {0, 0, 0}, 0.4f);
    return scene;
}
Measured ball(const Material& material, int64_t spp = 64, bool compensate = false) {
    RenderSettings settings = settings_for(16, 16, spp);
    settings.energy_compensation = compensate;
    return render(furnace(sphere(false), material), settings).whole();
}

// A plane seen at one angle shows its directional albedo everywhere.
Measured plane(const Material& material, double degrees, bool from_below = false) {
    Scene scene;
    place(scene, floor_quad(100), material);
    constant_world(scene, 1);
    const double a = degrees * pi / 180;
    scene.view = looking({float(5 * std::sin(a)), float((from_below ? -5 : 5) * std::cos(a)), 0}, {0, 0, 0}, 0.5f);
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 0.5f;
    return render(scene, settings_for(16, 16, 64)).whole();
}

TEST(Furnace, LosslessWhiteBodiesAreInvisible) {
    struct Case {
        const char* name;
        Material material;
    };
    Material thin = glass(0, 1.5f);
    thin.thickness = 0;
    const std::vector<Case> cases = {{"lambert", lambert(1)},         {"smooth metal", metal(0)},         {"smooth glass", glass(0, 1.5f)},
                                     {"diamond", glass(0, 2.42f)},    {"glass of ior 1", glass(0.5f, 1)}, {"thin smooth glass", thin},
                                     {"gel of white", gel({1, 1, 1})}};
    for (const Case& c : cases) EXPECT_TRUE(is_mean(ball(c.material), 1, sidak(significance, int64_t(cases.size())))) << c.name;
}

// Single scattering loses the light that a microfacet reflects onto others; the boundary test below measures how much.
TEST(Furnace, RoughBodiesLoseEnergyAndNeverGain) {
    Material thin = glass(0.6f, 1.5f);
    thin.thickness = 0;
    for (const Material& m : {metal(0.2f), metal(0.6f), metal(1), glass(0.3f, 1.5f), glass(0.8f, 1.5f), thin}) {
        const Measured seen = ball(m);
        EXPECT_LT(seen.mean.x, 1 + 3 * seen.error.x) << "roughness " << m.roughness << ", transmission " << m.transmission;
    }
    const Measured roughest = ball(metal(1));
    EXPECT_LT(roughest.mean.x + 10 * roughest.error.x, 1) << "nothing to compensate";
}

TEST(Furnace, CompensatedMetalLosesNothing) {
    constexpr int count = 5;
    for (const float roughness : {0.f, 0.2f, 0.5f, 0.8f, 1.f})
        EXPECT_TRUE(is_mean(ball(metal(roughness), 64, true), 1, sidak(significance, count), 2 * EnergyTable::relative_error))
            << "roughness " << roughness;
}

// Fresnel's reflectance for light that goes from index n1 to n2.
double fresnel(double n1, double n2, double cos1) {
    const double sin2 = n1 / n2 * std::sqrt(1 - cos1 * cos1);
    if (sin2 >= 1) return 1;
    const double cos2 = std::sqrt(1 - sin2 * sin2);
    const double s = (n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2), p = (n1 * cos2 - n2 * cos1) / (n1 * cos2 + n2 * cos1);
    return 0.5 * (s * s + p * p);
}

// What a clear rough boundary shows of radiance 1 on both of its sides: reflection and transmission of its microfacets minus
// masking, in double precision over the visible microfacets. Radiance from index n2 to n1 changes by (n1 / n2)^2. n2 = 0: a
// perfect mirror, or a thin sheet, whose transmission loses as much as its reflection.
double boundary_radiance(double alpha, double cos_view, double n1, double n2) {
    constexpr int rows = 500, columns = 500;
    const Vec3d wo{std::sqrt(1 - cos_view * cos_view), 0, cos_view};
    const auto unmasked = [&](double cos) { return 2 * cos / (cos + std::sqrt(alpha * alpha + (1 - alpha * alpha) * cos * cos)); };
    double sum = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            // The fraction q^2 of all microfacets is steeper than this.
            const double q = (i + 0.5) / rows, phi = pi * (j + 0.5) / columns;
            const double tan = alpha * std::sqrt(1 - q * q) / q, z = 1 / std::sqrt(1 + tan * tan);
            const Vec3d h{tan * z * std::cos(phi), tan * z * std::sin(phi), z};
            const double c = dot(wo, h);
            if (c <= 0) continue;
            const double reflectance = n2 > 0 ? fresnel(n1, n2, c) : 1, up = 2 * c * h.z - wo.z;
            double radiance = up > 0 ? reflectance * unmasked(up) : 0;
            if (reflectance < 1) {
                const double eta = n2 / n1, down = (std::sqrt(1 - (1 - c * c) / (eta * eta)) - c / eta) * h.z + wo.z / eta;
                if (down > 0) radiance += (1 - reflectance) * unmasked(down) / (eta * eta);
            }
            sum += 2 * q * c / h.z * radiance;
        }
    return sum * unmasked(cos_view) / cos_view / (rows * columns);
}

TEST(Furnace, RoughBoundariesShowTheIntegralOfTheirFormula) {
    struct Case {
        const char* name;
        Material (*material)(float roughness);
        double n1, n2;
    };
    const auto thin_glass = [](float roughness) {
        Material m = glass(roughness, 1.5f);
        m.thickness = 0;
        return m;
    };
    const std::vector<Case> cases = {{"metal", metal, 1, 0},
                                     {"thin glass", thin_glass, 1, 0},
                                     {"into glass", [](float roughness) { return glass(roughness, 1.5f); }, 1, 1.5},
                                     {"out of glass", [](float roughness) { return glass(roughness, 1.5f); }, 1.5, 1}};
    constexpr float roughnesses[] = {0.3f, 0.6f, 1};
    constexpr double angles[] = {0, 40, 70};
    const auto count = int64_t(cases.size() * std::size(roughnesses) * std::size(angles));
    for (const Case& c : cases)
        for (const float roughness : roughnesses)
            for (const double degrees : angles) {
                const double expected = boundary_radiance(double(roughness) * roughness, std::cos(degrees * pi / 180), c.n1, c.n2);
                EXPECT_TRUE(is_mean(plane(c.material(roughness), degrees, c.n1 > c.n2 && c.n2 > 0), expected, sidak(significance, count)))
                    << c.name << ", roughness " << roughness << " at " << degrees << " degrees";
            }
}

// glTF 2.0 Appendix B for a white dielectric of ior 1.5, in double precision, over all directions of light.
double plastic_albedo(double alpha, double cos_view) {
    constexpr int rows = 400, columns = 400;
    const Vec3d wo{std::sqrt(1 - cos_view * cos_view), 0, cos_view};
    const auto visibility = [&](double cos) { return 1 / (cos + std::sqrt(alpha * alpha + (1 - alpha * alpha) * cos * cos)); };
    double sum = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double z = (i + 0.5) / rows, phi = pi * (j + 0.5) / columns, s = std::sqrt(1 - z * z);
            const Vec3d wi{s * std::cos(phi), s * std::sin(phi), z}, h = normalize(wo + wi);
            const double fresnel = 0.04 + 0.96 * std::pow(1 - dot(wo, h), 5);
            const double k = h.z * h.z * (alpha * alpha - 1) + 1;
            const double facets = alpha * alpha / (pi * k * k) * visibility(cos_view) * visibility(z);
            sum += ((1 - fresnel) / pi + fresnel * facets) * z;
        }
    return sum * 2 * pi / (rows * columns);
}

TEST(Furnace, PlasticReflectsTheIntegralOfItsFormula) {
    constexpr int count = 9;
    for (const float roughness : {0.4f, 0.7f, 1.f})
        for (const double degrees : {0.0, 40.0, 70.0}) {
            const double expected = plastic_albedo(double(roughness) * roughness, std::cos(degrees * pi / 180));
            EXPECT_TRUE(is_mean(plane(plastic(roughness), degrees), expected, sidak(significance, count)))
                << "roughness " << roughness << " at " << degrees << " degrees";
        }
}

} // namespace
} // namespace blush::test::TEST_FILE
