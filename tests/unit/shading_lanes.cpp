// The same bits whatever shades them: any superset of the features a material needs, one path or a register of them.
#include "shading_materials.h"

#include <gtest/gtest.h>

using namespace blush;

namespace {

constexpr Features specular = no_features.with(Feature::specular);
constexpr Features transmission = no_features.with(Feature::transmission);
constexpr Features both = specular.with(Feature::transmission);

struct Outputs {
    BsdfValue<float> value;
    BsdfSample<float> sample;
    bool delta_only;
    Vec3 albedo;
};
template <Features S> Outputs shade(const Params& p, const Vec3& wo, const Vec3& wi, const Vec3& u, const EnergyTable* energy) {
    const Bsdf<float> b = make_bsdf<S>(p, wo, energy);
    return {eval<S>(b, wo, wi), sample<S>(b, wo, u.x, u.y, u.z), is_delta_only(b), albedo<S>(b, wo)};
}

template <class F> std::vector<F> numbers(const BsdfValue<F>& v, const BsdfSample<F>& s, const Vec<F>& albedo) {
    return {v.f_cos.x,  v.f_cos.y,  v.f_cos.z,  v.pdf, s.wi.x,   s.wi.y,   s.wi.z,
            s.weight.x, s.weight.y, s.weight.z, s.pdf, albedo.x, albedo.y, albedo.z};
}

testing::AssertionResult same_bits(const Outputs& a, const Outputs& b) {
    if (a.sample.delta != b.sample.delta || a.sample.valid != b.sample.valid || a.delta_only != b.delta_only)
        return testing::AssertionFailure() << "flags differ";
    const std::vector<float> x = numbers(a.value, a.sample, a.albedo), y = numbers(b.value, b.sample, b.albedo);
    for (size_t i = 0; i < x.size(); ++i)
        if (float_bits(x[i]) != float_bits(y[i]))
            return testing::AssertionFailure() << "output " << i << ": " << x[i] << " is not " << y[i];
    return testing::AssertionSuccess();
}

struct Point {
    Vec3 wo, wi, u;
};
Point random_point(Random& random) {
    Point p{random.direction(), random.direction(), {random(), random(), random()}};
    p.wo.z = std::abs(p.wo.z);
    return p;
}

float often(Random& random, float value) { return random() < 0.3f ? value : random(); }
Params random_params(Random& random) {
    Params p;
    p.base_color = {random(), random(), often(random, 0)};
    p.metallic = often(random, 0);
    p.roughness = often(random, 0);
    p.ior = 1 + often(random, 0);
    p.specular = often(random, 0);
    p.specular_color = {2 * random(), random(), often(random, 1)};
    p.transmission = often(random, 0);
    p.thin = random() < 0.5f;
    return p;
}

} // namespace

TEST(Features, LambertianIsTheSameUnderAll) {
    Random random(1);
    for (int i = 0; i < 50'000; ++i) {
        Params p = lambert({random(), random(), often(random, 0)});
        if (i % 10 == 0) p.base_color = {0, 0, 0};
        p.roughness = often(random, 0);
        const Point at = random_point(random);
        const Outputs smallest = shade<no_features>(p, at.wo, at.wi, at.u, nullptr);
        ASSERT_TRUE(same_bits(smallest, shade<specular>(p, at.wo, at.wi, at.u, nullptr)));
        ASSERT_TRUE(same_bits(smallest, shade<transmission>(p, at.wo, at.wi, at.u, nullptr)));
        ASSERT_TRUE(same_bits(smallest, shade<all_features>(p, at.wo, at.wi, at.u, nullptr)));
    }
}

TEST(Features, OpaqueIsTheSameUnderAllThatReflect) {
    Random random(2);
    const EnergyTable energy = make_energy_table();
    for (int i = 0; i < 50'000; ++i) {
        Params p = random_params(random);
        p.transmission = 0;
        const Point at = random_point(random);
        const Outputs smallest = shade<specular>(p, at.wo, at.wi, at.u, nullptr);
        ASSERT_TRUE(same_bits(smallest, shade<both>(p, at.wo, at.wi, at.u, nullptr)));
        ASSERT_TRUE(same_bits(smallest, shade<all_features>(p, at.wo, at.wi, at.u, nullptr)));
        const Outputs compensated = shade<specular.with(Feature::energy_compensation)>(p, at.wo, at.wi, at.u, &energy);
        ASSERT_TRUE(same_bits(compensated, shade<all_features>(p, at.wo, at.wi, at.u, &energy)));
    }
}

