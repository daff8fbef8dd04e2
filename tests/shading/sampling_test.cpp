// sample, pdf and eval of every material agree, from every angle.
#include "tests/shading/reference.h"
#include "tests/support/statistics.h"

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

// From some view directions a lobe (alpha wide in one direction, alpha cos in the other) is narrower than the spacing of single-precision
// directions. Then only its facet normals can be tested: see FacetsFollowTheVisibleNormals.
bool is_resolved(const Params& p, const Vec3& wo) {
    const auto resolved = [&](float roughness) {
        return roughness < smooth_roughness || roughness * roughness * std::abs(wo.z) > 16 * 0x1p-24f;
    };
    return resolved(p.roughness) && (p.layers.clearcoat == 0 || resolved(p.layers.clearcoat_roughness));
}

} // namespace

TEST(Sampling, DirectionsFollowThePdf) {
    const std::vector<Material> all = all_materials();
    int64_t tests = 0;
    for (const Material& m : all) tests += int64_t(viewers(m.params).size());
    Random random(1);
    for (const Material& m : all)
        for (const Viewer& v : viewers(m.params)) {
            const Vec3 wo = v.wo();
            if (!is_resolved(m.params, wo)) continue;
            const Bsdf<float> b = make_bsdf<all_features>(m.params, wo, nullptr);
            const auto draw = [&]() -> std::optional<Vec3> {
                const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
                return s.valid && !s.delta ? std::optional(s.wi) : std::nullopt;
            };
            const auto pdf = [&](const Vec3& wi) { return eval<all_features>(b, wo, wi).pdf; };
            const DirectionTest test{.charts = reference::facet_charts(m.params, wo),
                                     .rows = 16,
                                     .columns = 12,
                                     .points = 8,
                                     .samples = 30'000,
                                     .alpha = sidak(significance, tests)};
            EXPECT_TRUE(directions_follow(test, draw, pdf)) << describe(m, v);
        }
}

// Facet normals of all rough cases against the distribution of visible normals in double precision (Heitz 2014, "Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs"). They are near z, so that rounding does not matter.
TEST(Sampling, FacetsFollowTheVisibleNormals) {
    const std::vector<Viewer> all = viewers(metal(0));
    const auto tests = int64_t(roughnesses.size() * all.size());
    Random random(5);
    for (const float roughness : roughnesses)
        for (const Viewer& v : all) {
            const Vec3 wo = v.wo();
            const float alpha = roughness * roughness;
            const auto draw = [&]() -> std::optional<Vec3> {
                const float a = random(), b = random();
                return sample_visible_normal(alpha, wo, a, b);
            };
            const auto pdf = [&](const Vec3& h) {
                const double k = reference::sqr(h.x) + reference::sqr(h.y) + reference::sqr(alpha * double(h.z));
                const double facets = reference::sqr(alpha) / (reference::pi * k * k);
                return reference::masking(alpha, wo.z) * facets * std::max(0.0, dot(reference::to_double(wo), reference::to_double(h))) /
                       wo.z;
            };
            const DirectionTest test{.charts = {reference::facet_normals_chart(alpha)},
                                     .rows = 16,
                                     .columns = 12,
                                     .points = 8,
                                     .samples = 30'000,
                                     .alpha = sidak(significance, tests)};
            EXPECT_TRUE(directions_follow(test, draw, pdf)) << "roughness " << roughness << " at " << v.degrees << " degrees";
        }
}

TEST(Sampling, StretchedFacetsFollowTheVisibleNormals) {
    struct Facets {
        float x, y; // alphas
    };
    const std::vector<Facets> all = {{0.3f, 0.04f}, {0.4f, 0.1f}, {1, 0.25f}, {0.1f, 0.5f}};
    const std::vector<Viewer> from = viewers(metal(0));
    const auto tests = int64_t(all.size() * from.size());
    Random random(6);
    for (const Facets& alpha : all)
        for (const Viewer& v : from) {
            const Vec3 wo = v.wo();
            const Stretch<float> stretch = make_stretch(alpha.x, alpha.y);
            const auto draw = [&]() -> std::optional<Vec3> {
                const float a = random(), b = random();
                return sample_visible_normal(stretch, wo, a, b);
            };
            const auto pdf = [&](const Vec3& h) {
                return reference::masking(alpha.x, alpha.y, reference::to_double(wo)) *
                       reference::distribution(alpha.x, alpha.y, reference::to_double(h)) *
                       std::max(0.0, dot(reference::to_double(wo), reference::to_double(h))) / wo.z;
            };
            const DirectionTest test{.charts = {reference::facet_normals_chart(std::min(alpha.x, alpha.y))},
                                     .rows = 16,
                                     .columns = 12,
                                     .points = 16,
                                     .samples = 30'000,
                                     .alpha = sidak(significance, tests)};
            EXPECT_TRUE(directions_follow(test, draw, pdf)) << alpha.x << " by " << alpha.y << " at " << v.degrees << " degrees";
        }
}

