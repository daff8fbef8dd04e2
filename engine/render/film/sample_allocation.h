// Adaptive sampling: allocates samples to each half of each tile of the film, by the noise that a pilot measured.
//
// If the samples of a mean also decide their number, the mean is biased: pixels whose first samples happen to be dark look quiet,
// get few more and stay dark (Kirk and Arvo 1991). Here the two halves of the film, independent randomisations of the sampler,
// decide for each other, and only by the pilot, which gives every pixel the same number of samples:
//
//     n_A = f(pilot of B),   n_B = f(pilot of A),   pixel = (mean of n_A samples of A + mean of n_B samples of B) / 2.
//
// n_A is independent of A, so the mean of A is unbiased for any n_A; so is that of B, and the mean of both. Weights n_A : n_B
// would introduce bias, because they depend on both. So would later updates: B's samples by then depend on n_B, so on A.
// Pixels within a half remain uncorrelated. The halves of a pixel are correlated only by the product of two covariances, of A's
// pilot with 1 / n_B and of B's with 1 / n_A: non-negative, of second order in the scatter of n, and the film's error estimate is
// too small by this amount.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace blush {

// Standard deviation of the pilot's noise for each tile, of one half; only ratios matter.
using TileNoise = std::vector<double>;

// Pure computation, testable without rendering.
class SampleAllocation {
public:
    static constexpr int tile_size = 16;         // pixels along a side
    static constexpr int64_t pilot_samples = 16; // of each pixel, both halves together
    // Least number of samples of a tile, as a share of the mean number. The pilot can miss rare events, so that a noisy tile seems to
    // have little noise: with this share the variance of each tile is at most 4/3 of that of uniform sampling. A smaller share gains
    // little where the pilot is right.
    static constexpr double min_share = 0.75;
    static constexpr double max_share = 8;    // of the mean: limits the effect of one firefly
    static constexpr int64_t granularity = 4; // samples: whole strata of the sampler, and enough paths for a packet

    // Number of mean samples per pixel at which rendering must stop to measure the pilot: half-way and at its end.
    static int64_t next_measurement(int64_t mean);

    // For a film of width x height pixels; nothing decided.
    void reset(int width, int height);
    // `noise[h]`: measured in half h, one number per tile, row by row.
    void decide(const std::array<TileNoise, 2>& noise);
    bool decided() const { return !shares_[0].empty(); }

    // The decided shares, for transfer to another plan; empty before. restore()
    // returns false, without changes, if the number of tiles differs.
    using Shares = std::array<std::vector<double>, 2>;
    const Shares& shares() const { return shares_; }
    bool restore(const Shares& shares);

    int across() const { return across_; }
    int tiles() const { return across_ * down_; }
    // Samples of half `half` for each pixel of `tile` when the film has `mean` samples per pixel: a function of `mean` alone,
    // non-decreasing. Beyond the pilot only after decide().
    int64_t samples(int tile, int half, int64_t mean) const;

private:
    std::vector<double> shares_of(const TileNoise& noise) const;

    int width_ = 0, height_ = 0, across_ = 0, down_ = 0;
    Shares shares_; // after the pilot, for each half; their mean over the pixels is 1
};

} // namespace blush
