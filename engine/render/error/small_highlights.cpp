#include "render/error/small_highlights.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr double min_meetings = 20;      // with fewer, the error of the samples says too little
constexpr double max_missed_share = 0.1; // of the squared error: moves the RMSE by 5 %, about the half width of its interval

} // namespace

SmallHighlights::Band& SmallHighlights::of(double luminance) {
    const double octave = luminance > 0 ? std::floor(std::log2(luminance)) - first_octave : 0;
    return bands[size_t(std::clamp(octave, 0.0, double(num_bands - 1)))];
}

bool SmallHighlights::may_be_missed(double samples, int64_t pixels, double squares) const {
    double missed = 0;
    for (const Band& band : bands) {
        const double covered = band.rate * double(pixels);
        if (covered * samples >= min_meetings) continue;
        const Vec3d all = band.sum * double(pixels);
        missed += dot(all, all) / std::max(1.0, covered);
    }
    return missed > max_missed_share * squares;
}

} // namespace blush
