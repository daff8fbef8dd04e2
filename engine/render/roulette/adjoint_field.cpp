#include "render/roulette/adjoint_field.h"

#include "render/lights/receiver_grid.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int block = 4;                              // cells along a block
constexpr double prior_trials = 4;                    // weight of the coarser estimate
constexpr double darkest = 0.02;                      // a pixel counts as no darker than this share of the image's mean
constexpr double extreme = 1e30;                      // of table entries, and its inverse: so that no product is NaN
constexpr double vertex_work = 0.5 + shadow_ray_cost; // of a copy at its first vertex: it is shaded, but its ray was traced before
constexpr double left_out = 0.01; // share of the pixels, those of the largest variance: fireflies say nothing about the others

struct Moments {
    double mean = 0, square = 0, rays = 0;
};
// Sums over trials.
struct Sums {
    double count = 0;
    Moments sum;
    void add(const ContinuationTrial& t) {
        const double light = std::max(0.0, double(t.radiance));
        ++count;
        sum = {sum.mean + light, sum.square + light * light, sum.rays + double(t.rays)};
    }
    Moments with(const Moments& prior) const {
        const double n = count + prior_trials;
        return {(sum.mean + prior_trials * prior.mean) / n, (sum.square + prior_trials * prior.square) / n,
                (sum.rays + prior_trials * prior.rays) / n};
    }
};

bool is_finite(const ContinuationTrial& t) {
    return is_finite_position(t.position) && is_finite_position(t.normal) && std::isfinite(t.radiance) && std::isfinite(t.rays);
}

// Of the pixels up to `reach` away, without the brightest sample, which may be a firefly.
struct Neighbourhood {
    const AdjointImage& image;
    static constexpr int reach = 1;

    double mean(int x, int y) const {
        double sum = 0, brightest = 0;
        int count = 0;
        for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v)
            for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach); ++u)
                for (int s = 0; s < image.samples; ++s) {
                    const double value =
                        double(image.luminance[(size_t(v) * size_t(image.width) + size_t(u)) * size_t(image.samples) + size_t(s)]);
                    if (!std::isfinite(value)) continue;
                    sum += value;
                    brightest = std::max(brightest, value);
                    ++count;
                }
        return count > 1 ? (sum - brightest) / (count - 1) : sum;
    }
};

float bounded(double x) { return float(std::clamp(x, 1 / extreme, extreme)); }

// Of each cell and side of the grid, from the moments of its trials. Empty without light.
template <class Value>
std::vector<float> table_of(const ReceiverGrid& grid, std::span<const ContinuationTrial> trials, const Value& value) {
    const CellBlocks blocks{grid, block};
    const auto cells = size_t(grid.count());
    Sums of_scene;
    std::vector<Sums> of_block(size_t(blocks.count())), of_cell(cells), of_row(cells * receiver_sides);
    for (const ContinuationTrial& t : trials) {
        if (!is_finite(t)) continue;
        const auto cell = receiver_cell<float>(grid, t.position);
        for (Sums* sums : {&of_scene, &of_block[size_t(blocks.of(cell))], &of_cell[size_t(cell)],
                           &of_row[size_t(cell) * receiver_sides + size_t(receiver_side<float>(t.normal))]})
            sums->add(t);
    }
    std::vector<float> table;
    if (!(of_scene.sum.mean > 0)) return table;
    const Moments scene = of_scene.with({});
    table.reserve(of_row.size());
    for (size_t row = 0; row < of_row.size(); ++row) {
        const size_t cell = row / receiver_sides;
        table.push_back(bounded(value(of_row[row].with(of_cell[cell].with(of_block[size_t(blocks.of(int32_t(cell)))].with(scene))))));
    }
    return table;
}

double variance_of(std::span<const float> samples) {
    double sum = 0, square = 0;
    for (const float s : samples) {
        sum += double(s);
        square += double(s) * double(s);
    }
    const auto n = double(samples.size());
    return n > 1 ? std::max(0.0, (square - sum * sum / n) / (n - 1)) : 0;
}

} // namespace

AdjointField::AdjointField(Roulette::Rule rule, std::span<const ContinuationTrial> trials, std::span<const ContinuationTrial> arrivals,
                           const AdjointImage& image) {
    measure_image(image);
    if (!importances_.empty()) learn_values(rule, trials);
    if (values_.empty()) *this = AdjointField();
    if (!values_.empty() && rule == Roulette::Rule::splitting) learn_splits(arrivals);
}

void AdjointField::measure_image(const AdjointImage& image) {
    const Neighbourhood around{image};
    std::vector<double> pixels;
    double mean = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            pixels.push_back(around.mean(x, y));
            mean += pixels.back();
        }
    mean /= double(std::max<size_t>(1, pixels.size()));
    if (!(mean > 0) || !std::isfinite(mean)) return;
    std::vector<double> variances;
    for (size_t k = 0; k < pixels.size(); ++k) {
        const double level = std::max(pixels[k], darkest * mean);
        importances_.push_back(bounded(1 / level));
        const auto n = size_t(image.samples);
        const double variance = variance_of(std::span(image.luminance).subspan(k * n, n)) / (level * level);
        if (std::isfinite(variance)) variances.push_back(variance);
    }
    std::ranges::sort(variances);
    const auto kept = std::max<size_t>(1, size_t(double(variances.size()) * (1 - left_out)));
    for (size_t k = 0; k < std::min(kept, variances.size()); ++k) relative_variance_ += variances[k] / double(kept);
    rays_per_sample_ = image.rays / (double(pixels.size()) * double(std::max(1, image.samples)));
    across_ = image.width;
    down_ = image.height;
}

// No noise to remove: no path is worth more than another.
double AdjointField::noise_scale() const { return std::sqrt(rays_per_sample_ / std::max(relative_variance_, 1e-9)); }

void AdjointField::learn_values(Roulette::Rule rule, std::span<const ContinuationTrial> trials) {
    std::vector<Vec3> positions;
    for (const ContinuationTrial& t : trials)
        if (is_finite(t)) positions.push_back(t.position);
    grid_ = make_receiver_grid(positions, cells_along_longest);
    if (grid_.cells_per_metre == 0) return;
    const double scale = noise_scale();
    values_ = table_of(grid_, trials, [&](const Moments& m) {
        return rule == Roulette::Rule::adjoint ? m.mean : std::sqrt(m.square / std::max(m.rays, 1e-9)) * scale;
    });
}

void AdjointField::learn_splits(std::span<const ContinuationTrial> arrivals) {
    const double scale = noise_scale();
    splits_ = table_of(grid_, arrivals, [&](const Moments& m) {
        const double work = vertex_work + (1 + shadow_ray_cost) * m.rays;
        return std::sqrt(std::max(0.0, m.square - m.mean * m.mean) / work) * scale;
    });
}

AdjointTables AdjointField::tables(int width, int height) const {
    if (empty()) return {};
    return {.values = values_.data(),
            .grid = grid_,
            .importances = importances_.data(),
            .splits = splits_.empty() ? nullptr : splits_.data(),
            .across = across_,
            .down = down_,
            .across_scale = float(across_) / float(width),
            .down_scale = float(down_) / float(height)};
}

} // namespace blush
