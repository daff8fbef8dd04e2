// Bias test: compares means of image regions with a reference, in units of the standard error of their difference.
#pragma once

#include "core/vec.h"
#include "measure/metrics/rgb_image.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace blush {

// An image with the standard error of each pixel's mean, RGB.
struct MeasuredImage {
    RgbImage image;
    std::vector<Vec3> error;    // width * height
    int64_t samples = 0;        // per pixel
    double variance_factor = 1; // factor on the variance of a mean over pixels due to covariance of pixels
};

// Mean of two images weighted by their sample counts, with its error. Sizes must agree; an empty image is ignored.
MeasuredImage merged(const MeasuredImage& a, const MeasuredImage& b);

struct RegionBias {
    int x = 0, y = 0, width = 0, height = 0; // pixels
    double mean = 0, reference = 0;          // luminance
    double error = 0;                        // standard error of their difference
    double degrees = 0;                      // degrees of freedom of that error
    double possible_deficit = 0;             // possible deficit of the mean due to rare bright samples that were not found
    double possible_excess = 0;              // the same deficit of the reference
    // The difference without what such samples explain.
    double difference() const;
    // Normal deviate with the same p-value as the difference.
    double z() const;
    // Relative to the reference's mean; 0 if it is black.
    double percent() const { return reference > 0 ? 100 * (mean - reference) / reference : 0; }
    double percent_error() const { return reference > 0 ? 100 * error / reference : 0; }
};

struct BiasTest {
    RegionBias whole;                // the whole image
    RegionBias pooled;               // the same with regions weighted by the inverse variance of the reference
    std::vector<RegionBias> regions; // grid, by rows
    RegionBias worst;                // the largest deviation of all, in standard errors
    double threshold = 0;            // significance threshold of |z|
    double rounding = 0;             // relative difference that float rounding explains
    bool biased = false;
    // Whether this region, or a mean of this test, differs by more than noise.
    bool is_biased(const RegionBias& region) const;
    std::string_view verdict() const { return biased ? "biased" : "unbiased-within-noise"; }
};

// Largest probability that the test of an unbiased image reports bias.
constexpr double bias_significance = 0.01;

// Tests the whole image, unweighted and pooled, and a grid of at most 8 x 8 regions of at least about 16 x 16 pixels. The levels
// are such that all tests together report bias of an unbiased image with probability bias_significance at most (Sidak 1967). Pooled
// regions are weighted by the inverse of their variance, so that noise at the edge of a light does not hide a bias elsewhere.
// Only the reference determines the weights: an image that missed bright samples has little noise where it is too dark. The
// variance of a region's mean is the maximum of three estimates: the sum of the variances of its pixels (with fully correlated
// colour channels, a close upper bound); the variance of the reference at the same sample count, since an image without bright
// samples underestimates its variance; and the variance of the differences between image and reference. Student's t with degrees
// of freedom by Satterthwaite (1946) accounts for the uncertainty of the variance.
//
// If rare bright samples carry the light (small or nearby lights), means are mostly too dark, and no statistic of an image
// without such samples shows it. `possible_deficit` bounds the deficit: -log(level) samples as bright as the brightest nearby, the
// number for which seeing none is as unlikely as the level of the test. A smaller deficit is not reported as bias. Only the excess of
// the brightest over the expected maximum of normal noise counts, so that the bound is 0 for normal noise. A reference that is no better
// than the image misses such samples as well: then the image is too bright, by at most
// `possible_excess`, and pooled by an unknown amount, as its weights are largest where the reference misses them.
//
// Differences below `rounding` times the reference's mean are treated as float rounding. Returns an empty result if sizes differ
// or are 0.
BiasTest test_bias(const MeasuredImage& image, const MeasuredImage& reference, double rounding = 1e-5);

} // namespace blush
