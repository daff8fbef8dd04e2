// Bit-identical shading for any superset of the required features, and for one path or a SIMD register.
#include "tests/shading/materials.h"
#include "tests/shading/numbers.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {

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
Params random_layered_params(Random& random) {
    Params p = random_params(random);
    p.layers.clearcoat = often(random, 0);
    p.layers.clearcoat_roughness = often(random, 0);
    p.layers.clearcoat_normal = often(random, 0) == 0 ? Vec3{0, 0, 1} : random.direction();
    if (random() < 0.5f) p.layers.sheen_color = {random(), random(), often(random, 0)};
    p.layers.sheen_roughness = random();
    p.layers.anisotropy = often(random, 0);
    p.layers.iridescence = often(random, 0);
    p.layers.film_ior = 1 + random();
    p.layers.film_thickness = 1000 * often(random, 0);
    p.layers.diffuse_transmission = often(random, 0);
    p.layers.diffuse_transmission_color = {random(), random(), random()};
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

// Of layers, what a material lacks changes nothing either.
TEST(Features, OneLayerIsTheSameUnderAll) {
    Random random(5);
    for (int i = 0; i < 50'000; ++i) {
        const LayerParams<float> all = random_layered_params(random).layers;
        Params p = random_params(random);
        p.transmission = 0;
        p.thin = true;
        const Point at = random_point(random);
        const auto expect_same = [&]<Features S>(auto... fields) {
            p.layers = {};
            ((p.layers.*fields = all.*fields), ...);
            ASSERT_TRUE(same_bits(shade<S>(p, at.wo, at.wi, at.u, nullptr), shade<all_features>(p, at.wo, at.wi, at.u, nullptr)));
        };
        using L = LayerParams<float>;
        expect_same.operator()<specular.with(Feature::clearcoat)>(&L::clearcoat, &L::clearcoat_roughness, &L::clearcoat_normal);
        expect_same.operator()<specular.with(Feature::sheen)>(&L::sheen_color, &L::sheen_roughness);
        expect_same.operator()<specular.with(Feature::anisotropy)>(&L::anisotropy);
        expect_same.operator()<specular.with(Feature::iridescence)>(&L::iridescence, &L::film_ior, &L::film_thickness);
        expect_same.operator()<specular.with(Feature::diffuse_transmission)>(&L::diffuse_transmission, &L::diffuse_transmission_color);
    }
}

template <Features S> void expect_lanes_equal_one_path(const EnergyTable* energy) {
    constexpr int n = width<Wide>;
    Random random(4);
    for (int round = 0; round < 10'000; ++round) {
        float columns[numbers_of_params + 9][n], thin[n];
        Params params[n];
        Point points[n];
        for (int i = 0; i < n; ++i) {
            Params& p = params[i] = has_layers(S) && i % 2 ? random_layered_params(random) : random_params(random);
            Point& at = points[i] = random_point(random);
            if (is_solid(p) && random() < 0.5f) at.wo.z = -at.wo.z;
            int k = 0;
            for_each_value(p, [&](float x) { columns[k++][i] = x; });
            for (const Vec3& v : {at.wo, at.wi, at.u})
                for (const float x : {v.x, v.y, v.z}) columns[k++][i] = x;
            thin[i] = p.thin;
        }
        int column = 0;
        const auto next = [&] { return load<Wide>(columns[column++]); };
        const auto next_vec = [&] {
            const Wide x = next(), y = next(), z = next();
            return Vec<Wide>{x, y, z};
        };
        BsdfParams<Wide> p;
        for_each_value(p, [&](Wide& x) { x = next(); });
        p.thin = load<Wide>(thin) > 0.5f;
        const Vec<Wide> wo = next_vec(), wi = next_vec(), u = next_vec();
        const Bsdf<Wide> b = make_bsdf<S>(p, wo, energy);
        const BsdfSample<Wide> s = sample<S>(b, wo, u.x, u.y, u.z);
        const BsdfValue<Wide> v = eval<S>(b, wo, wi);
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

} // namespace blush::TEST_FILE
