#include "render/denoise/bias_correction.h"

#include "core/math.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace blush {
namespace {

constexpr int radius = 3;             // of the windows, in pixels
constexpr int coarsest_side = 16;     // no level is made of one whose shorter side has at most so many pixels
constexpr int band_rows = 16;         // for one task
constexpr float key = 0.18f;          // of the exposure scale: 0.18 over the mean
constexpr float most_relative = 1e6f; // so that fourth powers stay within float
constexpr float no_energy = 1e-30f;   // against 0 / 0
constexpr float few_pixels = 4;       // standard errors more for a window that a single pixel rules

// One channel of one level of the pyramid.
struct Level {
    Level(int w, int h) : width(w), height(h), difference(size_t(w) * size_t(h)), half(difference), correction(difference) {}
    size_t row(int y) const { return size_t(y) * size_t(width); }

    int width, height;
    std::vector<float> difference; // the residual, then its difference from the prediction
    std::vector<float> half;       // half of the signed difference of the halves
    std::vector<float> correction; // the prediction, then the result
};

void for_bands(int rows, const Workers* workers, const std::function<void(int first, int last)>& task) {
    const int bands = (rows + band_rows - 1) / band_rows;
    const auto run = [&](int64_t band, unsigned) { task(int(band) * band_rows, std::min(rows, int(band + 1) * band_rows)); };
    if (workers)
        workers->for_each(bands, {}, run);
    else
        for (int band = 0; band < bands; ++band) run(band, 0);
}

float mean_of_four(const std::vector<float>& from, size_t above, size_t below, size_t left, size_t right) {
    return 0.25f * (from[above + left] + from[above + right] + from[below + left] + from[below + right]);
}

void make_coarser(const Level& from, Level& to, const Workers* workers) {
    for_bands(to.height, workers, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const size_t above = from.row(2 * y), below = from.row(std::min(2 * y + 1, from.height - 1));
            for (int x = 0; x < to.width; ++x) {
                const auto left = size_t(2 * x), right = size_t(std::min(2 * x + 1, from.width - 1));
                to.difference[to.row(y) + size_t(x)] = mean_of_four(from.difference, above, below, left, right);
                to.half[to.row(y) + size_t(x)] = mean_of_four(from.half, above, below, left, right);
            }
        }
    });
}

// Bilinear interpolation of the coarser level's correction, and the difference from it.
void predict(Level& level, const Level& from, const Workers* workers) {
    for_bands(level.height, workers, [&](int first, int last) {
        std::vector<float> row(size_t(from.width) + 2); // with its ends repeated
        for (int y = first; y < last; ++y) {
            // Fine pixels lie a quarter before and behind the centre of the coarse one.
            const size_t near = from.row(y / 2), far = from.row(std::clamp(y % 2 ? y / 2 + 1 : y / 2 - 1, 0, from.height - 1));
            for (size_t x = 0; x < size_t(from.width); ++x)
                row[x + 1] = 0.75f * from.correction[near + x] + 0.25f * from.correction[far + x];
            row.front() = row[1];
            row.back() = row[size_t(from.width)];
            float* to = &level.correction[level.row(y)];
            float* difference = &level.difference[level.row(y)];
            for (size_t x = 0; x < size_t(level.width); ++x) {
                to[x] = 0.75f * row[x / 2 + 1] + 0.25f * row[x % 2 ? x / 2 + 2 : x / 2];
                difference[x] -= to[x];
            }
        }
    });
}

// Sums of a window's columns, with zeros beside them, for a loop over pixels without branches.
struct ColumnSums {
    explicit ColumnSums(int width)
        : squares(size_t(width + 2 * radius)), biases(squares.size()), errors(squares.size()), fourths(squares.size()) {}

    void sum(const Level& level, int first, int last) {
        for (std::vector<float>* sums : {&squares, &biases, &errors, &fourths}) std::fill(sums->begin(), sums->end(), 0.f);
        float *s = &squares[radius], *b = &biases[radius], *e = &errors[radius], *f = &fourths[radius];
        for (int y = first; y <= last; ++y) {
            const float *d = &level.difference[level.row(y)], *h = &level.half[level.row(y)];
#pragma omp simd
            for (size_t x = 0; x < size_t(level.width); ++x) {
                const float square = d[x] * d[x], variance = h[x] * h[x];
                s[x] += square;
                b[x] += square - variance;
                e[x] += 4 * square * variance;
                f[x] += square * square;
            }
        }
    }

    std::vector<float> squares, biases, errors, fourths; // d^2; d^2 - h^2; 4 d^2 h^2; d^4
};

