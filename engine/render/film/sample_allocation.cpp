#include "render/film/sample_allocation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace blush {

int64_t SampleAllocation::next_measurement(int64_t mean) {
    if (mean < pilot_samples / 2) return pilot_samples / 2;
    return mean < pilot_samples ? pilot_samples : std::numeric_limits<int64_t>::max();
}

void SampleAllocation::reset(int width, int height) {
    width_ = width;
    height_ = height;
    across_ = (width + tile_size - 1) / tile_size;
    down_ = (height + tile_size - 1) / tile_size;
    for (std::vector<double>& shares : shares_) shares.clear();
}

void SampleAllocation::decide(const std::array<TileNoise, 2>& noise) {
    for (size_t half = 0; half < 2; ++half) shares_[half] = shares_of(noise[1 - half]);
}

bool SampleAllocation::restore(const Shares& shares) {
    for (const std::vector<double>& half : shares) {
        if (half.size() != size_t(tiles())) return false;
        for (const double share : half)
            if (!(share >= 0 && share <= double(tiles()) * max_share)) return false;
    }
    shares_ = shares;
    return true;
}

// Proportional to the noise, which is optimal (Neyman 1934), within limits: bisection for the logarithm of the factor at which
// shares are 1 on average.
std::vector<double> SampleAllocation::shares_of(const TileNoise& noise) const {
    std::vector<double> pixels(noise.size());
    for (int tile = 0; tile < tiles(); ++tile)
        pixels[size_t(tile)] = double(std::min(tile_size, width_ - tile % across_ * tile_size)) *
                               double(std::min(tile_size, height_ - tile / across_ * tile_size));
    std::vector<double> shares(noise.size());
    const auto spend = [&](double exponent) {
        double sum = 0;
        for (size_t tile = 0; tile < noise.size(); ++tile) {
            shares[tile] = std::clamp(std::exp2(exponent) * noise[tile], min_share, max_share);
            sum += pixels[tile] * shares[tile];
        }
        return sum;
    };
    const double all = double(width_) * double(height_);
    double low = -1000, high = 1000; // beyond any noise of finite samples
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (spend(middle) < all ? low : high) = middle;
    }
    // If the limits leave samples over (nearly no noise anywhere), they are distributed to all.
    const double scale = all / spend(high);
    for (double& share : shares) share *= scale;
    return shares;
}

int64_t SampleAllocation::samples(int tile, int half, int64_t mean) const {
    const int64_t uniform = (mean + 1 - half) / 2;
    if (mean <= pilot_samples || !decided()) return uniform;
    const double wanted = 0.5 * double(mean - pilot_samples) * shares_[size_t(half)][size_t(tile)];
    // Rounding is staggered over tiles by a golden-ratio sequence of thresholds,
    // so that the film always holds about the planned number of samples.
    const double turn = std::fmod(double(2 * tile + half) * (std::numbers::phi - 1), 1.0);
    return pilot_samples / 2 + granularity * int64_t(std::floor(wanted / double(granularity) + turn));
}

} // namespace blush
