#include "measure/bias_test.h"

#include "measure/intervals.h"
#include "measure/significance.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int smallest_region = 16, most_regions = 8; // pixels, along each side

double luminance(const Vec3& c) { return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z); }

struct Rectangle {
    int left, top, right, bottom;
    double pixels() const { return double(right - left) * double(bottom - top); }
};

// Of the variances of a region's pixels: their sum, and that of their squares.
struct Variances {
    double sum = 0, squares = 0;
    void add(double v) { sum += v, squares += v * v; }
};

// Two pictures of one size.
class Comparison {
public:
    Comparison(const MeasuredImage& image, const MeasuredImage& reference, double level)
        : image_(image), reference_(reference), events_(-std::log(level)) {}

    RegionBias measure(const Rectangle& r) const {
        RegionBias bias{r.left, r.top, r.right - r.left, r.bottom - r.top};
        double off = 0;
        for_each_pixel(r, [&](size_t i) {
            bias.reference += luminance(reference_.image.pixels[i]);
            off += difference(i);
        });
        const double n = r.pixels();
        bias.reference /= n;
        bias.mean = bias.reference + off / n;
        const Variances v = variances(r, off / n);
        bias.error = std::sqrt(v.sum) / n;
        bias.degrees = v.squares > 0 ? v.sum * v.sum / v.squares : 0;
        bias.unseen = events_ * brightest_around(r) / n;
        return bias;
    }

private:
    template <class Visit> void for_each_pixel(const Rectangle& r, const Visit& visit) const {
        for (int y = r.top; y < r.bottom; ++y)
            for (int x = r.left; x < r.right; ++x) visit(size_t(y) * size_t(image_.image.width) + size_t(x));
    }
    double difference(size_t i) const { return luminance(image_.image.pixels[i]) - luminance(reference_.image.pixels[i]); }

    // The largest of the three.
    Variances variances(const Rectangle& r, double mean_difference) const {
        const double fewer = double(reference_.samples) / double(std::max<int64_t>(1, image_.samples));
        Variances own, as_reference, seen;
        for_each_pixel(r, [&](size_t i) {
            const double a = luminance(image_.error[i]), b = luminance(reference_.error[i]), off = difference(i) - mean_difference;
            own.add(a * a + b * b);
            as_reference.add(b * b * (fewer + 1));
            seen.add(off * off);
        });
        Variances v = std::max({own, as_reference, seen}, [](const Variances& a, const Variances& b) { return a.sum < b.sum; });
        // So many pixels err as one.
        v.sum *= image_.sharing;
        v.squares *= image_.sharing * image_.sharing * image_.sharing;
        return v;
    }

    // By how much the brightest pixel of a region and its neighbours is above the reference, beyond normal noise.
    double brightest_around(const Rectangle& r) const {
        const int w = r.right - r.left, h = r.bottom - r.top;
        const Rectangle around{std::max(0, r.left - w), std::max(0, r.top - h), std::min(image_.image.width, r.right + w),
                               std::min(image_.image.height, r.bottom + h)};
        double brightest = 0, own = 0, seen = 0;
        for_each_pixel(around, [&](size_t i) {
            const double a = luminance(image_.error[i]), b = luminance(reference_.error[i]), off = difference(i);
            brightest = std::max(brightest, off);
            own += a * a + b * b;
            seen += off * off;
        });
        const double n = around.pixels();
        return std::max(0.0, brightest - std::sqrt(2 * std::log(n) * std::max(own, seen) / n));
    }

    const MeasuredImage &image_, &reference_;
    double events_;
};

int regions_along(int size) { return std::clamp(size / smallest_region, 1, most_regions); }

} // namespace

double RegionBias::difference() const {
    const double d = mean - reference;
    return d < 0 ? std::min(0.0, d + unseen) : d;
}

double RegionBias::z() const { return error > 0 ? normal_deviate(difference() / error, degrees) : 0; }

MeasuredImage merged(const MeasuredImage& a, const MeasuredImage& b) {
    if (a.samples == 0) return b;
    if (b.samples == 0) return a;
    MeasuredImage m = a;
    m.samples = a.samples + b.samples;
    m.sharing = std::max(a.sharing, b.sharing);
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
    test.threshold = significant_deviate(across * down + 1, bias_significance);
    const Comparison comparison(image, reference, normal_two_sided(test.threshold));
    const auto consider = [&](const RegionBias& r) {
        if (std::abs(r.z()) >= std::abs(test.worst.z())) test.worst = r;
        const bool beyond_noise = r.error > 0 ? std::abs(r.z()) > test.threshold : r.mean != r.reference;
        test.biased |= beyond_noise && std::abs(r.mean - r.reference) > rounding * r.reference;
    };
    test.whole = comparison.measure({0, 0, width, height});
    consider(test.whole);
    for (int j = 0; j < down; ++j) {
        for (int i = 0; i < across; ++i) {
            test.regions.push_back(
                comparison.measure({i * width / across, j * height / down, (i + 1) * width / across, (j + 1) * height / down}));
            consider(test.regions.back());
        }
    }
    return test;
}

} // namespace blush
