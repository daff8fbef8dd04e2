// Delta lobes one by one are those that sample() selects, with its probabilities and weights.
#include "shading/delta_lobes.h"
#include "tests/shading/materials.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <array>

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

using Lobes = std::array<DeltaLobe<float>, num_delta_lobes>;

bool same_direction(const Vec3& a, const Vec3& b) { return length(a - b) < 1e-5f; }

// True if the sample has the direction of the lobe, and its value over its probability as weight.
bool is_of(const DeltaLobe<float>& lobe, const BsdfSample<float>& s) {
    const Vec3 off = lobe.value - s.weight * lobe.probability;
    return lobe.valid && same_direction(lobe.wi, s.wi) &&
           max_component(Vec3{abs(off.x), abs(off.y), abs(off.z)}) <= 1e-5f * max_component(lobe.value);
}
// The number of the first lobe with its direction: a coat on a mirror reflects as that does.
size_t direction_of(const Lobes& lobes, const Vec3& wi) {
    size_t l = 0;
    while (l < num_delta_lobes && !(lobes[l].valid && same_direction(lobes[l].wi, wi))) ++l;
    return l;
}

} // namespace

TEST(DeltaLobes, AreThoseThatSamplesSelect) {
    const std::vector<Material> all = all_materials();
    int64_t tests = 0;
    for (const Material& m : all) tests += int64_t(num_delta_lobes * viewers(m.params).size());
    Random random(11);
    int found = 0;
    for (const Material& m : all)
        for (const Viewer& v : viewers(m.params)) {
            const Vec3 wo = v.wo();
            const Bsdf<float> b = make_bsdf<all_features>(m.params, wo, nullptr);
            std::array<Moments, num_delta_lobes> selected, probability; // of directions
            for (int k = 0; k < 4000; ++k) {
                const float a = random(), c = random(), choice = random();
                const BsdfSample<float> s = sample<all_features>(b, wo, a, c, choice);
                const Lobes lobes = delta_lobes<all_features>(b, wo, a, c);
                const bool is_delta = s.delta && s.valid;
                if (is_delta) {
                    ASSERT_TRUE(std::ranges::any_of(lobes, [&](const auto& lobe) { return is_of(lobe, s); })) << describe(m, v);
                    ++found;
                }
                std::array<double, num_delta_lobes> of_direction{};
                for (const DeltaLobe<float>& lobe : lobes)
                    if (lobe.valid) of_direction[direction_of(lobes, lobe.wi)] += double(lobe.probability);
                for (size_t l = 0; l < num_delta_lobes; ++l) {
                    selected[l].add(is_delta && direction_of(lobes, s.wi) == l ? 1 : 0);
                    probability[l].add(of_direction[l]);
                }
            }
            for (size_t l = 0; l < num_delta_lobes; ++l)
                EXPECT_TRUE(z_test_in_range(selected[l], 0, 1, probability[l].mean, sidak(significance, tests))) << describe(m, v) << l;
        }
    EXPECT_GT(found, 100'000);
}

} // namespace blush::TEST_FILE
