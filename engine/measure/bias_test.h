// Is one way of rendering wrong, or only noisy? Means of regions against a reference, in units of the standard error of their difference.
#pragma once

#include "core/vec.h"
#include "measure/rgb_image.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace blush {

// A picture and what its pixels may be off: the standard error of each pixel's mean, RGB. Pixels err independently.
struct MeasuredImage {
    RgbImage image;
    std::vector<Vec3> error; // width * height
    int64_t samples = 0;     // per pixel
};

// The mean of two pictures weighted by their samples, and its error. Same size; an empty one counts for nothing.
MeasuredImage merged(const MeasuredImage& a, const MeasuredImage& b);

struct RegionBias {
    int x = 0, y = 0, width = 0, height = 0; // pixels
    double mean = 0, reference = 0;          // luminance
    double error = 0;                        // standard error of their difference
    double degrees = 0;                      // of freedom of that error: how many pixels carry it
    // The difference in standard errors, as a normal one would be that is as unlikely: where few pixels carry the error, it is itself
    // uncertain.
    double z() const;
    // Of the reference's mean; 0 where it is black.
    double percent() const { return reference > 0 ? 100 * (mean - reference) / reference : 0; }
};

struct BiasTest {
    RegionBias whole;                // the picture
    std::vector<RegionBias> regions; // of a grid, by rows
    RegionBias worst;                // of the whole and the regions, the one that is furthest off in standard errors
    double threshold = 0;            // of |z| beyond which it cannot be noise
    bool biased = false;
    std::string_view verdict() const { return biased ? "biased" : "unbiased-within-noise"; }
};

// Chance that a test of a right picture says "biased".
constexpr double bias_significance = 0.01;

// Tests the whole picture and a grid of regions of about 16 x 16 pixels and more, at most 8 x 8 of them, each at such a level that all
// together err with probability bias_significance (Sidak 1967). The variance of a region's mean is the sum of its pixels'; colours are
// taken to err together, which is nearly so and never too small. Where rare bright samples carry the light, few may have met them:
// Student's t with as many degrees of freedom as there are pixels that carry the variance (Satterthwaite 1946) allows for that, and where
// none has, no region is taken to scatter less than the reference would with as few samples. Differences below `rounding` of the
// reference's mean are not bias: what sums of floats may be off. Errors: sizes differ or are 0: an empty result.
BiasTest test_bias(const MeasuredImage& image, const MeasuredImage& reference, double rounding = 1e-5);

} // namespace blush
