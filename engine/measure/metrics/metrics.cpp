#include "measure/metrics/metrics.h"

#include "core/srgb.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush {
namespace {

constexpr float Vec3::*channels[] = {&Vec3::x, &Vec3::y, &Vec3::z};

bool is_finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Sums of one row; rows are added in order, so that the result does not depend on the threads.
struct Sums {
    double squared = 0, relative = 0, absolute = 0, display_squared = 0, largest = 0;
    std::array<double, 3> a{}, b{};
    int64_t pixels = 0, nonfinite_a = 0, nonfinite_b = 0;

    void add(const Sums& o) {
        squared += o.squared;
        relative += o.relative;
        absolute += o.absolute;
        display_squared += o.display_squared;
        largest = std::max(largest, o.largest);
        for (size_t c = 0; c < 3; ++c) a[c] += o.a[c], b[c] += o.b[c];
        pixels += o.pixels;
        nonfinite_a += o.nonfinite_a;
        nonfinite_b += o.nonfinite_b;
    }
};

float to_display(float value, Encoding encoding) {
    const float clamped = std::clamp(value, 0.f, 1.f);
    return encoding == Encoding::display ? clamped : srgb_from_linear(clamped);
}

void add_pixel(Sums& sums, const Vec3& a, const Vec3& b, Encoding encoding) {
    ++sums.pixels;
    for (size_t c = 0; c < 3; ++c) {
        const double va = a.*channels[c], vb = b.*channels[c];
        const double difference = va - vb;
        sums.squared += difference * difference;
        sums.relative += difference * difference / (vb * vb + 0.01);
        sums.absolute += std::abs(difference);
        sums.largest = std::max(sums.largest, std::abs(difference));
        const double seen = to_display(float(va), encoding) - to_display(float(vb), encoding);
        sums.display_squared += seen * seen;
        sums.a[c] += va;
        sums.b[c] += vb;
    }
}

Sums sum_rows(RgbImage& a, RgbImage& b, Encoding encoding, std::vector<uint8_t>& left_out) {
    std::vector<Sums> rows(static_cast<size_t>(a.height));
    tbb::parallel_for(0, a.height, [&](int y) {
        Sums& row = rows[size_t(y)];
        for (size_t i = size_t(y) * size_t(a.width), end = i + size_t(a.width); i < end; ++i) {
            const bool finite_a = is_finite(a.pixels[i]), finite_b = is_finite(b.pixels[i]);
            row.nonfinite_a += !finite_a;
            row.nonfinite_b += !finite_b;
            if (finite_a && finite_b) {
                add_pixel(row, a.pixels[i], b.pixels[i], encoding);
            } else {
                left_out[i] = 1;
                a.pixels[i] = b.pixels[i] = {0, 0, 0};
            }
        }
    });
    Sums sums;
    for (const Sums& row : rows) sums.add(row);
    return sums;
}

FlipNumbers measured_flip(const RgbImage& a, const RgbImage& b, Encoding encoding, const std::vector<uint8_t>& left_out) {
    std::vector<float> map = encoding == Encoding::display ? ldr_flip(b, a) : hdr_flip(b, a);
    size_t kept = 0;
    for (size_t i = 0; i < map.size(); ++i)
        if (!left_out[i]) map[kept++] = map[i];
    return flip_numbers({map.data(), kept});
}

} // namespace

Result<Metrics> compare(const RgbImage& a, const RgbImage& b, Encoding encoding, bool with_flip) {
    if (a.width != b.width || a.height != b.height)
        return Error{.what = fmt::format("the images differ in size: {}x{} and {}x{}", a.width, a.height, b.width, b.height)};
    // Pixels that are not finite in one image are set to black in both, so that FLIP's filters neither spread them nor detect an
    // edge.
    RgbImage clean_a = a, clean_b = b;
    std::vector<uint8_t> left_out(a.pixels.size(), 0);
    const Sums sums = sum_rows(clean_a, clean_b, encoding, left_out);
    if (sums.pixels == 0) return Error{.what = "no pixel is finite in both images"};

    const double values = 3 * double(sums.pixels);
    Metrics m;
    m.mse = sums.squared / values;
    m.rmse = std::sqrt(m.mse);
    m.relmse = sums.relative / values;
    m.mae = sums.absolute / values;
    const double display_mse = sums.display_squared / values;
    m.psnr = display_mse > 0 ? -10 * std::log10(display_mse) : std::numeric_limits<double>::infinity();
    m.max_abs = sums.largest;
    for (size_t c = 0; c < 3; ++c) {
        m.mean_a[c] = sums.a[c] / double(sums.pixels);
        m.mean_b[c] = sums.b[c] / double(sums.pixels);
    }
    m.nonfinite_a = sums.nonfinite_a;
    m.nonfinite_b = sums.nonfinite_b;
    if (with_flip) m.flip = measured_flip(clean_a, clean_b, encoding, left_out);
    return m;
}

} // namespace blush
