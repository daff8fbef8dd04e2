#include "measure/metrics/flip.h"

#include "core/srgb.h"
#include "measure/metrics/flip_color.h"
#include "measure/metrics/plane.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace blush {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pixels_per_degree = 0.7 * (3840 / 0.7) * (pi / 180);

using Taps = std::vector<float>;

Taps normalized(std::vector<double> taps) {
    const double sum = std::accumulate(taps.begin(), taps.end(), 0.0);
    Taps result;
    for (const double t : taps) result.push_back(float(t / sum));
    return result;
}

// ---- spatial filter: contrast sensitivity as sums of Gaussians a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees (HPG 2020, table
// 1)

struct Sensitivity {
    double a, b;
};
constexpr Sensitivity achromatic{1, 0.0047}, red_green{1, 0.0053}, blue_yellow[] = {{34.1, 0.04}, {13.5, 0.025}};

struct Gaussian {
    Taps taps;         // 1D filter, sum 1
    double weight = 0; // sum of the 2D kernel before normalisation
};

Gaussian gaussian(const Sensitivity& s) {
    // Common radius of all channels: three standard deviations of the widest.
    const int radius = int(std::ceil(3 * std::sqrt(blue_yellow[0].b / (2 * pi * pi)) * pixels_per_degree));
    std::vector<double> taps;
    for (int x = -radius; x <= radius; ++x) taps.push_back(std::exp(-pi * pi * x * x / (pixels_per_degree * pixels_per_degree * s.b)));
    const double sum = std::accumulate(taps.begin(), taps.end(), 0.0);
    return {normalized(taps), s.a * std::sqrt(pi / s.b) * sum * sum};
}

Plane blurred(const Plane& plane, const Sensitivity& s) {
    const Gaussian g = gaussian(s);
    return filtered(plane, g.taps, g.taps);
}

// A sum of two Gaussians is not separable, but each Gaussian is.
Plane blurred(const Plane& plane, const Sensitivity& s, const Sensitivity& t) {
    const Gaussian g = gaussian(s), h = gaussian(t);
    Plane result = filtered(plane, g.taps, g.taps);
    const Plane other = filtered(plane, h.taps, h.taps);
    const float share = float(g.weight / (g.weight + h.weight));
    for (size_t i = 0; i < result.values.size(); ++i) result.values[i] = share * result.values[i] + (1 - share) * other.values[i];
    return result;
}

// ---- feature detection: edges and points, by derivatives of a Gaussian, 0.082 degrees from peak to trough

struct FeatureTaps {
    Taps smooth, edge, point;
};

// Normalised: positive taps sum to 1, negative ones to -1.
Taps balanced(const std::vector<double>& taps) {
    double positive = 0, negative = 0;
    for (const double t : taps) (t > 0 ? positive : negative) += std::abs(t);
    Taps result;
    for (const double t : taps) result.push_back(float(t > 0 ? t / positive : t / negative));
    return result;
}

FeatureTaps feature_taps() {
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int radius = int(std::ceil(3 * sigma));
    std::vector<double> smooth, edge, point;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2 * sigma * sigma));
        smooth.push_back(g);
        edge.push_back(-x * g);
        point.push_back((x * x / (sigma * sigma) - 1) * g);
    }
    return {normalized(smooth), balanced(edge), balanced(point)};
}

// Length of the gradient-like pair (along x, along y).
Plane feature_strength(const Plane& lightness, const Taps& derivative, const Taps& smooth) {
    Plane x = filtered(lightness, derivative, smooth);
    const Plane y = filtered(lightness, smooth, derivative);
    for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
    return x;
}

// ---- preprocessing of one image

struct Seen {
    std::vector<Vec3> colors; // filtered, in Hunt-adjusted CIELAB
    Plane edges, points;
};

Seen see(const RgbImage& linear) {
    const int w = linear.width, h = linear.height;
    Plane y(w, h), cx(w, h), cz(w, h), lightness(w, h);
    tbb::parallel_for(size_t(0), linear.pixels.size(), [&](size_t i) {
        const Vec3 c = flip::ycxcz_from_xyz(flip::xyz_from_linear(linear.pixels[i]));
        y.values[i] = c.x;
        cx.values[i] = c.y;
        cz.values[i] = c.z;
        lightness.values[i] = (c.x + 16) / 116;
    });
    const FeatureTaps taps = feature_taps();
    Seen seen{std::vector<Vec3>(linear.pixels.size()), feature_strength(lightness, taps.edge, taps.smooth),
              feature_strength(lightness, taps.point, taps.smooth)};
    y = blurred(y, achromatic);
    cx = blurred(cx, red_green);
    cz = blurred(cz, blue_yellow[0], blue_yellow[1]);
    tbb::parallel_for(size_t(0), linear.pixels.size(), [&](size_t i) {
        const Vec3 rgb = flip::linear_from_xyz(flip::xyz_from_ycxcz({y.values[i], cx.values[i], cz.values[i]}));
        const Vec3 inside{std::clamp(rgb.x, 0.f, 1.f), std::clamp(rgb.y, 0.f, 1.f), std::clamp(rgb.z, 0.f, 1.f)};
        seen.colors[i] = flip::hunt_lab_from_xyz(flip::xyz_from_linear(inside));
    });
    return seen;
}

// ---- color and feature pipelines, and their combination