TEST(Sampling, WeightIsEvalOverPdfAndBounded) {
    Random random(2);
    for (const Material& m : all_materials())
        for (const Viewer& v : viewers(m.params)) {
            SCOPED_TRACE(describe(m, v));
            const Vec3 wo = v.wo();
            const Bsdf<float> b = make_bsdf<all_features>(m.params, wo, nullptr);
            // Each lobe and each layer gets at least a tenth of the samples in proportion to its light. Refraction may concentrate
            // radiance.
            const float parts = (b.coat.probability > 0 ? 10.f : 1.f) * (b.sheen.probability > 0 ? 10.f : 1.f);
            const float limit = 10 * parts * max(1.f, b.radiance_scale) * (1 + 1e-5f);
            for (int i = 0; i < 2000; ++i) {
                const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
                ASSERT_TRUE(is_finite(s.weight) && is_finite(s.pdf) && s.pdf >= 0);
                ASSERT_TRUE(s.weight.x >= 0 && s.weight.y >= 0 && s.weight.z >= 0);
                ASSERT_LE(max_component(s.weight), limit);
                if (!s.valid) {
                    ASSERT_EQ(max_component(s.weight), 0.f);
                    continue;
                }
                ASSERT_NEAR(length(s.wi), 1, 4e-6);
                ASSERT_GT(s.pdf, 0.f);
                if (s.delta) continue;
                const BsdfValue<float> value = eval<all_features>(b, wo, s.wi);
                ASSERT_EQ(value.pdf, s.pdf);
                for (const auto component : {&Vec3::x, &Vec3::y, &Vec3::z})
                    ASSERT_NEAR(s.weight.*component * s.pdf, value.f_cos.*component, 1e-6 * value.f_cos.*component);
            }
        }
}

// Its mean over samples is the probability of the lobes that it counts, as those that it does not count have no invalid samples.
TEST(Sampling, FacetShareIsThatOfTheLobesThatAreNotWide) {
    Random random(7);
    const std::vector<Material> all = all_materials();
    int64_t tests = 0;
    for (const Material& m : all) tests += int64_t(viewers(m.params).size());
    for (const Material& m : all)
        for (const Viewer& v : viewers(m.params)) {
            const Vec3 wo = v.wo();
            if (!is_resolved(m.params, wo)) continue;
            const Bsdf<float> b = make_bsdf<all_features>(m.params, wo, nullptr);
            const Moments shares = estimate(10'000, [&] {
                const BsdfSample<float> s = sample_next<all_features>(b, wo, random);
                return s.valid && !s.delta ? facet_share<all_features>(b, s.wi, s.pdf) : 1.f;
            });
            const double wide = double(b.p_base) * double(b.p_diffuse) + double(b.sheen.probability);
            EXPECT_TRUE(z_test_in_range(shares, 0, 1, 1 - wide, sidak(significance, tests))) << describe(m, v);
        }
}

