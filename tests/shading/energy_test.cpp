// Energy conservation: white furnaces, the table of microfacet energy loss, and its compensation.
#include "tests/shading/reference.h"
#include "tests/support/statistics.h"

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

constexpr int64_t samples = 20'000;

// Radiance of a surface in a furnace, divided by the furnace's radiance on the viewer's side. In equilibrium the radiance in a medium of
// index n is n^2, which cancels the scale of refraction.
Moments furnace(const Params& p, const Viewer& v, uint32_t seed, const EnergyTable* energy = nullptr) {
    Random random(seed);
    const Vec3 wo = v.wo();
    const Bsdf<float> b = make_bsdf<all_features>(p, wo, energy);
    return estimate(samples, [&] {
        const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
        const bool crossed = s.wi.z * wo.z < 0;
        return s.weight.y * (crossed ? 1 / b.radiance_scale : 1.f);
    });
}

} // namespace

TEST(Furnace, WhiteSurfacesThatLoseNothingAreInvisible) {
    const std::vector<Material> all = {{"lambert", lambert()},
                                       {"mirror", metal(0)},
                                       {"smooth thin glass", thin_glass(0)},
                                       {"smooth glass", glass(0, 1.5f)},
                                       {"smooth diamond", glass(0, 2.42f)},
                                       {"nothing", glass(0.5f, 1)},
                                       {"mirror by ior 0", glass(0, 0)},
                                       {"lacquered lambert", coated(lambert(), 0)},
                                       {"half-coated mirror", coated(metal(0), 0, 0.5f)},
                                       {"coated glass", coated(glass(0, 1.5f), 0)},
                                       {"white paper", translucent(lambert(), 0.3f)},
                                       {"white body without a surface", solid(translucent(lambert(), 0.7f))}};
    for (const Material& m : all)
        for (const Viewer& v : viewers(m.params))
            EXPECT_TRUE(z_test(furnace(m.params, v, 1), 1, sidak(significance, 90))) << describe(m, v);
}

TEST(Furnace, RoughMetalLosesMaskedEnergy) {
    for (const float roughness : roughnesses)
        for (const Viewer& v : viewers(metal(roughness))) {
            const double expected = reference::mirror_albedo(reference::sqr(roughness), v.wo().z);
            EXPECT_TRUE(z_test_in_range(furnace(metal(roughness), v, 2), 0, 1, expected, sidak(significance, 30)))
                << "roughness " << roughness << ", " << v.degrees << " degrees";
        }
}

TEST(Furnace, RoughGlassNeverGains) {
    for (const float roughness : roughnesses)
        for (const Material& m : {Material{"thin", thin_glass(roughness)},
                                  {"almost air", glass(roughness, 1.0001f)},
                                  {"glass", glass(roughness, 1.5f)},
                                  {"diamond", glass(roughness, 2.5f)}})
            for (const Viewer& v : viewers(m.params))
                EXPECT_TRUE(z_test_at_most(furnace(m.params, v, 3), 1, sidak(significance, 210)))
                    << "roughness " << roughness << ", " << describe(m, v);
}

TEST(Furnace, FilmsStretchesAndSheenNeverGain) {
    for (const float roughness : layer_roughnesses)
        for (const Material& m : {Material{"velvet", with_sheen(lambert(), roughness)},
                                  {"dusty coated mirror", with_sheen(coated(metal(roughness), roughness), roughness, {0.5f, 0.5f, 0.5f})},
                                  {"brushed metal", stretched(metal(roughness), 0.7f)},
                                  {"brushed glass", stretched(glass(roughness, 1.5f), 0.5f)},
                                  {"tempered metal", under_film(metal(roughness), 300, 1.9f)},
                                  {"bubble", under_film(thin_glass(roughness), 300)}})
            for (const Viewer& v : viewers(m.params))
                EXPECT_TRUE(z_test_at_most(furnace(m.params, v, 12), 1, sidak(significance, 210)))
                    << "roughness " << roughness << ", " << describe(m, v);
}

