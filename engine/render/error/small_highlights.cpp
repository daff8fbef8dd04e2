#include "render/error/small_highlights.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr double min_meetings = 20; // with fewer, the error of the samples says too little

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

SmallHighlights::Missed SmallHighlights::missed(double samples, int64_t pixels) const {
    Missed sum;
    for (size_t k = 0; k < bands.size(); ++k) {
        const Band& band = bands[k];
        const double covered = band.rate * double(pixels), taken = samples * std::max(1, samples_of_set[k / num_bands]);
        if (covered * taken >= min_meetings) continue;
        const double in_pixels = std::max(1.0, covered);
        const Vec3d light = band.sum * (double(pixels) / in_pixels); // of one of them
        for (const double l : {light.x, light.y, light.z}) {
            sum.squares += in_pixels * l * l;
            // The true value is this light at least.
            sum.relative += in_pixels * l * l / (l * l + 0.01);
        }
    }
    return sum;
}

} // namespace blush
