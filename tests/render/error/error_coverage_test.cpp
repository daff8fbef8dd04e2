// The 95 % intervals of the error estimate contain the true error, against the stored references, in 95 % of cases.
#include "core/math.h"
#include "tests/render/reference_scenes.h"
#include "tests/support/error_coverage.h"

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

Truth stored_truth(const std::string& scene) {
    const Picture reference = read_reference(coverage_reference_file(scene)).mean;
    Truth truth;
    truth.mean = reference.pixels;
    for (const Vec3d& e : reference.errors) truth.variance.push_back({e.x * e.x, e.y * e.y, e.z * e.z});
    return truth;
}

// Fraction of the known intervals that contain the true error, one number
// per rendering: its images at several sample counts share samples.
struct Shares {
    Moments relmse, rmse;
    int64_t runs = 0, known = 0;

    void add(const Coverage& c) {
        runs += c.runs;
        known += c.known;
        if (c.known > 0) relmse.add(double(c.covered) / double(c.known));
        if (c.rmse_known > 0) rmse.add(double(c.rmse_covered) / double(c.rmse_known));
    }
};

Shares measure_shares(int seeds, RenderSettings settings) {
    Shares shares;
    for (const std::string& name : shipped_scene_names()) {
        const Scene scene = shipped_scene(name);
        const Truth truth = stored_truth(name);
        Renderer renderer;
        for (int run = 0; run < seeds; ++run) {
            settings.seed = uint32_t(run);
            renderer.update(scene, settings);
            renderer.clear();
            Coverage coverage;
            int64_t samples = 0;
            for (const int64_t count : {2, 3, 4, 8, 32}) {
                renderer.render(samples, count - samples);
                samples = count;
                const Frame frame = renderer.resolve();
                coverage.add(frame.error, true_error(frame, truth));
            }
            shares.add(coverage);
        }
    }
    return shares;
}

testing::AssertionResult between(const Moments& share, double low, double high) {
    const double z = 2.576; // beyond which 1 % of the distribution lies
    if (share.mean + z * share.error() >= low && share.mean - z * share.error() <= high) return testing::AssertionSuccess();
    return testing::AssertionFailure() << share.mean << " +- " << share.error() << " of " << share.count;
}

TEST(ErrorCoverage, IntervalsHaveTheirNominalCoverage) {
    const Shares shares = measure_shares(32, coverage_settings());
    EXPECT_TRUE(between(shares.relmse, 0.93, 0.97)) << "relmse";
    EXPECT_TRUE(between(shares.rmse, 0.93, 0.97)) << "rmse";
    // An estimate that is always unknown would be useless.
    EXPECT_GT(shares.known, shares.runs / 2);
}

// Default settings of the window and `blush render`: with path reuse, the interval accounts for the correlation of errors, no
// more and no less; and pixels have different numbers of samples.
TEST(ErrorCoverage, IntervalsHaveTheirNominalCoverageWithTheRecommendedSettings) {
    RenderSettings settings = coverage_settings();
    settings.adaptive = recommended_settings().adaptive;
    settings.reuse = recommended_settings().reuse;
    const Shares shares = measure_shares(24, settings);
    EXPECT_TRUE(between(shares.relmse, 0.93, 0.97)) << "relmse";
    EXPECT_TRUE(between(shares.rmse, 0.93, 0.97)) << "rmse";
    EXPECT_GT(shares.known, shares.runs / 2);
}

} // namespace
} // namespace blush::test::TEST_FILE
