// Adaptive sampling: more samples where the noise is. How many each half of each tile of the film gets, decided by what a pilot measured.
//
// Where the samples of a mean also decide how many there are, the mean leans: pixels whose first samples happen to be dark look quiet, get
// few more and stay dark (Kirk and Arvo 1991). Here the two halves of the film, independent randomisations of the sampler, decide for each
// other, and only by the pilot, which gives every pixel the same number of samples:
//
//     n_A = f(pilot of B),   n_B = f(pilot of A),   pixel = (mean of n_A samples of A + mean of n_B samples of B) / 2.
//
// n_A is then independent of A, so the mean of A is right on average whatever n_A is; so is that of B, and half the sum of both.
// Weights n_A : n_B would spoil it, for they know both. So would a later look: what B has by then depends on n_B, so on A.
// Pixels within a half stay uncorrelated. The halves of a pixel do but for the product of two covariances, of A's pilot with 1 / n_B and of
// B's with 1 / n_A: never negative, of second order in the scatter of n, and by so much the error that Film states is too small.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace blush {

// Standard deviation of the pilot's noise for each tile, of one half; only ratios count.
using TileNoise = std::vector<double>;

// A pure object, tested without rendering.
class SamplePlan {
public:
    static constexpr int tile_size = 16;         // pixels along a side
    static constexpr int64_t pilot_samples = 16; // of each pixel, both halves together
    static constexpr double least_share = 0.125; // of the mean: noise that the pilot has missed goes on being looked for
    static constexpr double largest_share = 8;   // of the mean: one firefly does not take all
    static constexpr int64_t granularity = 4;    // samples: whole strata of the sampler, and enough paths for a packet

    // Where rendering must halt after `mean` samples per pixel, for the pilot to be looked at: half-way and at its end.
    static int64_t next_look(int64_t mean);

    // Of a film of width x height pixels; nothing decided yet.
    void reset(int width, int height);
    // `noise[h]`: as half h measured it, a number per tile by rows.
    void decide(const std::array<TileNoise, 2>& noise);
    bool decided() const { return !shares_[0].empty(); }

    // What it has decided, to be given to another plan; empty before. Restoring: false, and nothing changes, unless they are of as many tiles.
    using Shares = std::array<std::vector<double>, 2>;
    const Shares& shares() const { return shares_; }
    bool restore(const Shares& shares);

    int across() const { return across_; }
    int tiles() const { return across_ * down_; }
    // How many samples of half `half` each pixel of `tile` has when the film has `mean` samples per pixel: a function of `mean`, so
    // that steps do not matter; never falls as it grows. Beyond the pilot only if decided.
    int64_t samples(int tile, int half, int64_t mean) const;

private:
    std::vector<double> shares_of(const TileNoise& noise) const;

    int width_ = 0, height_ = 0, across_ = 0, down_ = 0;
    Shares shares_; // of what comes after the pilot, for each half; their mean over the pixels is 1
};

} // namespace blush