// Adds the shrunk difference to the prediction. The window's number of pixels cancels: sums stand for means.
void shrink(Level& level, const Workers* workers) {
    for_bands(level.height, workers, [&](int first, int last) {
        ColumnSums columns(level.width);
        for (int y = first; y < last; ++y) {
            columns.sum(level, std::max(0, y - radius), std::min(level.height - 1, y + radius));
            const float *s = columns.squares.data(), *b = columns.biases.data(), *e = columns.errors.data(), *f = columns.fourths.data();
            const float* d = &level.difference[level.row(y)];
            float* to = &level.correction[level.row(y)];
#pragma omp simd
            for (size_t x = 0; x < size_t(level.width); ++x) {
                float squares = no_energy, biases = 0, errors = 0, fourths = 0;
                for (size_t i = 0; i <= 2 * radius; ++i) {
                    squares += s[x + i];
                    biases += b[x + i];
                    errors += e[x + i];
                    fourths += f[x + i];
                }
                const float known = biases - (1 + few_pixels * fourths / squares / squares) * std::sqrt(errors);
                to[x] += (known > 0 ? known : 0.f) / squares * d[x];
            }
        }
    });
}

class BiasCorrection {
public:
    BiasCorrection(std::span<float> denoised, const PixelView& rendered, std::span<const Vec3> half_difference, int width, int height,
                   float exposure_scale, const Workers* workers)
        : denoised_(denoised), rendered_(rendered), half_difference_(half_difference), width_(width), height_(height), workers_(workers),
          scale_(half_difference.size()) {
        levels_.emplace_back(width, height);
        while (std::min(levels_.back().width, levels_.back().height) > coarsest_side)
            levels_.emplace_back((levels_.back().width + 1) / 2, (levels_.back().height + 1) / 2);
        const float added = key / exposure_scale;
        for_bands(height, workers, [&](int first, int last) {
            for (size_t i = size_t(first) * size_t(width); i < size_t(last) * size_t(width); ++i)
                scale_[i] = luminance(Vec3{denoised[3 * i], denoised[3 * i + 1], denoised[3 * i + 2]}) + added;
        });
    }

    void run(size_t channel) {
        fill_finest(channel);
        for (size_t l = 0; l + 1 < levels_.size(); ++l) make_coarser(levels_[l], levels_[l + 1], workers_);
        std::ranges::fill(levels_.back().correction, 0.f);
        for (size_t l = levels_.size(); l-- > 0;) {
            if (l + 1 < levels_.size()) predict(levels_[l], levels_[l + 1], workers_);
            shrink(levels_[l], workers_);
        }
        const std::vector<float>& correction = levels_.front().correction;
        for_bands(height_, workers_, [&](int first, int last) {
            for (size_t i = size_t(first) * size_t(width_); i < size_t(last) * size_t(width_); ++i)
                denoised_[3 * i + channel] =
                    std::clamp(denoised_[3 * i + channel] + correction[i] * scale_[i], 0.f, std::numeric_limits<float>::max());
        });
    }

private:
    void fill_finest(size_t channel) {
        Level& level = levels_.front();
        for_bands(height_, workers_, [&](int first, int last) {
            for (size_t i = level.row(first); i < level.row(last); ++i) {
                const Vec3& half = half_difference_[i];
                const float inverse = 1 / scale_[i], rendered = rendered_.values[size_t(rendered_.stride) * i + channel];
                const float difference = (rendered - denoised_[3 * i + channel]) * inverse;
                const float halves = (channel == 0 ? half.x : channel == 1 ? half.y : half.z) * inverse;
                const bool known = std::isfinite(rendered) && std::isfinite(halves);
                level.difference[i] = known ? std::clamp(difference, -most_relative, most_relative) : 0.f;
                level.half[i] = known ? std::clamp(halves, -most_relative, most_relative) : 0.f;
            }
        });
    }

    std::span<float> denoised_;
    const PixelView& rendered_;
    std::span<const Vec3> half_difference_;
    int width_, height_;
    const Workers* workers_;
    std::vector<float> scale_;  // by which differences are divided
    std::vector<Level> levels_; // finest first; the memory of all channels, one after the other
};

} // namespace

void correct_bias(std::span<float> denoised, const PixelView& rendered, std::span<const Vec3> half_difference, int width, int height,
                  float exposure_scale, const Workers* workers) {
    BiasCorrection correction(denoised, rendered, half_difference, width, height, exposure_scale, workers);
    for (size_t channel = 0; channel < 3; ++channel) correction.run(channel);
}

} // namespace blush