TEST(Furnace, CoatsNeverGain) {
    for (const float roughness : layer_roughnesses)
        for (const Material& m : {Material{"coated lambert", coated(lambert(), roughness)},
                                  {"half-coated metal", coated(metal(roughness), 0.3f, 0.5f)},
                                  {"coated glass", coated(glass(0.3f, 1.5f), roughness)}})
            for (const Viewer& v : viewers(m.params))
                EXPECT_TRUE(z_test_at_most(furnace(m.params, v, 9), 1, sidak(significance, 120)))
                    << "roughness " << roughness << ", " << describe(m, v);
}

// Energy compensation of the coat: adds the light of multiple scattering in the coat; the base reflects the rest.
TEST(Energy, CompensatedCoatsOnWhiteLoseNothing) {
    const EnergyTable table = make_energy_table();
    for (const float roughness : roughnesses)
        for (const Viewer& v : viewers(lambert())) {
            const Params p = coated(lambert(), roughness);
            const float cos = v.wo().z, scale = 1 / directional_albedo(table, roughness, cos);
            const double reflected = clearcoat_reflectance(1.f, cos);
            const double expected = 1 - reflected + reflected * scale * reference::mirror_albedo(reference::sqr(roughness), cos);
            EXPECT_NEAR(expected, 1, 2 * EnergyTable::relative_error);
            EXPECT_TRUE(z_test(furnace(p, v, 10, &table), expected, sidak(significance, 30)))
                << "roughness " << roughness << ", " << v.degrees;
        }
}

// The refraction is too weak to resolve: transmitted light goes straight on, independent of facets. The Fresnel term of the smooth surface
// then determines its share.
TEST(Furnace, AlmostAirReflectsLikeItsSurfaceAndPassesTheRest) {
    const float ior = 1.0001f; // from inside, 89.9 degrees are beyond the critical angle, but not for all facets
    for (const float roughness : {0.05f, 0.2f})
        for (const Viewer& v : viewers(glass(roughness, ior))) {
            const double cos = std::abs(v.wo().z), reflected = v.inside ? reference::fresnel(ior, 1, cos) : reference::fresnel(1, ior, cos);
            const double masked = 1 - reference::mirror_albedo(reference::sqr(roughness), cos);
            EXPECT_TRUE(z_test_in_range(furnace(glass(roughness, ior), v, 8), 0, 1, 1 - reflected * masked, sidak(significance, 24)))
                << "roughness " << roughness << ", " << v.degrees << (v.inside ? " degrees inside" : " degrees");
        }
}

double integrate_reference(const Params& p, const Vec3& wo) {
    double sum = 0;
    for (const Chart& chart : reference::facet_charts(p, wo))
        for (const double cell :
             integrate_cells(chart, 1, 1, 200, [&](const Vec3d& wi) { return reference::f_cos(p, reference::to_double(wo), wi).y; }))
            sum += cell;
    return sum;
}

// fresnel_mix of Appendix B weights the base by the half vector of light and viewer, so that a white plastic may gain energy at grazing
// angles. The test requires the integral of that formula.
TEST(Furnace, LayeredMaterialsReturnTheIntegralOfTheirFormula) {
    Random random(4);
    for (const float roughness : {0.2f, 0.5f, 1.f})
        for (const Material& m : {Material{"plastic", plastic(roughness)},
                                  {"half metal", half_metal(roughness)},
                                  {"clear", thin_glass(roughness, 0.5f)},
                                  {"velvet", with_sheen(plastic(roughness), roughness)},
                                  {"oily", under_film(plastic(roughness), 350)},
                                  {"leaf", translucent(plastic(roughness), 0.5f)},
                                  {"wax", solid(translucent(plastic(roughness), 0.5f))},
                                  {"solid", glass(roughness, 1.5f, 0.5f)}})
            for (const Viewer& v : viewers(m.params)) {
                const Vec3 wo = v.wo();
                const Bsdf<float> b = make_bsdf<all_features>(m.params, wo, nullptr);
                const Moments sampled = estimate(samples, [&] { return sample_next<all_features>(b, wo, random).weight.y; });
                EXPECT_TRUE(z_test(sampled, integrate_reference(m.params, wo), sidak(significance, 200)))
                    << "roughness " << roughness << ", " << describe(m, v);
            }
}

