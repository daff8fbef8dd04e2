// Material model against the formulas of the specification in double precision, and known results of optics.
#include "tests/shading/reference.h"
#include "tests/support/statistics.h"

namespace blush::TEST_FILE {

using namespace statistics;

TEST(Model, IsTheSpecification) {
    Random random(1);
    std::vector<Material> all;
    for (const float r : {0.1f, 0.3f, 0.6f, 1.f}) {
        const Params tinted{{0.2f, 0.5f, 0.9f}, 0.3f, r, 1.7f, 0.6f, {0.5f, 1, 30}, 0.4f, true};
        Params solid = tinted;
        solid.thin = false;
        all.insert(all.end(), {{"plastic", plastic(r, {0.8f, 0.5f, 0.1f})},
                               {"metal", metal(r, {0.9f, 0.7f, 0.4f})},
                               {"half metal", half_metal(r)},
                               {"thin glass", thin_glass(r)},
                               {"thin mixture", tinted},
                               {"glass", glass(r, 1.5f)},
                               {"diamond", glass(r, 2.42f)},
                               {"solid mixture", solid}});
    }
    all.push_back({"lambert", lambert({0.8f, 0.5f, 0.1f})});
    for (const float r : {0.2f, 0.5f, 1.f})
        for (const Material& m : layered_materials(r)) all.push_back(m);
    for (const float r : {0.3f, 0.7f}) {
        all.push_back({"tilted coat", coated(half_metal(0.5f), r, 0.6f, normalize(Vec3{0.3f, -0.2f, 1}))});
        all.push_back({"tilted coat of glass", coated(glass(0.4f, 1.5f, 0.6f), r, 1, normalize(Vec3{-0.2f, 0.3f, 1}))});
        all.push_back({"milky glass", translucent(glass(r, 1.4f, 0.5f), 0.5f)});
        for (const Params& p : {metal(r, {0.9f, 0.7f, 0.4f}), half_metal(r), thin_glass(r), glass(r, 1.5f)})
            all.push_back({"stretched", stretched(p, 0.6f)});
    }
    for (const Material& m : all)
        for (int i = 0; i < 4000; ++i) {
            Vec3 wo = random.direction();
            if (!is_solid(m.params)) wo.z = std::abs(wo.z);
            const Bsdf<float> b = make_bsdf<all_features>(m.params, wo, nullptr);
            // Half of the directions are sampled from the lobes.
            const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
            const Vec3 wi = i % 2 && s.valid ? s.wi : random.direction();
            if (std::abs(wo.z) < 0.01f || std::abs(wi.z) < 0.01f) continue;
            const Vec3 actual = eval<all_features>(b, wo, wi).f_cos;
            const Vec3d expected = reference::f_cos(m.params, reference::to_double(wo), reference::to_double(wi));
            const double bound = reference::relative_bound(m.params, wo, wi) * reference::largest(expected);
            for (const auto& [a, e] :
                 {std::pair{double(actual.x), expected.x}, {double(actual.y), expected.y}, {double(actual.z), expected.z}})
                ASSERT_NEAR(a, e, bound) << m.name << ", roughness " << m.params.roughness << ", wo.z " << wo.z << ", wi.z " << wi.z;
        }
}

TEST(Model, WorkedExampleOfPlasticAtNormalIncidence) {
    // Roughness 1: D = 1 / pi, G = 1, so the specular lobe is 0.04 / (4 pi); the base keeps 0.96 / pi.
    const Vec3 z{0, 0, 1};
    const BsdfValue<float> value = eval<all_features>(make_bsdf<all_features>(plastic(1, {0.5f, 0.5f, 0.5f}), z, nullptr), z, z);
    EXPECT_NEAR(value.f_cos.x, (0.5 * 0.96 + 0.01) / std::numbers::pi, 1e-7);
}

TEST(Model, FresnelMatchesDoublePrecisionAndKnownAngles) {
    for (const float ior : {1.f, 1.0001f, 1.1f, 1.5f, 2.5f, 10.f})
        for (const bool inside : {false, true})
            for (int i = 1; i <= 1000; ++i) {
                const float c = float(i) / 1000;
                const Interface<float> interface = interface_seen<float>(inside, ior);
                const double exact = inside ? reference::fresnel(ior, 1, c) : reference::fresnel(1, ior, c);
                // Near the critical angle the curve is vertical: compares at the neighbouring cosines.
                const double low = inside ? reference::fresnel(ior, 1, c * (1 + 1e-6)) : exact,
                             high = inside ? reference::fresnel(ior, 1, c * (1 - 1e-6)) : exact;
                const float actual = dielectric_reflectance(interface, c);
                EXPECT_GE(actual, std::min({low, exact, high}) * (1 - float_rounding) - 1e-7)
                    << ior << (inside ? " inside " : " outside ") << c;
                EXPECT_LE(actual, std::max({low, exact, high}) * (1 + float_rounding) + 1e-7)
                    << ior << (inside ? " inside " : " outside ") << c;
            }
    const auto at = [](float ior, bool inside, double degrees) {
        return dielectric_reflectance(interface_seen<float>(inside, ior), float(std::cos(degrees * std::numbers::pi / 180)));
    };
    EXPECT_NEAR(at(1.5f, false, 0), 0.04, 1e-7);
    EXPECT_NEAR(at(1.5f, true, 0), 0.04, 1e-7);
    // Brewster: only s-polarised light is reflected, ((n^2 - 1) / (n^2 + 1))^2 / 2.
    EXPECT_NEAR(at(1.5f, false, std::atan(1.5) * 180 / std::numbers::pi), 0.5 * reference::sqr(1.25 / 3.25), 1e-7);
    EXPECT_EQ(at(1.5f, true, 41.9), 1.f); // critical angle 41.81
    EXPECT_LT(at(1.5f, true, 41.7), 1.f);
    for (const double degrees : {0.0, 45.0, 89.9, 89.9999}) EXPECT_EQ(at(1, false, degrees), 0.f);
}

TEST(Model, SmoothGlassObeysSnellAndFresnel) {
    Random random(4);
    constexpr int samples = 20'000;
    for (const float ior : {1.0001f, 1.33f, 1.5f, 2.5f})
        for (const Viewer& v : viewers(glass(0, ior))) {
            const Vec3 wo = v.wo();
            const Bsdf<float> b = make_bsdf<all_features>(glass(0, ior), wo, nullptr);
            EXPECT_TRUE(is_delta_only(b));
            std::vector<int64_t> counts(2); // refracted, reflected
            for (int i = 0; i < samples; ++i) {
                const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
                ASSERT_TRUE(s.valid && s.delta);
                const bool reflects = s.wi.z * wo.z > 0;
                ++counts[reflects];
                if (reflects) {
                    ASSERT_EQ(s.wi, (Vec3{-wo.x, -wo.y, wo.z}));
                    continue;
                }
                const double eta = v.inside ? 1 / double(ior) : ior; // n_i / n_o
                ASSERT_NEAR(s.wi.x * eta, -wo.x, 4e-7);
                ASSERT_NEAR(s.wi.y * eta, -wo.y, 4e-7);
                ASSERT_NEAR(s.weight.x, 1 / (eta * eta), 1e-5 / (eta * eta));
            }
            const double expected = v.inside ? reference::fresnel(ior, 1, std::abs(wo.z)) : reference::fresnel(1, ior, wo.z);
            EXPECT_TRUE(chi_squared_test(counts, std::vector{samples * (1 - expected), samples * expected}, sidak(significance, 50)))
                << ior << ", " << v.degrees << (v.inside ? " inside" : "");
        }
}

TEST(Model, IndexOneLetsEverythingPassStraight) {
    Random random(5);
    for (const float roughness : {0.f, 0.011f, 0.3f, 1.f})
        for (const Viewer& v : viewers(glass(roughness, 1))) {
            const Vec3 wo = v.wo();
            const Bsdf<float> b = make_bsdf<all_features>(glass(roughness, 1), wo, nullptr);
            for (int i = 0; i < 100; ++i) {
                const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
                ASSERT_TRUE(s.valid && s.delta) << roughness << " at " << v.degrees;
                ASSERT_LT(length(s.wi + wo), 2e-6f);
                ASSERT_EQ(s.weight, (Vec3{1, 1, 1}));
            }
        }
}

TEST(Model, SmoothThinGlassDoesNotBend) {
    Random random(6);
    for (const Viewer& v : viewers(thin_glass(0))) {
        const Vec3 wo = v.wo();
        const Bsdf<float> b = make_bsdf<all_features>(thin_glass(0), wo, nullptr);
        for (int i = 0; i < 1000; ++i) {
            const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
            ASSERT_TRUE(s.valid && s.delta);
            ASSERT_EQ(s.wi, (s.wi.z > 0 ? Vec3{-wo.x, -wo.y, wo.z} : -wo));
        }
    }
}

TEST(Model, IndexZeroReflectsEverything) {
    Random random(7);
    for (const Params& p : {plastic(0, {0.5f, 0.5f, 0.5f}), thin_glass(0), glass(0, 1.5f)}) {
        Params mirror = p;
        mirror.ior = 0;
        const Vec3 wo = Viewer{40, false}.wo();
        const Bsdf<float> b = make_bsdf<all_features>(mirror, wo, nullptr);
        const Moments m = estimate(1000, [&] { return sample_next<all_features>(b, wo, random).weight.y; });
        EXPECT_TRUE(z_test(m, 1));
    }
}

// The narrowest lobe that is not a delta has the same reflectance as the delta lobe, and nearly the same direction.
TEST(Model, NarrowLobesContinueIntoDeltas) {
    Random random(8);
    for (const Params& p : {metal(0.0101f, {0.9f, 0.7f, 0.4f}), thin_glass(0.0101f), glass(0.0101f, 1.5f)}) {
        Params smooth = p;
        smooth.roughness = 0.0099f;
        const Vec3 wo = Viewer{60, false}.wo();
        const Bsdf<float> rough = make_bsdf<all_features>(p, wo, nullptr), limit = make_bsdf<all_features>(smooth, wo, nullptr);
        EXPECT_FALSE(is_delta_only(rough));
        EXPECT_TRUE(is_delta_only(limit));
        Moments up_rough, up_limit;
        int far = 0;
        for (int i = 0; i < 10'000; ++i) {
            const float u = random(), v = random(), choice = random();
            const BsdfSample<float> a = sample<all_features>(rough, wo, u, v, choice), b = sample<all_features>(limit, wo, u, v, choice);
            up_rough.add(a.wi.z > 0 ? a.weight.y : 0);
            up_limit.add(b.wi.z > 0 ? b.weight.y : 0);
            if (a.wi.z * b.wi.z > 0) far += length(a.wi - b.wi) > 100 * p.roughness * p.roughness;
        }
        EXPECT_TRUE(same_mean(up_rough, up_limit));
        EXPECT_LT(far, 100); // beyond 50 alpha of slope GGX has 1 / 2500 of its facets
    }
}

} // namespace blush::TEST_FILE
