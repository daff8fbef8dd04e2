#include "render/error/error_sums.h"

#include "render/error/neighborhood_filter.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Weight of a pixel in its own neighbourhood mean, which has 24 other pixels.
constexpr float own_share = 0.2f / 24.2f;
// Values whose fourth powers (also of values a thousand times smaller) fit into single precision.
constexpr double max_value = 0x1p28, min_value = 0x1p-16;
constexpr double target_value = 0x1p16; // the middle of that range
// A squared half difference that is this many times the mean of those around it is one of a firefly.
constexpr float firefly_ratio = 25;
// With fewer samples in a pixel its other half knows too little.
constexpr float min_samples = 16;
// The divisor of relmse is that of the half without the firefly, but not smaller than this share of the neighbourhood's value: at
// the edge of a lamp the darker half may have missed the lamp.
constexpr float least_share = 1.f / 3;
// At the straight edge of a lamp, two of the eight other pixels of the darkest block are within it; of pixels further inside, three or
// more.
constexpr float edge_share = 0.3f;

double total(const Wide& v) { return double(v[0] + v[1]) + double(v[2] + v[3]); }
double largest_of(const Wide& v) { return double(std::max(std::max(v[0], v[1]), std::max(v[2], v[3]))); }

// The divisor of relmse for scaled values, scaled so that neither of its two parts overflows.
struct Divisor {
    float of_square, constant;
    double factor; // of a sum of quotients

    // value^2 + 0.01, for values multiplied by `scale`.
    explicit Divisor(double scale) {
        const double floor = 0.01 * scale * scale, most = std::max(1.0, floor);
        of_square = float(1 / most);
        constant = std::max(float(floor / most), 1e-36f);
        factor = 1 / most;
    }
    Wide weight(const Wide& value) const { return 1 / (squared(value) * of_square + constant); }
};

// A pixel's value as the divisor of relmse takes it.
struct Shrunk {
    Wide near;        // the neighbourhood mean
    Wide kept;        // share of the pixel's deviation from it that is more than noise (James and Stein 1961)
    Wide value;       // near + (pixel - near) * kept
    WideMask firefly; // where the half without the firefly stands for the pixel
    // The same with `brighter` times the neighbourhood mean.
    Wide brighter_value() const { return select(firefly, value * brighter, value + (brighter - 1) * near * (1 - kept)); }
};

// Half differences of a row: absolute, and divided by the divisor of relmse.
struct Differences {
    ChannelRows absolute, relative;
    PixelRow known;
    explicit Differences(int width) : known(width) { absolute.fill(known), relative.fill(known); }
};

// Sums over channels for each pixel of a row.
struct PixelSums {
    PixelRow squares, relative, products, relative_products, high, dark, dark_at_edges, loss;
    explicit PixelSums(int width)
        : squares(width), relative(width), products(width), relative_products(width), high(width), dark(width), dark_at_edges(width),
          loss(width) {}
    void clear() {
        for (PixelRow* row : {&squares, &relative, &products, &relative_products, &high, &dark, &dark_at_edges, &loss}) row->clear();
    }
};

// Sums of a row in single precision.
struct RowSums {
    struct Weighted {
        Wide squares{}, fourths{}, own_products{}, neighbour_products{};
        void add(const Wide& square, const Wide& product) {
            squares += square;
            fourths += squared(square);
            own_products += min(squared(product), normal_product(square));
        }
    };
    Weighted absolute, relative;
    Wide loss{}, loss_squares{}, other_half{}, around{}; // of outliers
    Wide relative_high{}, unequal{}, brightest{}, brightest_emission{}, largest{}, pixels{}, pairs{};
};

class BandSummer {
public:
    BandSummer(const HalfBufferImage& image, double scale)
        : image_(image), scale_(scale), divisor_(scale), neighborhood_(image.width, image.height), noise_(image.width, image.height),
          above_(image.width), now_(image.width), around_{PixelRow(image.width), PixelRow(image.width)}, noise_around_(around_),
          root_(image.width), pixels_(image.width) {
        rows_.fill(HalfBufferRow(image.width));
        for (ChannelRows& squares : squares_) squares.fill(PixelRow(image.width));
    }

