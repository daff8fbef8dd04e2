#include "render/film/pilot_variance.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr double per_half = double(SampleAllocation::pilot_samples) / 2;
constexpr double dark = 0.1; // luminance below which noise is invisible; as in relmse

// Smooths along one axis of a grid with weights 1 : 4 : 1; borders repeat the last value.
TileNoise smooth(const TileNoise& values, int across, int down, int dx, int dy) {
    TileNoise result;
    const auto at = [&](int x, int y) { return values[size_t(std::clamp(y, 0, down - 1) * across + std::clamp(x, 0, across - 1))]; };
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) result.push_back((at(x - dx, y - dy) + 4 * at(x, y) + at(x + dx, y + dy)) / 6);
    return result;
}

} // namespace

void PilotVariance::mark(const Film& film) {
    marked_.resize(2 * size_t(film.width()) * size_t(film.height()));
    for (size_t i = 0; i < marked_.size(); ++i) marked_[i] = film.sum(i / 2, int(i % 2));
}

double PilotVariance::of_pixel(const Film& film, size_t pixel, int half) const {
    const Vec3d first = marked_[2 * pixel + size_t(half)], both = film.sum(pixel, half);
    const auto channel = [](double first_sum, double sum) {
        const double difference = (sum - 2 * first_sum) / per_half, mean = sum / per_half;
        return difference * difference / (mean * mean + dark * dark);
    };
    // The shadow is assumed to be over white.
    return channel(first.x, both.x) + channel(first.y, both.y) + channel(first.z, both.z) + 3 * film.shadow_variance(pixel);
}

std::array<TileNoise, 2> PilotVariance::measure(const Film& film) {
    constexpr int size = SampleAllocation::tile_size;
    const int across = (film.width() + size - 1) / size, down = (film.height() + size - 1) / size;
    std::array<TileNoise, 2> noise;
    for (int half = 0; half < 2; ++half) {
        TileNoise squares;
        for (int top = 0; top < film.height(); top += size)
            for (int left = 0; left < film.width(); left += size) {
                const int bottom = std::min(top + size, film.height()), right = std::min(left + size, film.width());
                double sum = 0;
                for (int y = top; y < bottom; ++y)
                    for (int x = left; x < right; ++x) sum += of_pixel(film, size_t(y) * size_t(film.width()) + size_t(x), half);
                squares.push_back(sum / (double(bottom - top) * double(right - left)));
            }
        squares = smooth(smooth(squares, across, down, 1, 0), across, down, 0, 1);
        for (double& s : squares) s = std::sqrt(s);
        noise[size_t(half)] = std::move(squares);
    }
    marked_ = {};
    return noise;
}

} // namespace blush
