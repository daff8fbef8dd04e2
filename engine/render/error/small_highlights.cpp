#include "render/error/small_highlights.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr double min_meetings = 20;      // with fewer, the error of the samples says too little
constexpr double max_missed_share = 0.1; // of the squared error: moves the RMSE by 5 %, about the half width of its interval

} // namespace

size_t SmallHighlights::octave_of(double luminance) {
    const double octave = luminance > 0 ? std::floor(std::log2(luminance)) - first_octave : 0;
    return size_t(std::clamp(octave, 0.0, double(num_bands - 1)));
}

SmallHighlights::Band& SmallHighlights::of(double luminance, int samples) {
    const auto set = size_t(std::ranges::find(samples_of_set, samples) - samples_of_set.begin());
    return bands[set * num_bands + octave_of(luminance)];
}

void SmallHighlights::add(double luminance, const Band& light, int samples) {
    Band& band = of(luminance, samples);
    band.rate += light.rate;
    band.sum = band.sum + light.sum;
}

bool SmallHighlights::may_be_missed(double samples, int64_t pixels, double squares) const {
    double missed = 0;
    for (size_t k = 0; k < bands.size(); ++k) {
        const Band& band = bands[k];
        const double covered = band.rate * double(pixels), taken = samples * std::max(1, samples_of_set[k / num_bands]);
        if (covered * taken >= min_meetings) continue;
        const Vec3d all = band.sum * double(pixels);
        missed += dot(all, all) / std::max(1.0, covered);
    }
    return missed > max_missed_share * squares;
}

} // namespace blush
