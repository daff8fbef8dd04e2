// The environment table of images with bad texels or of the wrong shape.
#include "core/parallel.h"
#include "render/lights/environment_table.h"
#include "tests/shading/tables.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

TEST(EnvironmentTable, ReplacesAndCountsBadTexels) {
    const float values[] = {nan, infinite, -1.f, 1.f, 2.f, 3.f};
    size_t next = 0;
    Environment e;
    e.kind = Environment::Kind::image;
    e.image = make_float_image(2, 1, 3, [&] { return values[next++]; });
    e.file = "sky.exr";
    const EnvironmentTable table = build_environment_table(e);
    EXPECT_EQ(table.texels, (std::vector<float>{0, 0, 0, 1, 2, 3}));
    ASSERT_EQ(table.warnings.size(), 1u);
    EXPECT_EQ(table.warnings[0].what, "3 values are negative or not finite: read as 0");
    EXPECT_EQ(table.warnings[0].where, "sky.exr");
}

TEST(EnvironmentTable, ReadsTheFirstThreeOfFourChannels) {
    Environment e;
    e.kind = Environment::Kind::image;
    float next = 0;
    e.image = make_float_image(2, 1, 4, [&] { return next++; });
    EXPECT_EQ(build_environment_table(e).texels, (std::vector<float>{0, 1, 2, 4, 5, 6}));
}

TEST(EnvironmentTable, IsTheSameForAnyNumberOfThreads) {
    Random random(21);
    for (const int channels : {3, 4})
        for (const bool has_bad_texel : {false, true}) {
            Environment e;
            e.kind = Environment::Kind::image;
            size_t next = 0;
            e.image = make_float_image(67, 45, channels, [&] { return has_bad_texel && next++ == 1000 ? -1.f : random.unit(); });
            for (const EnvironmentSampling sampling : {EnvironmentSampling::full, EnvironmentSampling::compensated}) {
                const EnvironmentTable alone = build_environment_table(e, sampling);
                EXPECT_EQ(alone.image == e.image, channels == 3 && !has_bad_texel) << "read in place";
                for (const unsigned threads : {1u, 2u, 5u}) {
                    const Workers workers(threads);
                    const EnvironmentTable shared = build_environment_table(e, sampling, &workers);
                    EXPECT_EQ(shared.texels, alone.texels);
                    EXPECT_EQ(shared.row_thresholds, alone.row_thresholds);
                    EXPECT_EQ(shared.column_thresholds, alone.column_thresholds);
                    EXPECT_EQ(shared.column_guides, alone.column_guides);
                    EXPECT_EQ(shared.texel_integral, alone.texel_integral);
                    EXPECT_EQ(shared.sampled_share, alone.sampled_share);
                    EXPECT_EQ(shared.warnings.size(), alone.warnings.size());
                    EXPECT_TRUE(shared.emits_light);
                }
            }
        }
}

TEST(EnvironmentTable, AnUnusableImageIsNoEnvironment) {
    Environment missing, grey, lying;
    missing.kind = grey.kind = lying.kind = Environment::Kind::image;
    grey.image = make_float_image(4, 2, 1, [] { return 1.f; });
    auto image = std::make_shared<Image>();
    image->width = image->height = 60000;
    image->channels = 3;
    lying.image = image;
    for (const Environment& e : {missing, grey, lying}) {
        const EnvironmentTable table = build_environment_table(e);
        EXPECT_EQ(table.warnings.size(), 1u);
        EXPECT_EQ(table.integral(), (Vec3d{0, 0, 0}));
        EXPECT_EQ(environment_radiance<float>(table.tables(), {0, 1, 0}, true), (Vec3{0, 0, 0}));
    }
}

} // namespace
} // namespace blush::TEST_FILE