TEST(Features, TransmittingIsTheSameUnderAllThatTransmit) {
    Random random(3);
    for (int i = 0; i < 50'000; ++i) {
        const Params p = random_params(random);
        Point at = random_point(random);
        if (is_solid(p) && i % 2) at.wo.z = -at.wo.z;
        ASSERT_TRUE(same_bits(shade<transmission>(p, at.wo, at.wi, at.u, nullptr), shade<all_features>(p, at.wo, at.wi, at.u, nullptr)));
    }
}

template <Features S> void expect_lanes_equal_one_path(const EnergyTable* energy) {
    constexpr int n = width<Wide>;
    Random random(4);
    for (int round = 0; round < 10'000; ++round) {
        float numbers_of[20][n];
        Params params[n];
        Point points[n];
        for (int i = 0; i < n; ++i) {
            const Params p = params[i] = random_params(random);
            Point& at = points[i] = random_point(random);
            if (is_solid(p) && random() < 0.5f) at.wo.z = -at.wo.z;
            const float values[20] = {p.base_color.x,
                                      p.base_color.y,
                                      p.base_color.z,
                                      p.metallic,
                                      p.roughness,
                                      p.ior,
                                      p.specular,
                                      p.specular_color.x,
                                      p.specular_color.y,
                                      p.specular_color.z,
                                      p.transmission,
                                      at.wo.x,
                                      at.wo.y,
                                      at.wo.z,
                                      at.wi.x,
                                      at.wi.y,
                                      at.wi.z,
                                      at.u.x,
                                      at.u.y,
                                      at.u.z};
            for (int k = 0; k < 20; ++k) numbers_of[k][i] = values[k];
        }
        const auto in = [&](int k) { return load<Wide>(numbers_of[k]); };
        const auto vec = [&](int k) { return Vec<Wide>{in(k), in(k + 1), in(k + 2)}; };
        float thin[n];
        for (int i = 0; i < n; ++i) thin[i] = params[i].thin;
        const BsdfParams<Wide> p{vec(0), in(3), in(4), in(5), in(6), vec(7), in(10), load<Wide>(thin) > 0.5f};
        const Vec<Wide> wo = vec(11);
        const Bsdf<Wide> b = make_bsdf<S>(p, wo, energy);
        const BsdfSample<Wide> s = sample<S>(b, wo, in(17), in(18), in(19));
        const BsdfValue<Wide> v = eval<S>(b, wo, vec(14));
        const std::vector<Wide> wide = numbers(v, s, albedo<S>(b, wo));
        for (int i = 0; i < n; ++i) {
            const Outputs one = shade<S>(params[i], points[i].wo, points[i].wi, points[i].u, energy);
            const std::vector<float> expected = numbers(one.value, one.sample, one.albedo);
            for (size_t k = 0; k < expected.size(); ++k) ASSERT_EQ(float_bits(expected[k]), float_bits(lane(wide[k], i))) << "output " << k;
            ASSERT_EQ(one.sample.delta, bool(bits(s.delta) >> i & 1));
            ASSERT_EQ(one.sample.valid, bool(bits(s.valid) >> i & 1));
            ASSERT_EQ(one.delta_only, bool(bits(is_delta_only(b)) >> i & 1));
        }
    }
}

TEST(Lanes, EqualOnePathBitForBit) {
    const EnergyTable energy = make_energy_table();
    expect_lanes_equal_one_path<no_features>(nullptr);
    expect_lanes_equal_one_path<specular>(nullptr);
    expect_lanes_equal_one_path<both>(nullptr);
    expect_lanes_equal_one_path<all_features>(nullptr);
    expect_lanes_equal_one_path<all_features>(&energy);
}
