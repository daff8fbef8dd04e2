#include "measure/statistics/bias_test.h"

#include "core/math.h"
#include "measure/statistics/intervals.h"
#include "measure/statistics/significance.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace blush {
namespace {

constexpr int min_region = 16, max_regions = 8; // pixels, along each side

struct Rectangle {
    int left, top, right, bottom;
    double pixels() const { return double(right - left) * double(bottom - top); }
};

// Sum of the pixel variances of a region, and sum of their squares.
struct Variances {
    double sum = 0, squares = 0;
    void add(double v) { sum += v, squares += v * v; }
};

// Two images of equal size.
class Comparison {
public:
    // `weights` of pixels, with mean 1 over the region.
    Comparison(const MeasuredImage& image, const MeasuredImage& reference, double level, std::vector<double> weights)
        : image_(image), reference_(reference), events_(-std::log(level)), weights_(std::move(weights)) {}

    RegionBias measure(const Rectangle& r) const {
        RegionBias bias{r.left, r.top, r.right - r.left, r.bottom - r.top};
        double off = 0;
        for_each_pixel(r, [&](size_t i) {
            bias.reference += weights_[i] * luminance(to_double(reference_.image.pixels[i]));
            off += weights_[i] * difference(i);
        });
        const double n = r.pixels();
        bias.reference /= n;
        bias.mean = bias.reference + off / n;
        const Variances v = variances(r, off / n);
        bias.error = std::sqrt(v.sum) / n;
        bias.degrees = v.squares > 0 ? v.sum * v.sum / v.squares : 0;
        bias.possible_deficit = events_ * brightest_around(r, 1) / n;
        bias.possible_excess = events_ * brightest_around(r, -1) / n;
        return bias;
    }

private:
    template <class Visit> void for_each_pixel(const Rectangle& r, const Visit& visit) const {
        for (int y = r.top; y < r.bottom; ++y)
            for (int x = r.left; x < r.right; ++x) visit(size_t(y) * size_t(image_.image.width) + size_t(x));
    }
    double difference(size_t i) const {
        return luminance(to_double(image_.image.pixels[i])) - luminance(to_double(reference_.image.pixels[i]));
    }

    // The maximum of the three estimates.
    Variances variances(const Rectangle& r, double mean_difference) const {
        const double fewer = double(reference_.samples) / double(std::max<int64_t>(1, image_.samples));
        Variances own, as_reference, seen;
        for_each_pixel(r, [&](size_t i) {
            const double a = luminance(to_double(image_.error[i])), b = luminance(to_double(reference_.error[i])),
                         off = difference(i) - mean_difference;
            const double w = weights_[i] * weights_[i];
            own.add(w * (a * a + b * b));
            as_reference.add(w * b * b * (fewer + 1));
            seen.add(w * off * off);
        });
        Variances v = std::max({own, as_reference, seen}, [](const Variances& a, const Variances& b) { return a.sum < b.sum; });
        // Accounts for pixels with common errors.
        v.sum *= image_.variance_factor;
        v.squares *= image_.variance_factor * image_.variance_factor * image_.variance_factor;
        return v;
    }

    // Excess of the brightest pixel of a region and its neighbours over the reference, beyond normal noise; with sign -1 of the reference
    // over the image, as far as the reference is noisy there: the rest is a difference that its noise does not explain.
    double brightest_around(const Rectangle& r, double sign) const {
        const int w = r.right - r.left, h = r.bottom - r.top;
        const Rectangle around{std::max(0, r.left - w), std::max(0, r.top - h), std::min(image_.image.width, r.right + w),
                               std::min(image_.image.height, r.bottom + h)};
        double brightest = 0, own = 0, seen = 0;
        for_each_pixel(around, [&](size_t i) {
            const double weight = weights_[i], off = weight * difference(i);
            const double a = weight * luminance(to_double(image_.error[i])), b = weight * luminance(to_double(reference_.error[i]));
            brightest = std::max(brightest, sign > 0 ? off : std::min(-off, b));
            own += a * a + b * b;
            seen += off * off;
        });
        const double n = around.pixels();
        return std::max(0.0, brightest - std::sqrt(2 * std::log(n) * std::max(own, seen) / n));
    }

