// The 95 % intervals of the error estimate contain the true error, against the stored references, in 95 % of cases.
#include "core/math.h"
#include "tests/render/reference_scenes.h"
#include "tests/support/error_coverage.h"

namespace blush::test::TEST_FILE {
namespace {

Truth stored_truth(const std::string& scene) {
    const RenderedImage reference = read_reference(coverage_reference_file(scene)).mean;
    Truth truth;
    truth.mean = reference.pixels;
    for (const Vec3d& e : reference.errors) truth.variance.push_back({e.x * e.x, e.y * e.y, e.z * e.z});
    return truth;
}

// Fraction of the known intervals that contain the true error. The images of one rendering at several sample counts share samples:
// renderings are independent of each other, their images are not.
class Share {
public:
    void add(int64_t covered, int64_t known) { renderings_.push_back({double(covered), double(known)}); }
    double mean() const {
        double covered = 0, known = 0;
        for (const Rendering& r : renderings_) covered += r.covered, known += r.known;
        return covered / known;
    }
    // Standard error of the ratio of two sums (Cochran 1977, 6.4).
    double error() const {
        const double share = mean();
        double squares = 0, known = 0;
        for (const Rendering& r : renderings_) {
            squares += (r.covered - share * r.known) * (r.covered - share * r.known);
            known += r.known;
        }
        return std::sqrt(squares) / known;
    }

private:
    struct Rendering {
        double covered, known;
    };
    std::vector<Rendering> renderings_;
};

struct Shares {
    Share relmse, rmse;
    int64_t runs = 0, known = 0;

    void add(const Coverage& c) {
        runs += c.runs;
        known += c.known;
        relmse.add(c.covered, c.known);
        rmse.add(c.rmse_covered, c.rmse_known);
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

// Nominal are 95 %. The range is wider by more than the standard error that is required, so a share that is off by 5 % is seen.
testing::AssertionResult is_nominal(const Share& share) {
    const double mean = share.mean(), error = share.error();
    const bool precise = error < 0.01;
    if (precise && mean > 0.93 && mean < 0.98) return testing::AssertionSuccess();
    return testing::AssertionFailure() << mean << " +- " << error << (precise ? " instead of 0.93 to 0.98" : ": too few renderings");
}

TEST(ErrorCoverage, IntervalsHaveTheirNominalCoverage) {
    const Shares shares = measure_shares(80, coverage_settings());
    EXPECT_TRUE(is_nominal(shares.relmse)) << "relmse";
    EXPECT_TRUE(is_nominal(shares.rmse)) << "rmse";
    // An estimate that is always unknown would be useless.
    EXPECT_GT(shares.known, shares.runs / 2);
}

// Default settings of the window and `blush render`: with path reuse, the interval accounts for the correlation of errors, no
// more and no less; and pixels have different numbers of samples.
TEST(ErrorCoverage, IntervalsHaveTheirNominalCoverageWithTheRecommendedSettings) {
    RenderSettings settings = coverage_settings();
    settings.adaptive = recommended_settings().adaptive;
    settings.reuse = recommended_settings().reuse;
    const Shares shares = measure_shares(80, settings);
    EXPECT_TRUE(is_nominal(shares.relmse)) << "relmse";
    EXPECT_TRUE(is_nominal(shares.rmse)) << "rmse";
    EXPECT_GT(shares.known, shares.runs / 2);
}

} // namespace
} // namespace blush::test::TEST_FILE
