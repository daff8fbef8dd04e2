#include "measure/bias_test.h"

#include "measure/intervals.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int smallest_region = 16, most_regions = 8; // pixels, along each side

double luminance(const Vec3& c) { return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z); }

// Of the variances of a region's pixels: their sum, and that of their squares.
struct Variances {
    double sum = 0, squares = 0;
    void add(double v) { sum += v, squares += v * v; }
};

RegionBias measure(RegionBias r, const MeasuredImage& image, const MeasuredImage& reference) {
    const double fewer = double(reference.samples) / double(std::max<int64_t>(1, image.samples));
    Variances own, as_reference;
    for (int y = r.y; y < r.y + r.height; ++y) {
        for (int x = r.x; x < r.x + r.width; ++x) {
            const size_t i = size_t(y) * size_t(image.image.width) + size_t(x);
            r.mean += luminance(image.image.pixels[i]);
            r.reference += luminance(reference.image.pixels[i]);
            const double a = luminance(image.error[i]), b = luminance(reference.error[i]);
            own.add(a * a + b * b);
            as_reference.add(b * b * (fewer + 1));
        }
    }
    const Variances& larger = own.sum >= as_reference.sum ? own : as_reference;
    const double n = double(r.width) * double(r.height);
    r.mean /= n;
    r.reference /= n;
    r.error = std::sqrt(larger.sum) / n;
    r.degrees = larger.squares > 0 ? larger.sum * larger.sum / larger.squares : 0;
    return r;
}

int regions_along(int size) { return std::clamp(size / smallest_region, 1, most_regions); }

} // namespace

double RegionBias::z() const {
    if (!(error > 0) || !(degrees > 0)) return 0;
    // Student's t as a normal deviate (Wallace 1959).
    const double t = (mean - reference) / error;
    return std::copysign((8 * degrees + 1) / (8 * degrees + 3) * std::sqrt(degrees * std::log1p(t * t / degrees)), t);
}

MeasuredImage merged(const MeasuredImage& a, const MeasuredImage& b) {
    if (a.samples == 0) return b;
    if (b.samples == 0) return a;
    MeasuredImage m = a;
    m.samples = a.samples + b.samples;
    const float wa = float(double(a.samples) / double(m.samples)), wb = 1 - wa;
    const auto mean = [&](float x, float y) { return wa * x + wb * y; };
    const auto error = [&](float x, float y) { return std::hypot(wa * x, wb * y); };
    for (size_t i = 0; i < m.image.pixels.size(); ++i) {
        const Vec3 &p = a.image.pixels[i], &q = b.image.pixels[i], &e = a.error[i], &f = b.error[i];
        m.image.pixels[i] = {mean(p.x, q.x), mean(p.y, q.y), mean(p.z, q.z)};
        m.error[i] = {error(e.x, f.x), error(e.y, f.y), error(e.z, f.z)};
    }
    return m;
}

BiasTest test_bias(const MeasuredImage& image, const MeasuredImage& reference, double rounding) {
    BiasTest test;
    const int width = image.image.width, height = image.image.height;
    if (width < 1 || height < 1 || reference.image.width != width || reference.image.height != height) return test;
    if (image.error.size() != image.image.pixels.size() || reference.error.size() != image.error.size()) return test;
    const int across = regions_along(width), down = regions_along(height);
    const double tests = across * down + 1;
    test.threshold = normal_quantile_two_sided(-std::expm1(std::log1p(-bias_significance) / tests));
    const auto consider = [&](const RegionBias& r) {
        if (std::abs(r.z()) >= std::abs(test.worst.z())) test.worst = r;
        const bool beyond_noise = r.error > 0 ? std::abs(r.z()) > test.threshold : r.mean != r.reference;
        test.biased |= beyond_noise && std::abs(r.mean - r.reference) > rounding * r.reference;
    };
    test.whole = measure({0, 0, width, height}, image, reference);
    consider(test.whole);
    for (int j = 0; j < down; ++j) {
        for (int i = 0; i < across; ++i) {
            const int x = i * width / across, y = j * height / down;
            test.regions.push_back(measure({x, y, (i + 1) * width / across - x, (j + 1) * height / down - y}, image, reference));
            consider(test.regions.back());
        }
    }
    return test;
}

} // namespace blush
