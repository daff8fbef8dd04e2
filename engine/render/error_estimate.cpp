#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <experimental/simd>

namespace blush {
namespace {

constexpr int64_t fewest_pixels = 64;
constexpr double fewest_degrees = 20;   // of freedom, by normal errors
constexpr double widest = 10;           // of relmse's interval: high over low
constexpr double brightest_share = 0.3; // of the squared error, that one sample of the brightest pixel may be
// Of the logarithm of relmse with the darkest surroundings over the estimate: one standard deviation.
constexpr double share_of_choice = 0.25;
// Of a pixel in the mean around it, whose other pixels are 24.
constexpr double own_share = 0.2 / 24.2;
// The half with one sample more has less variance than its share if points are well distributed; one standard deviation of what that is
// worth, per difference of the halves' weights. At most 1 for points whose variance falls with the square of their number.
constexpr double share_of_inequality = 0.6;

// Half width of a 95 % interval of the logarithm of F with n degrees of freedom twice, whose variance is about v = 4 / n: within 1 % for n
// >= 2 of tabulated quantiles.
double log_interval(double v) { return 1.96 * std::sqrt(v) * (1 + 0.16 * v); }

// What normal errors whose half difference has this square would have as the variance of their product.
double normal_product(double square) { return 4.0 / 3 * square * square; }

template <class D> D squared(const D& x) { return x * x; }

// The three colours of a pixel side by side, and a 0.
using Rgb = std::experimental::fixed_size_simd<double, 4>;

Rgb rgb(const Vec3d& v) {
    return Rgb([&](auto i) { return i == 0 ? v.x : i == 1 ? v.y : i == 2 ? v.z : 0.0; });
}
Vec3d vec(const Rgb& v) { return {v[0], v[1], v[2]}; }

Rgb over(const Rgb& value) { return 1 / (squared(value) + 0.01); }

} // namespace

void ErrorAccumulator::Sums::add(double square, double product) {
    squares += square;
    fourths += square * square;
    own_products += std::min(squared(product), normal_product(square));
}

void ErrorAccumulator::Sums::merge(const Sums& o) {
    squares += o.squares;
    fourths += o.fourths;
    own_products += o.own_products;
    neighbour_products += o.neighbour_products;
}

ErrorAccumulator::Difference ErrorAccumulator::add_pixel(const PixelHalves& p, const Surroundings& surroundings, int x, int y) {
    const Surroundings::Around around = surroundings.around(x, y);
    const double wa = p.weight_a, wb = 1 - wa;
    const Rgb a = rgb(p.a), b = rgb(p.b), mean = rgb(around.mean), own = wa * a + wb * b;
    const Rgb difference = (a - b) * std::sqrt(wa * wb), square = squared(difference);
    // What relmse divides by: shrinkage as by James and Stein (1961); and the least that it may be.
    const Rgb near = mean + (own - mean) * own_share, off = squared(own - near);
    const Rgb usual = near + (own - near) * max(Rgb(0), 1 - 2 * square / max(off, Rgb(1e-300)));
    const Rgb least = min(usual, max(min(own, rgb(around.darkest)), min(a, b)));
    const Rgb weight = over(usual), product = 4 * wa * wb * (a - mean) * (b - mean);
    const double squares = reduce(square);
    ++pixels_;
    absolute_.add(squares, reduce(product));
    relative_.add(reduce(square * weight), reduce(product * weight));
    relative_high_ += reduce(square * over(least));
    unequal_ += std::abs(wa - wb) * squares;
    brightest_ = std::max(brightest_, reduce(squared(min(a, b))) / squared(double(p.samples)));
    return {true, vec(difference), vec(difference * sqrt(weight))};
}

void ErrorAccumulator::add_neighbours(const Difference& a, const Difference& b) {
    if (!a.known || !b.known) return;
    const auto dot = [](const Vec3d& u, const Vec3d& v) { return u.x * v.x + u.y * v.y + u.z * v.z; };
    absolute_.neighbour_products += 4 * squared(dot(a.absolute, b.absolute));
    relative_.neighbour_products += 4 * squared(dot(a.relative, b.relative));
    ++pairs_;
}

void ErrorAccumulator::lead_in(std::span<const PixelHalves> row, const Surroundings& surroundings, int y) {
    ErrorAccumulator other;
    other.add_row(row, surroundings, y);
    above_ = std::move(other.above_);
}

void ErrorAccumulator::add_row(std::span<const PixelHalves> row, const Surroundings& surroundings, int y) {
    std::vector<Difference> differences(row.size());
    for (size_t x = 0; x < row.size(); ++x) {
        if (!row[x].known) continue;
        differences[x] = add_pixel(row[x], surroundings, int(x), y);
        if (x > 0) add_neighbours(differences[x - 1], differences[x]);
        if (!above_.empty()) add_neighbours(above_[x], differences[x]);
    }
    above_ = std::move(differences);
}

void ErrorAccumulator::merge(const ErrorAccumulator& other) {
    pixels_ += other.pixels_;
    pairs_ += other.pairs_;
    absolute_.merge(other.absolute_);
    relative_.merge(other.relative_);
    relative_high_ += other.relative_high_;
    unequal_ += other.unequal_;
    brightest_ = std::max(brightest_, other.brightest_);
}

// Of the logarithm of true error over estimate, relative variances being small.
double ErrorAccumulator::log_variance(const Sums& sums) const {
    const double neighbours = pairs_ > 0 ? sums.neighbour_products * double(pixels_) / double(pairs_) : 0;
    const auto [less, more] = std::minmax(neighbours, sums.own_products);
    return (more + less / 2) / squared(sums.squares);
}

double ErrorAccumulator::inequality() const { return squared(share_of_inequality * unequal_ / absolute_.squares); }

ErrorEstimate ErrorAccumulator::estimate() const {
    ErrorEstimate e;
    if (pixels_ < fewest_pixels) return e;
    e.known = e.rmse_known = true;
    if (absolute_.squares == 0) return e; // no noise at all

    const double values = 3 * double(pixels_);
    const auto carried_by_many = [](const Sums& s) { return normal_product(1) * s.fourths <= 4 / fewest_degrees * squared(s.squares); };
    const bool brightest_seen = brightest_ <= brightest_share * absolute_.squares;
    const double absolute_width = log_interval(log_variance(absolute_) + inequality());
    e.rmse_known = brightest_seen && carried_by_many(absolute_);
    e.rmse = std::sqrt(absolute_.squares / values);
    e.rmse_low = e.rmse * std::exp(-absolute_width / 2);
    e.rmse_high = e.rmse * std::exp(absolute_width / 2);

    const double choice = share_of_choice * std::log(relative_high_ / relative_.squares);
    const double relative_width = log_interval(log_variance(relative_) + inequality() + squared(choice));
    e.known = brightest_seen && carried_by_many(relative_) && 2 * relative_width <= std::log(widest);
    e.relmse = relative_.squares / values;
    e.low = e.relmse * std::exp(-relative_width);
    e.high = e.relmse * std::exp(relative_width);
    return e;
}

ErrorEstimate widened(const ErrorEstimate& estimate, double sharing) {
    // Widths of logarithms grow by the root of what variances grow by.
    const double k = std::sqrt(std::max(1.0, sharing));
    const auto stretch = [&](double& bound, double about) {
        if (about > 0) bound = about * std::pow(bound / about, k);
    };
    ErrorEstimate e = estimate;
    stretch(e.low, e.relmse);
    stretch(e.high, e.relmse);
    stretch(e.rmse_low, e.rmse);
    stretch(e.rmse_high, e.rmse);
    return e;
}

} // namespace blush
