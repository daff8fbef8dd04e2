#include "tests/render/irradiance.h"

namespace blush::test {

testing::AssertionResult shows_on_floor(const Scene& scene, const FloorIrradiance& irradiance, double alpha,
                                        const RenderSettings& settings) {
    int quarter = 0;
    for (const FloorQuarter& q : photograph_floor(scene, irradiance, settings)) {
        if (auto verdict = is_mean(q.seen, q.expected, statistics::sidak(alpha, 4)); !verdict) return verdict << ", quarter " << quarter;
        ++quarter;
    }
    return testing::AssertionSuccess();
}

} // namespace blush::test