    const MeasuredImage &image_, &reference_;
    double events_;
    std::vector<double> weights_;
};

// Lower bound of a region's variance, relative to the mean of all: no region may dominate.
constexpr double min_variance = 0.1;

// Pixel weights: the inverse variance of their region in the reference, normalised to mean 1.
std::vector<double> inverse_variances(const MeasuredImage& reference, const std::vector<Rectangle>& regions) {
    std::vector<double> weights(reference.error.size(), 1);
    const auto each_pixel = [&](const Rectangle& r, const auto& visit) {
        for (int y = r.top; y < r.bottom; ++y)
            for (int x = r.left; x < r.right; ++x) visit(size_t(y) * size_t(reference.image.width) + size_t(x));
    };
    std::vector<double> variances;
    double mean = 0;
    for (const Rectangle& r : regions) {
        double sum = 0;
        each_pixel(r, [&](size_t i) { sum += luminance(to_double(reference.error[i])) * luminance(to_double(reference.error[i])); });
        mean += sum / double(weights.size());
        variances.push_back(sum / r.pixels());
    }
    if (!(mean > 0)) return weights;
    double total = 0;
    for (size_t k = 0; k < regions.size(); ++k) {
        const double weight = 1 / (variances[k] + min_variance * mean);
        each_pixel(regions[k], [&](size_t i) { weights[i] = weight; });
        total += weight * regions[k].pixels();
    }
    for (double& w : weights) w *= double(weights.size()) / total;
    return weights;
}

int regions_along(int size) { return std::clamp(size / min_region, 1, max_regions); }

} // namespace

double RegionBias::difference() const {
    const double d = mean - reference;
    return d < 0 ? std::min(0.0, d + possible_deficit) : std::max(0.0, d - possible_excess);
}

double RegionBias::z() const { return error > 0 ? normal_deviate(difference() / error, degrees) : 0; }

bool BiasTest::is_biased(const RegionBias& r) const {
    const bool beyond_noise = r.error > 0 ? std::abs(r.z()) > threshold : r.mean != r.reference;
    return beyond_noise && std::abs(r.mean - r.reference) > rounding * r.reference;
}

MeasuredImage merged(const MeasuredImage& a, const MeasuredImage& b) {
    if (a.samples == 0) return b;
    if (b.samples == 0) return a;
    MeasuredImage m = a;
    m.samples = a.samples + b.samples;
    m.variance_factor = std::max(a.variance_factor, b.variance_factor);
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
    std::vector<Rectangle> regions;
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i)
            regions.push_back({i * width / across, j * height / down, (i + 1) * width / across, (j + 1) * height / down});
    const Rectangle whole{0, 0, width, height};
    test.rounding = rounding;
    test.threshold = significant_deviate(across * down + 2, bias_significance);
    const double level = normal_two_sided(test.threshold);
    const Comparison plain(image, reference, level, std::vector<double>(image.error.size(), 1));
    const Comparison weighted(image, reference, level, inverse_variances(reference, regions));
    const auto consider = [&](const RegionBias& r) {
        if (std::abs(r.z()) >= std::abs(test.worst.z())) test.worst = r;
        test.biased |= test.is_biased(r);
    };
    consider(test.whole = plain.measure(whole));
    test.pooled = weighted.measure(whole);
    // Regions where the reference has missed rare bright samples have the most weight: pooled, it is too dark by an unknown amount.
    if (test.whole.possible_excess > 0) test.pooled.possible_excess = infinity;
    consider(test.pooled);
    for (const Rectangle& r : regions) {
        test.regions.push_back(plain.measure(r));
        consider(test.regions.back());
    }
    return test;
}

} // namespace blush
