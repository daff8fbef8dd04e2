#include "render/denoise/exposure.h"

#include "core/lanes.h"
#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace blush::denoise {
namespace {

constexpr int block = 16;
constexpr double darkest = 1e-8;
constexpr double key = 0.18;

float finite(float x) { return is_finite(x) ? x : 0.f; }

// Luminance of the finite components. In double, because sums of the largest floats overflow.
double luminance_at(const float* p) { return luminance(Vec3d{finite(p[0]), finite(p[1]), finite(p[2])}); }

struct LogSum {
    double sum = 0;
    int count = 0;
};

} // namespace

float exposure_scale_of(const PixelView& color, int width, int height, const Workers& workers) {
    const int columns = (width + block - 1) / block, rows = (height + block - 1) / block;
    const auto border = [](int side, int index, int count) { return int(int64_t(side) * index / count); };
    std::vector<LogSum> logs(rows);
    workers.for_each(rows, {}, [&](int64_t row, unsigned) {
        const int top = border(height, int(row), rows), bottom = border(height, int(row) + 1, rows);
        std::vector<double> sums(columns);
        for (int y = top; y < bottom; y++)
            for (int column = 0; column < columns; column++)
                for (int x = border(width, column, columns); x < border(width, column + 1, columns); x++)
                    sums[column] += std::max(0.0, luminance_at(&color.values[(size_t(y) * width + x) * color.stride]));
        for (int column = 0; column < columns; column++) {
            const int pixels = (border(width, column + 1, columns) - border(width, column, columns)) * (bottom - top);
            const double mean = sums[column] / pixels;
            if (mean > darkest) logs[row] = {logs[row].sum + std::log2(mean), logs[row].count + 1};
        }
    });
    LogSum all;
    for (const LogSum& row : logs) all = {all.sum + row.sum, all.count + row.count};
    if (all.count == 0) return 1;
    return float(std::clamp(key / std::exp2(all.sum / all.count), double(min_scale_factor), double(max_scale)));
}

Inspection inspect(const PixelView& color, int width, int height, float largest, const Workers& workers) {
    std::vector<Inspection> found(height);
    workers.for_each(height, {}, [&](int64_t y, unsigned) {
        const float* p = &color.values[size_t(y) * width * color.stride];
        const auto usual = [&](float x) { return x >= 0 && x <= largest; };
        for (int x = 0; x < width; x++, p += color.stride) {
            found[y].mean_luminance += luminance_at(p);
            found[y].unusual += !(usual(p[0]) && usual(p[1]) && usual(p[2]));
        }
    });
    Inspection all;
    for (const Inspection& row : found) all = {all.mean_luminance + row.mean_luminance, all.unusual + row.unusual};
    all.mean_luminance /= double(width) * height;
    return all;
}

} // namespace blush::denoise
