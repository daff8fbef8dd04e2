// How many samples of the emission pixels with highlights take for each sample: what the pilot of smooth edges decides (edge_pilot.h).
#pragma once

#include "core/vec.h"
#include "render/film/edges/edge_pixels.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace blush {

// Noise and work of the paths of an image.
struct ImageNoise {
    double mse = 0, relmse = 0, work = 0; // squared errors per sample, in pixels; rays per sample
    double light_path_work = 0;           // included in `work`

    void add(double variance, double scale) {
        mse += variance;
        relmse += variance / scale;
    }
    // Falls where work pays.
    double cost() const { return mse * relmse * work * work; }
    // True if a fall of a pixel's variance is worth so many more rays for each sample.
    bool is_worth(double gain, double mean, double rays) const {
        const double relative_gain = gain / (mean * mean + dark_squared);
        return gain > 0 && gain / mse + relative_gain / relmse > 2 * rays / work;
    }
};

// Light behind smooth surfaces that a sample has met by all its chains, and the same as a path would meet it, which follows one lobe at
// each surface: `path_rate` times as often, with `path_luminance`.
struct MetLight {
    double luminance, path_luminance, path_rate;
    Vec3d light;
};
// Samples of a pixel near a sighting.
struct MeasuredPixel {
    int x = 0, y = 0;
    double sighted = std::numeric_limits<double>::infinity(); // least luminance of the sightings, of a path
    int measured = 0;                                         // number of samples
    double sum = 0, squares = 0, low = std::numeric_limits<double>::infinity(), high = 0, rays = 0;
    double path_squares = 0, path_high = 0; // of paths: the sum of second moments, and the largest
    std::vector<MetLight> met;
    // Of the emission: that of a path, and of one sample by all chains; mean of all light; 2 E[e] R of edge_pilot.h.
    double path_variance = 0, variance = 0, mean = 0, cancelled = 0;
    int samples = 0; // of the emission for each sample; 0: its path's own

    // True if samples met light like that of a sighting, which may be an octave brighter.
    bool has_highlight() const {
        return std::ranges::any_of(met, [&](const MetLight& m) { return 2 * m.path_luminance > sighted; });
    }
    // Rays of a sample.
    double rays_per_sample() const { return rays / measured; }
    // With so many samples.
    double variance_with(int each) const { return each == 0 ? path_variance : variance / each + cancelled; }
    // Of relative squares.
    double scale() const { return mean * mean + dark_squared; }
};
// What one sample by all chains instead of a path gains in the pixels of a cell that are not measured, and its work; of the image.
struct FaintCell {
    double path_variance = 0, variance = 0, pixels = 0, rays = 0;
    bool taken = false;
};

// Relative squared error over squared error of highlights. Those outside of the measured pixels are taken to lie in light like that of
// these.
double relative_to_variance(std::span<const MeasuredPixel> measured);

// Sets `samples` of the pixels and `taken` of the cells. Steps to more samples are sorted by what they gain for their work, and taken as
// far as mse x relmse x work^2 is smallest and work grows by half at most: each may pay only with those after it, as half of the highlights
// leave half of the noise.
// `pixels`: of the image. `before`: its noise if no pixel takes more samples.
void choose_highlight_samples(std::vector<MeasuredPixel>& measured, std::vector<FaintCell>& cells, double pixels, const ImageNoise& before);

} // namespace blush