    ErrorSums sum(int first, int last) {
        const int lead_in = std::max(0, first - 1); // its differences are the upper neighbours of the first row
        loaded_ = std::max(0, lead_in - 2);
        for (int y = lead_in; y < last; ++y) {
            for (; loaded_ < std::min(image_.height, y + 3); ++loaded_) load_row(loaded_);
            RowSums row;
            add_pixels(y, row);
            if (y >= first) {
                add_neighbours(row, y > lead_in);
                take(row);
            }
            std::swap(above_, now_);
        }
        return sums_;
    }

private:
    static constexpr int kept = 4; // rows: the current one and two below

    HalfBufferRow& row_at(int y) { return rows_[size_t(y % kept)]; }

    void load_row(int y) {
        HalfBufferRow& row = row_at(y);
        image_.load(y, float(scale_), row);
        ChannelRows& squares = squares_[size_t(y % kept)];
        const float* const from_weight_a = row.weight_a.pixels();
        for (size_t c = 0; c < 3; ++c) {
            const float *const a = row.a[c].pixels(), *const b = row.b[c].pixels();
            float* const to = squares[c].pixels();
            for (int x = 0; x < image_.width; x += PixelRow::step) {
                const Wide wa = load<Wide>(from_weight_a + x);
                store(to + x, squared(load<Wide>(a + x) - load<Wide>(b + x)) * (wa * (1 - wa)));
            }
        }
        neighborhood_.add_row(row.own, y);
        noise_.add_row(squares, y);
    }

    // Also leaves the row's differences in now_.
    void add_pixels(int y, RowSums& sums) {
        const HalfBufferRow& row = row_at(y);
        now_.known = row.known;
        pixels_.clear();
        const float* const from_weight_a = row.weight_a.pixels();
        float* const to_root = root_.pixels();
        for (int x = 0; x < image_.width; x += PixelRow::step) {
            const Wide wa = load<Wide>(from_weight_a + x);
            store(to_root + x, sqrt(wa * (1 - wa)));
        }
        for (size_t c = 0; c < 3; ++c) {
            const PixelRow& squares = squares_[size_t(y % kept)][c];
            neighborhood_.means(c, y, row.own[c], around_);
            noise_.means(c, y, squares, noise_around_);
            add_channel(row, squares, c, sums);
        }
        const float *const squares = pixels_.squares.pixels(), *const relative = pixels_.relative.pixels();
        const float *const products = pixels_.products.pixels(), *const relative_products = pixels_.relative_products.pixels();
        const float *const high = pixels_.high.pixels(), *const dark = pixels_.dark.pixels(), *const losses = pixels_.loss.pixels();
        const float* const dark_at_edges = pixels_.dark_at_edges.pixels();
        const float *const one_sample = row.one_sample.pixels(), *const known = row.known.pixels();
        const float* const one_emission_sample = row.one_emission_sample.pixels();
        for (int x = 0; x < image_.width; x += PixelRow::step) {
            const Wide square = load<Wide>(squares + x);
            sums.absolute.add(square, load<Wide>(products + x));
            sums.relative.add(load<Wide>(relative + x), load<Wide>(relative_products + x));
            sums.relative_high += load<Wide>(high + x);
            sums.unequal += abs(2 * load<Wide>(from_weight_a + x) - 1) * square;
            sums.brightest = max(sums.brightest, load<Wide>(dark + x) * squared(load<Wide>(one_sample + x)));
            sums.brightest_emission =
                max(sums.brightest_emission, load<Wide>(dark_at_edges + x) * squared(load<Wide>(one_emission_sample + x)));
            sums.pixels += load<Wide>(known + x);
            const Wide loss = load<Wide>(losses + x);
            sums.loss += loss;
            sums.loss_squares += squared(loss);
        }
    }