TEST(Energy, TableHoldsTheIntegralWithinItsStatedError) {
    const EnergyTable table = make_energy_table();
    double worst = 0;
    for (const double roughness : {0.01, 0.04, 0.1, 0.18, 0.3, 0.43, 0.57, 0.69, 0.81, 0.93, 1.0})
        for (const double cos : {1e-4, 1e-3, 0.004, 0.013, 0.05, 0.11, 0.2, 0.35, 0.6, 0.85, 1.0}) {
            const double exact = reference::mirror_albedo(reference::sqr(roughness), cos);
            const double error = std::abs(directional_albedo(table, float(roughness), float(cos)) / exact - 1);
            EXPECT_LE(error, EnergyTable::relative_error) << "roughness " << roughness << ", cos " << cos;
            worst = std::max(worst, error);
        }
    RecordProperty("worst", std::to_string(worst));
}

TEST(Energy, SheenTableHoldsTheIntegralWithinItsStatedError) {
    double worst = 0;
    for (const double roughness : {0.07, 0.085, 0.13, 0.22, 0.37, 0.52, 0.71, 0.88, 1.0})
        for (const double cos : {0.001, 0.0023, 0.011, 0.04, 0.09, 0.21, 0.43, 0.7, 1.0}) {
            const double exact = reference::charlie_albedo(reference::sqr(roughness), cos);
            worst =
                std::max(worst, std::abs(double(sheen_albedo(sheen_table(), float(roughness), float(cos))) - exact) / std::max(1.0, exact));
        }
    EXPECT_LE(worst, SheenTable::error);
    RecordProperty("worst", std::to_string(worst));
}

TEST(Energy, CompensatedWhiteMetalLosesNothing) {
    const EnergyTable table = make_energy_table();
    for (const float roughness : roughnesses)
        for (const Viewer& v : viewers(metal(roughness))) {
            const Vec3 wo = v.wo();
            // The known remaining error is that of the table.
            const double scale = 1 / directional_albedo(table, roughness, wo.z);
            const double expected = reference::mirror_albedo(reference::sqr(roughness), wo.z) * scale;
            EXPECT_NEAR(expected, 1, 2 * EnergyTable::relative_error);
            EXPECT_TRUE(z_test_in_range(furnace(metal(roughness), v, 5, &table), 0, scale, expected, sidak(significance, 30)))
                << "roughness " << roughness << ", " << v.degrees << " degrees";
        }
}

TEST(Energy, CompensationLeavesTheSmoothAndTheDiffuseAlone) {
    const EnergyTable table = make_energy_table();
    Random random(6);
    for (const Params& p : {lambert({0.3f, 0.6f, 0.9f}), metal(0), plastic(0), glass(0, 1.5f)}) {
        const Vec3 wo = Viewer{50, false}.wo();
        const Bsdf<float> with = make_bsdf<all_features>(p, wo, &table), without = make_bsdf<all_features>(p, wo, nullptr);
        for (int i = 0; i < 1000; ++i) {
            const float u = random(), v = random(), choice = random();
            EXPECT_EQ(sample<all_features>(with, wo, u, v, choice).weight, sample<all_features>(without, wo, u, v, choice).weight);
        }
    }
}

// The albedo for the denoiser is approximate, but exact in simple cases.
TEST(Albedo, IsTheColorOfSimpleMaterials) {
    const Vec3 wo = Viewer{30, false}.wo(), color{0.8f, 0.5f, 0.1f};
    const auto of = [&](const Params& p) { return albedo<all_features>(make_bsdf<all_features>(p, wo, nullptr), wo); };
    EXPECT_EQ(of(lambert(color)), color);
    for (const Params& p : {metal(0.5f), thin_glass(0.3f), glass(0.2f, 1), glass(0, 0)}) EXPECT_LT(length(of(p) - Vec3{1, 1, 1}), 1e-6f);
    Random random(7);
    for (const Material& m : materials())
        for (const Viewer& v : viewers(m.params)) {
            const Vec3 a = albedo<all_features>(make_bsdf<all_features>(m.params, v.wo(), nullptr), v.wo());
            EXPECT_TRUE(a.x >= 0 && a.x <= 1 && a.y >= 0 && a.y <= 1 && a.z >= 0 && a.z <= 1) << describe(m, v);
        }
}

} // namespace blush::TEST_FILE
