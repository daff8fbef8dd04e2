// Compares with images that another program denoised with the same networks (tests/golden/denoise).
#include "tests/render/denoise/agreement.h"

#include <ostream>

namespace blush::test::TEST_FILE {
namespace {

struct Golden {
    const char* network;
    DenoiseQuality quality;
    bool features;
    double relmse; // of the expected image against the reference, to five digits
};

// Name of the GoogleTest case.
void PrintTo(const Golden& golden_case, std::ostream* out) { *out << golden_case.network; }

class GoldenTest : public testing::TestWithParam<Golden> {
protected:
    Planes noisy() const { return GetParam().features ? golden("noisy") : golden("noisy").without_features(); }
    Planes expected() const { return golden(std::string("expected_") + GetParam().network); }
    DenoiseOptions options(DenoisePrecision precision) const { return {.quality = GetParam().quality, .precision = precision}; }
};

// The mean of (a - b)^2 / (b^2 + 0.01).
double relmse(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (size_t i = 0; i < b.size(); i++) sum += (double(a[i]) - b[i]) * (double(a[i]) - b[i]) / (double(b[i]) * b[i] + 0.01);
    return sum / double(b.size());
}

TEST_P(GoldenTest, Float32Agrees) {
    const Denoised made = denoised(noisy(), options(DenoisePrecision::float32));
    EXPECT_EQ(made.network, GetParam().network);
    EXPECT_EQ(made.precision, "float32");
    EXPECT_NEAR(made.exposure_scale, 3.50315, 1e-5);
    EXPECT_LT(relative_difference(made.rgb, expected().color).largest, 1e-3);
}

TEST_P(GoldenTest, Bfloat16AgreesOrIsRefused) {
    if (!has_bfloat16()) {
        const auto refused = Denoiser(BLUSH_WEIGHTS, 1).denoise(noisy().input(), options(DenoisePrecision::bfloat16));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().what, "this processor does not support bfloat16");
        return;
    }
    const Denoised made = denoised(noisy(), options(DenoisePrecision::bfloat16));
    EXPECT_EQ(made.precision, "bfloat16");
    EXPECT_LT(relative_difference(made.rgb, expected().color).mean, 1e-2);
}

TEST_P(GoldenTest, HasTheExpectedErrorAgainstTheReference) {
    const Denoised made = denoised(noisy(), options(DenoisePrecision::float32));
    ASSERT_EQ(made.rgb.size(), golden("reference").color.size());
    EXPECT_NEAR(relmse(made.rgb, golden("reference").color), GetParam().relmse, 5e-6);
}

INSTANTIATE_TEST_SUITE_P(Networks, GoldenTest,
                         testing::Values(Golden{"rt_hdr_alb_nrm", DenoiseQuality::base, true, 0.00490},
                                         Golden{"rt_hdr_alb_nrm_small", DenoiseQuality::fast, true, 0.00525},
                                         Golden{"rt_hdr", DenoiseQuality::base, false, 0.00516}),
                         [](const auto& golden_case) { return std::string(golden_case.param.network); });

} // namespace
} // namespace blush::test::TEST_FILE