float color_error(const Vec3& lab_a, const Vec3& lab_b) {
    constexpr float exponent = 0.7f;
    static const float largest = std::pow(flip::hyab_distance(flip::hunt_lab_from_xyz(flip::xyz_from_linear({0, 1, 0})),
                                                              flip::hunt_lab_from_xyz(flip::xyz_from_linear({0, 0, 1}))),
                                          exponent);
    // Distances up to 0.4 of the maximum map to the lower 0.95 of the range.
    constexpr float knee = 0.4f, knee_value = 0.95f;
    const float e = std::pow(flip::hyab_distance(lab_a, lab_b), exponent) / largest;
    return e < knee ? knee_value / knee * e : std::min(1.f, knee_value + (e - knee) / (1 - knee) * (1 - knee_value));
}

float feature_error(const Seen& a, const Seen& b, size_t i) {
    const float edges = std::abs(a.edges.values[i] - b.edges.values[i]);
    const float points = std::abs(a.points.values[i] - b.points.values[i]);
    return std::min(1.f, std::sqrt(std::max(edges, points) / std::numbers::sqrt2_v<float>));
}

std::vector<float> flip_of_linear(const RgbImage& reference, const RgbImage& test) {
    const Seen a = see(reference), b = see(test);
    std::vector<float> map(a.colors.size());
    tbb::parallel_for(size_t(0), map.size(), [&](size_t i) {
        const float color = color_error(a.colors[i], b.colors[i]);
        map[i] = color > 0 ? std::pow(color, 1 - feature_error(a, b, i)) : 0.f;
    });
    return map;
}

RgbImage mapped(const RgbImage& image, const auto& of_value) {
    RgbImage result{image.width, image.height, std::vector<Vec3>(image.pixels.size())};
    tbb::parallel_for(size_t(0), image.pixels.size(), [&](size_t i) {
        const Vec3& p = image.pixels[i];
        result.pixels[i] = {of_value(p.x), of_value(p.y), of_value(p.z)};
    });
    return result;
}

// ---- Narkowicz's fit of the ACES filmic curve, (k0 x^2 + k1 x) / (k2 x^2 + k3 x + k4), with its exposure of 0.6 multiplied in

constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k2 = 0.6 * 0.6 * 2.43, k3 = 0.6 * 0.59, k4 = 0.14;

float aces(float value, double gain) {
    const double x = std::max(0.0, double(value)) * gain;
    return float(std::clamp((k0 * x * x + k1 * x) / (k2 * x * x + k3 * x + k4), 0.0, 1.0));
}

double inverse_aces(double y) {
    const double a = k0 - k2 * y, b = k1 - k3 * y, c = -k4 * y;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

double median(std::vector<float>& values) {
    const size_t half = values.size() / 2;
    std::nth_element(values.begin(), values.begin() + ptrdiff_t(half), values.end());
    if (values.size() % 2 == 1) return values[half];
    return 0.5 * (double(values[half]) + *std::max_element(values.begin(), values.begin() + ptrdiff_t(half)));
}

} // namespace

std::vector<float> ldr_flip(const RgbImage& reference, const RgbImage& test) {
    const auto linear = [](float v) { return linear_from_srgb(std::clamp(v, 0.f, 1.f)); };
    return flip_of_linear(mapped(reference, linear), mapped(test, linear));
}

ExposureRange hdr_flip_exposures(const RgbImage& reference) {
    std::vector<float> luminances;
    for (const Vec3& p : reference.pixels)
        luminances.push_back(0.2126f * std::max(0.f, p.x) + 0.7152f * std::max(0.f, p.y) + 0.0722f * std::max(0.f, p.z));
    if (luminances.empty()) return {};
    const double brightest = *std::max_element(luminances.begin(), luminances.end());
    if (!(brightest > 0)) return {};
    double middle = median(luminances);
    if (!(middle > 0)) {
        // The median is black and cannot be exposed to white: use the median of the other pixels.
        std::erase_if(luminances, [](float y) { return !(y > 0); });
        middle = median(luminances);
    }
    const double below_white = inverse_aces(0.85);
    ExposureRange range;
    range.start = std::log2(below_white / brightest);
    range.stop = std::log2(below_white / middle);
    range.count = std::max(2, int(std::ceil(range.stop - range.start)));
    return range;
}

std::vector<float> hdr_flip(const RgbImage& reference, const RgbImage& test) {
    const ExposureRange range = hdr_flip_exposures(reference);
    std::vector<float> largest(reference.pixels.size(), 0.f);
    for (int i = 0; i < range.count; ++i) {
        const double stops = range.start + i * (range.stop - range.start) / std::max(range.count - 1, 1);
        const auto tone_mapped = [gain = std::exp2(stops)](float v) { return aces(v, gain); };
        const std::vector<float> map = flip_of_linear(mapped(reference, tone_mapped), mapped(test, tone_mapped));
        for (size_t k = 0; k < map.size(); ++k) largest[k] = std::max(largest[k], map[k]);
    }
    return largest;
}

FlipNumbers flip_numbers(std::span<const float> map) {
    FlipNumbers n;
    if (map.empty()) return n;
    std::vector<float> sorted(map.begin(), map.end());
    std::ranges::sort(sorted);
    const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0), count = double(sorted.size());
    n.mean = sum / count;
    n.largest = sorted.back();
    n.share_noticeable = double(sorted.end() - std::ranges::upper_bound(sorted, FlipNumbers::noticeable)) / count;
    double below = 0;
    size_t next = 0;
    double* const quartiles[] = {&n.first_quartile, &n.median, &n.third_quartile};
    for (const float value : sorted)
        for (below += value; next < 3 && value > 0 && below >= 0.25 * double(next + 1) * sum; ++next) *quartiles[next] = value;
    return n;
}

} // namespace blush