    void add_channel(const HalfBufferRow& row, const PixelRow& row_squares, size_t c, RowSums& sums) {
        const float *const from_a = row.a[c].pixels(), *const from_b = row.b[c].pixels(), *const from_own = row.own[c].pixels();
        const float *const from_squares = row_squares.pixels(), *const noises = noise_around_.mean.pixels();
        const float *const one_sample = row.one_sample.pixels(), *const known = row.known.pixels();
        const float *const roots = root_.pixels(), *const means = around_.mean.pixels(), *const darkest = around_.darkest.pixels();
        float *const to_absolute = now_.absolute[c].pixels(), *const to_relative = now_.relative[c].pixels();
        float *const squares = pixels_.squares.pixels(), *const relative = pixels_.relative.pixels();
        float *const products = pixels_.products.pixels(), *const relative_products = pixels_.relative_products.pixels();
        float *const high = pixels_.high.pixels(), *const dark = pixels_.dark.pixels(), *const loss = pixels_.loss.pixels();
        float* const dark_at_edges = pixels_.dark_at_edges.pixels();
        const auto add = [](float* to, const Wide& v) { store(to, load<Wide>(to) + v); };
        const Divisor divisor = divisor_;
        Wide largest = sums.largest;
        for (int x = 0; x < image_.width; x += PixelRow::step) {
            const Wide a = load<Wide>(from_a + x), b = load<Wide>(from_b + x), own = load<Wide>(from_own + x), mean = load<Wide>(means + x);
            const Wide root = load<Wide>(roots + x), difference = (a - b) * root, square = load<Wide>(from_squares + x);
            // `usual`: value in the divisor of relmse; `least`: its lower bound.
            const Wide noise = load<Wide>(noises + x), darker = min(a, b);
            const WideMask firefly = (square > firefly_ratio * noise) & (load<Wide>(one_sample + x) <= 1 / min_samples);
            const Shrunk usual = shrink(own, darker, mean, square, noise, firefly);
            const Wide least = min(usual.value, max(min(own, load<Wide>(darkest + x)), darker));
            const Wide weight = divisor.weight(usual.value), ab = 4 * squared(root) * (a - mean) * (b - mean);
            store(to_absolute + x, difference);
            store(to_relative + x, difference * sqrt(weight));
            add(squares + x, square);
            add(relative + x, square * weight);
            add(products + x, ab);
            add(relative_products + x, ab * weight);
            add(high + x, square * divisor.weight(least));
            add(dark + x, squared(darker));
            add(dark_at_edges + x, select(load<Wide>(darkest + x) < own * edge_share, squared(darker), Wide(0.f)));
            largest = max(largest, own);
            const Wide threshold = select(load<Wide>(known + x) > 0, outlier_ratio * mean, max(a, b));
            const WideMask is_outlier = max(a, b) > threshold;
            if (!any(is_outlier)) continue;
            add(loss + x, select(is_outlier, square * (weight - divisor.weight(usual.brighter_value())), Wide(0.f)));
            add_outlier(a, b, mean, a > threshold, sums);
            add_outlier(b, a, mean, b > threshold, sums);
        }
        sums.largest = largest;
    }

    // The pixel's value by James-Stein shrinkage (1961), or, if one half has a firefly, that of the darker half in the same way.
    static Shrunk shrink(const Wide& own, const Wide& darker, const Wide& mean, const Wide& variance, const Wide& noise,
                         const WideMask& firefly) {
        const Wide near = mean + (own - mean) * own_share;
        const auto kept = [&](const Wide& value, const Wide& v) {
            return max(Wide(0.f), 1 - 2 * v / max(squared(value - near), Wide(1e-36f)));
        };
        const Wide of_pixel = kept(own, variance), value = near + (own - near) * of_pixel;
        const Wide of_half = min(value, max(near + (darker - near) * kept(darker, noise), value * least_share));
        return {near, of_pixel, select(firefly, of_half, value), firefly};
    }

    // If this half of a pixel is an outlier: how bright is the other half? Weighted as relmse does, with the mean around as divisor, by 1
    // at most, so that no firefly decides alone.
    void add_outlier(const Wide& half, const Wide& other, const Wide& mean, const WideMask& is_outlier, RowSums& sums) const {
        const Wide divided = divisor_.weight(mean), weight = min(Wide(1.f), squared(half - mean) * divided * float(divisor_.factor));
        const Wide counted = select(is_outlier, weight * mean * divided, Wide(0.f));
        sums.other_half += counted * min(other, half);
        sums.around += counted * mean;
    }

    void add_neighbours(RowSums& sums, bool has_above) const {
        add_pairs(now_, 1, sums);
        if (has_above) add_pairs(above_, 0, sums);
    }

