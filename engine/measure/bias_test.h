// Is one way of rendering wrong, or only noisy? Means of regions against a reference, in units of the standard error of their difference.
#pragma once

#include "core/vec.h"
#include "measure/rgb_image.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace blush {

// A picture and what its pixels may be off: the standard error of each pixel's mean, RGB.
struct MeasuredImage {
    RgbImage image;
    std::vector<Vec3> error; // width * height
    int64_t samples = 0;     // per pixel
    double sharing = 1;      // times which the variance of a mean over pixels is what it would be if they erred independently
};

// The mean of two pictures weighted by their samples, and its error. Same size; an empty one counts for nothing.
MeasuredImage merged(const MeasuredImage& a, const MeasuredImage& b);

struct RegionBias {
    int x = 0, y = 0, width = 0, height = 0; // pixels
    double mean = 0, reference = 0;          // luminance
    double error = 0;                        // standard error of their difference
    double degrees = 0;                      // of freedom of that error: how many pixels carry it
    double unseen = 0; // by how much the mean may be too dark for want of rare bright samples
    // What is left of the difference when that is granted.
    double difference() const;
    // In standard errors, as a normal deviate that is as unlikely.
    double z() const;
    // Of the reference's mean; 0 where it is black.
    double percent() const { return reference > 0 ? 100 * (mean - reference) / reference : 0; }
    double percent_error() const { return reference > 0 ? 100 * error / reference : 0; }
};

struct BiasTest {
    RegionBias whole;                // the picture
    RegionBias pooled;               // again, regions counting for the more, the less noise the reference has in them
    std::vector<RegionBias> regions; // of a grid, by rows
    RegionBias worst;                // of all these, the one that is furthest off in standard errors
    double threshold = 0;            // of |z| beyond which it cannot be noise
    bool biased = false;
    std::string_view verdict() const { return biased ? "biased" : "unbiased-within-noise"; }
};

// Chance that a test of a right picture says "biased".
constexpr double bias_significance = 0.01;

// Tests the whole picture, plainly and pooled, and a grid of regions of about 16 x 16 pixels and more, at most 8 x 8 of them, each at such a
// level that all together err with probability bias_significance (Sidak 1967). Pooled, regions are weighted by the inverse of their variance,
// so that a lamp's edge does not hide what is missing everywhere. The reference alone says which: a picture that has missed bright samples
// looks quiet where it is too dark. The variance of a region's mean is the largest of three: the sum of its
// pixels' own, colours taken to err together, which is nearly so and never too small; what the reference would have with as few samples,
// for a picture that has met no bright sample knows of none; and that by which its pixels do differ from the reference's. Student's t with
// as many degrees of freedom as there are pixels that carry it (Satterthwaite 1946) allows for its being uncertain.
//
// Where rare bright samples carry the light, as where lights nearby are aimed at or small ones are met by chance, means are mostly too dark
// and no statistic of a picture that has not met them tells. If samples as bright as the brightest around were due, so many that to see
// none of them is as unlikely as the test's level, -log(level) of them, they would add as much as `unseen` says: a picture that lacks no
// more is not called biased. The brightest is taken above what normal noise of so many pixels comes to, so that this costs nothing where
// noise is normal.
//
// Differences below `rounding` of the reference's mean are not bias: what sums of floats may be off. Errors: sizes differ or are 0: an
// empty result.
BiasTest test_bias(const MeasuredImage& image, const MeasuredImage& reference, double rounding = 1e-5);

} // namespace blush