// For all light directions, including exactly grazing and exactly backward ones.
TEST(Sampling, EvalIsFiniteAndNotNegative) {
    Random random(3);
    for (const Material& m : all_materials())
        for (const Viewer& v : viewers(m.params)) {
            SCOPED_TRACE(describe(m, v));
            const Vec3 wo = v.wo();
            const Bsdf<float> b = make_bsdf<all_features>(m.params, wo, nullptr);
            std::vector<Vec3> directions = {wo,         -wo,       {-wo.x, -wo.y, wo.z}, {wo.x, wo.y, -wo.z}, {0, 0, 1},
                                            {0, 0, -1}, {1, 0, 0}, {-1, 0, 0.f},         {0, 1, -0.f}};
            for (int i = 0; i < 1000; ++i) directions.push_back(random.direction());
            for (int i = 0; i < 200; ++i)
                directions.push_back(normalize(Vec3{random() - 0.5f, random() - 0.5f, (random() - 0.5f) * 1e-6f}));
            for (const Vec3& wi : directions) {
                const BsdfValue<float> value = eval<all_features>(b, wo, wi);
                ASSERT_TRUE(is_finite(value.f_cos) && is_finite(value.pdf)) << wi.x << ", " << wi.y << ", " << wi.z;
                ASSERT_TRUE(value.f_cos.x >= 0 && value.f_cos.y >= 0 && value.f_cos.z >= 0 && value.pdf >= 0);
                ASSERT_TRUE(value.pdf > 0 || value.f_cos.x == 0)
                    << "light from " << wi.x << ", " << wi.y << ", " << wi.z << " is never sampled";
                ASSERT_TRUE(!is_delta_only(b) || (value.f_cos.x == 0 && value.pdf == 0));
            }
        }
}

// Unusual parameters and view directions, which textures and interpolated normals produce.
TEST(Sampling, ExtremeParametersNeverMakeNaN) {
    Random random(4);
    const EnergyTable energy = make_energy_table();
    const auto pick = [&](std::initializer_list<float> values) {
        const size_t i = random.bits() % (values.size() + 1);
        return i < values.size() ? values.begin()[i] : random();
    };
    for (int i = 0; i < 300'000; ++i) {
        Params p;
        p.base_color = {pick({0, 1}), pick({0, 1}), pick({0, 1})};
        p.metallic = pick({0, 1, 1e-7f});
        p.roughness = pick({0, 1, 0.00999f, 0.01f, 0.0101f});
        p.ior = pick({0, 1, 1.0000001f, 1.00001f, 1.5f, 100, 1e6f});
        if (p.ior < 1 && p.ior > 0) p.ior += 1;
        p.specular = pick({0, 1, 1e-7f});
        p.specular_color = {pick({0, 1, 1e6f}), pick({0, 1}), pick({0, 1})};
        p.transmission = pick({0, 1, 1e-7f});
        p.thin = random() < 0.5f;
        p.layers.clearcoat = pick({0, 0, 1, 1e-7f});
        p.layers.clearcoat_roughness = pick({0, 1, 0.01f});
        p.layers.clearcoat_normal = random.direction();
        p.layers.sheen_color = {pick({0, 1}), pick({0, 0, 1}), 0};
        p.layers.sheen_roughness = pick({0, 1});
        p.layers.anisotropy = pick({0, 0, 1, 1e-7f});
        p.layers.iridescence = pick({0, 0, 1});
        p.layers.film_ior = 1 + pick({0, 1, 999});
        p.layers.film_thickness = 1e6f * pick({0, 1, 1e-3f});
        p.layers.diffuse_transmission = pick({0, 0, 1, 1e-7f});
        p.layers.diffuse_transmission_color = {pick({0, 1}), pick({0, 1}), pick({0, 1})};
        Vec3 wo = random.direction();
        wo.z = pick({std::abs(wo.z), 1e-3f, 1e-6f, 1e-20f, 0});
        wo = normalize(wo);
        if (is_solid(p) && random() < 0.5f) wo.z = -wo.z;
        const Bsdf<float> b = make_bsdf<all_features>(p, wo, random() < 0.5f ? &energy : nullptr);
        const BsdfSample<float> s =
            sample<all_features>(b, wo, pick({0, one_minus_epsilon}), pick({0, one_minus_epsilon}), pick({0, one_minus_epsilon}));
        ASSERT_TRUE(is_finite(s.weight) && is_finite(s.pdf) && is_finite(albedo<all_features>(b, wo)));
        ASSERT_TRUE(s.weight.x >= 0 && s.weight.y >= 0 && s.weight.z >= 0);
        ASSERT_TRUE(!s.valid || (is_finite(s.wi) && std::abs(length(s.wi) - 1) < 1e-5f));
        const BsdfValue<float> value = eval<all_features>(b, wo, random.direction());
        ASSERT_TRUE(is_finite(value.f_cos) && is_finite(value.pdf));
    }
}

} // namespace blush::TEST_FILE