    // Adds products of each pixel with the pixel of `other` that is `left` pixels to the left.
    void add_pairs(const Differences& other, int left, RowSums& sums) const {
        const auto products = [&](const ChannelRows& u, const ChannelRows& v) {
            const float *const r = u[0].pixels() - left, *const g = u[1].pixels() - left, *const b = u[2].pixels() - left;
            const float *const to_r = v[0].pixels(), *const to_g = v[1].pixels(), *const to_b = v[2].pixels();
            Wide sum{};
            for (int x = 0; x < image_.width; x += PixelRow::step)
                sum += squared(load<Wide>(r + x) * load<Wide>(to_r + x) + load<Wide>(g + x) * load<Wide>(to_g + x) +
                               load<Wide>(b + x) * load<Wide>(to_b + x));
            return sum;
        };
        sums.absolute.neighbour_products += products(other.absolute, now_.absolute);
        sums.relative.neighbour_products += products(other.relative, now_.relative);
        const float *const known = other.known.pixels() - left, *const known_here = now_.known.pixels();
        for (int x = 0; x < image_.width; x += PixelRow::step) sums.pairs += load<Wide>(known + x) * load<Wide>(known_here + x);
    }

    // In double precision, in original units.
    void take(const RowSums& row) {
        const double square = 1 / (scale_ * scale_), fourth = square * square;
        const auto add = [](ErrorSums::Weighted& to, const RowSums::Weighted& w, double to_square, double to_fourth) {
            to.squares += total(w.squares) * to_square;
            to.fourths += total(w.fourths) * to_fourth;
            to.own_products += total(w.own_products) * to_fourth;
            to.neighbour_products += 4 * total(w.neighbour_products) * to_fourth;
        };
        ErrorSums s;
        s.pixels = int64_t(total(row.pixels));
        s.pairs = int64_t(total(row.pairs));
        add(s.absolute, row.absolute, square, fourth);
        add(s.relative, row.relative, divisor_.factor, divisor_.factor * divisor_.factor);
        s.relative_high = total(row.relative_high) * divisor_.factor;
        s.outliers = {total(row.loss) * divisor_.factor, total(row.loss_squares) * divisor_.factor * divisor_.factor,
                      total(row.other_half) * divisor_.factor, total(row.around) * divisor_.factor};
        s.unequal = total(row.unequal) * square;
        s.brightest = largest_of(row.brightest) * square;
        s.brightest_emission = largest_of(row.brightest_emission) * square;
        s.largest = largest_of(row.largest) / scale_;
        sums_.merge(s);
    }

    const HalfBufferImage& image_;
    double scale_;
    Divisor divisor_;
    NeighborhoodFilter neighborhood_, noise_; // of the image, of squared half differences
    std::array<HalfBufferRow, kept> rows_;
    std::array<ChannelRows, kept> squares_; // squared half differences
    Differences above_, now_;
    NeighborhoodFilter::NeighborhoodMeans around_, noise_around_; // of one channel
    PixelRow root_;                                               // of the product of the halves' weights
    PixelSums pixels_;
    int loaded_ = 0;
    ErrorSums sums_;
};

} // namespace

void ErrorSums::merge(const ErrorSums& o) {
    const auto add = [](Weighted& to, const Weighted& w) {
        to.squares += w.squares;
        to.fourths += w.fourths;
        to.own_products += w.own_products;
        to.neighbour_products += w.neighbour_products;
    };
    pixels += o.pixels;
    pairs += o.pairs;
    add(absolute, o.absolute);
    add(relative, o.relative);
    relative_high += o.relative_high;
    outliers.loss += o.outliers.loss;
    outliers.loss_squares += o.outliers.loss_squares;
    outliers.other_half += o.outliers.other_half;
    outliers.around += o.outliers.around;
    unequal += o.unequal;
    brightest = std::max(brightest, o.brightest);
    brightest_emission = std::max(brightest_emission, o.brightest_emission);
    largest = std::max(largest, o.largest);
}

ErrorSums sum_errors(const HalfBufferImage& image, int first, int last) {
    const ErrorSums sums = BandSummer(image, 1).sum(first, last);
    if (sums.largest == 0 || (sums.largest <= max_value && sums.largest >= min_value)) return sums;
    // If values do not fit single precision, scales the image by a power of two into the middle of the range.
    return BandSummer(image, std::exp2(std::round(std::log2(target_value / sums.largest)))).sum(first, last);
}

} // namespace blush
