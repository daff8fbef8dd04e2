#include "render/pilots/edge_pilot.h"

#include "core/math.h"
#include "render/film/edge_samples.h"
#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace blush {
namespace {

constexpr uint32_t edge_pilot_seed = 0x3c6ef372u; // any; it only has to differ from those of images
constexpr int tile_side = 32;
constexpr int coarse_divider = 4, coarse_samples = 2;
constexpr int pixel_samples = 16; // of a pixel whose neighbours differ in emission

double luminance_in(const TileScratch& tile, int slot) {
    const double l = luminance(Vec3d{tile.r[slot], tile.g[slot], tile.b[slot]});
    return std::isfinite(l) ? std::max(l, 0.0) : 0.0; // faults are the film's to report
}

// Luminance of all samples of an image, pixel by pixel.
struct Samples {
    int width = 0, height = 0, per_pixel = 1;
    std::vector<double> luminance;

    double at(int x, int y, int s = 0) const { return luminance[(size_t(y) * size_t(width) + size_t(x)) * size_t(per_pixel) + size_t(s)]; }
};

// Noise and work of the image's paths.
struct Noise {
    double mse = 0, relmse = 0, work = 0;

    // True if a fall of a pixel's variance is worth M + 1 more camera rays for each sample.
    bool is_worth(double gain, double mean) const {
        const double relative_gain = gain / (mean * mean + dark_squared);
        return gain > 0 && gain / mse + relative_gain / relmse > 2 * (edge_samples + 1) / work;
    }
};

class Pilot {
public:
    Pilot(const KernelContext& context, const Kernel& kernel, const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
          const std::function<bool()>& wanted)
        : context_(context), kernel_(kernel), workers_(workers), scratch_(scratch), wanted_(wanted) {
        context_.seed = edge_pilot_seed;
        context_.settings.reuse = {};
        context_.settings.max_bounces = pilot_max_bounces;
        emission_ = context_;
        emission_.settings.max_bounces = 0;
        for (auto& s : scratch_)
            if (!s) s = std::make_unique<TileScratch>();
    }

    std::optional<EdgePixels> find();

private:
    bool render(KernelContext context, int divider, int per_pixel, Samples& to);
    bool render_coarse();
    // Mean light R of paths that found no emission, near a pixel.
    double other_light(int x, int y) const;
    bool is_edge(int x, int y, TileScratch& scratch) const;

    KernelContext context_, emission_;
    const Kernel& kernel_;
    const Workers& workers_;
    std::vector<std::unique_ptr<TileScratch>>& scratch_;
    const std::function<bool()>& wanted_;
    Samples seen_;              // emission of the film
    Samples paths_, emissions_; // of the coarse image
    Noise noise_;
};

bool Pilot::render(KernelContext context, int divider, int per_pixel, Samples& to) {
    to.width = std::max(1, int(context.settings.width) / divider);
    to.height = std::max(1, int(context.settings.height) / divider);
    to.per_pixel = per_pixel;
    to.luminance.resize(size_t(to.width) * size_t(to.height) * size_t(per_pixel));
    context.settings.width = float(to.width);
    context.settings.height = float(to.height);
    const int across = (to.width + tile_side - 1) / tile_side, down = (to.height + tile_side - 1) / tile_side;
    return workers_.for_each(int64_t(across) * down, wanted_, [&](int64_t i, unsigned worker) {
        TileJob tile{.x = int(i % across) * tile_side, .y = int(i / across) * tile_side, .samples = per_pixel};
        tile.width = std::min(tile_side, to.width - tile.x);
        tile.height = std::min(tile_side, to.height - tile.y);
        kernel_.render(context, tile, *scratch_[worker]);
        const int row = tile.width * per_pixel;
        for (int y = 0; y < tile.height; ++y)
            for (int k = 0; k < row; ++k)
                to.luminance[(size_t(tile.y + y) * size_t(to.width) + size_t(tile.x)) * size_t(per_pixel) + size_t(k)] =
                    luminance_in(*scratch_[worker], y * row + k);
    });
}

bool Pilot::render_coarse() {
    for (const auto& s : scratch_) s->camera_rays = s->bounce_rays = s->shadow_rays = 0;
    if (!render(context_, coarse_divider, coarse_samples, paths_)) return false;
    for (const auto& s : scratch_)
        noise_.work += double(s->camera_rays) + double(s->bounce_rays) + shadow_ray_cost * double(s->shadow_rays);
    if (!render(emission_, coarse_divider, coarse_samples, emissions_)) return false;
    const double pixels = double(paths_.width) * double(paths_.height);
    noise_.work /= coarse_samples * pixels;
    for (int y = 0; y < paths_.height; ++y)
        for (int x = 0; x < paths_.width; ++x) {
            const double a = paths_.at(x, y, 0), b = paths_.at(x, y, 1), mean = (a + b) / 2, variance = (a - b) * (a - b) / 2;
            noise_.mse += variance / pixels;
            noise_.relmse += variance / (mean * mean + dark_squared) / pixels;
        }
    return true;
}

double Pilot::other_light(int x, int y) const {
    const int near_x = std::min(x / coarse_divider, paths_.width - 1), near_y = std::min(y / coarse_divider, paths_.height - 1);
    double sum = 0;
    int count = 0;
    for (int v = std::max(0, near_y - 1); v <= std::min(paths_.height - 1, near_y + 1); ++v)
        for (int u = std::max(0, near_x - 1); u <= std::min(paths_.width - 1, near_x + 1); ++u)
            for (int s = 0; s < coarse_samples; ++s)
                if (emissions_.at(u, v, s) == 0) {
                    sum += paths_.at(u, v, s);
                    ++count;
                }
    return count > 0 ? sum / count : 0;
}

bool Pilot::is_edge(int x, int y, TileScratch& scratch) const {
    double low = seen_.at(x, y), high = low;
    for (int v = std::max(0, y - 1); v <= std::min(seen_.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(seen_.width - 1, x + 1); ++u) {
            low = std::min(low, seen_.at(u, v));
            high = std::max(high, seen_.at(u, v));
        }
    if (low == high) return false;
    const double other = other_light(x, y);
    // No more variance than this is possible: half of the pixel each.
    if (!noise_.is_worth((high - low) * (high - low) / 4, low + other)) return false;
    kernel_.render(emission_, {.x = x, .y = y, .width = 1, .height = 1, .first_sample = 2, .samples = pixel_samples}, scratch);
    // Both sides count once more than they were found (rule of succession): samples easily miss a side of low coverage.
    double sum = low + high, squares = low * low + high * high;
    for (int k = 0; k < pixel_samples; ++k) {
        const double l = luminance_in(scratch, k);
        sum += l;
        squares += l * l;
    }
    const double mean = sum / (pixel_samples + 2), variance = squares / (pixel_samples + 2) - mean * mean;
    return noise_.is_worth(variance * (1 - 1.0 / edge_samples - 2 * other / (high - low)), mean + other);
}

std::optional<EdgePixels> Pilot::find() {
    if (!render(emission_, 1, 1, seen_)) return std::nullopt;
    if (std::ranges::all_of(seen_.luminance, [&](double l) { return l == seen_.luminance[0]; })) return EdgePixels{};
    if (!render_coarse()) return std::nullopt;
    std::vector<uint8_t> found(seen_.luminance.size()); // bits of a bitmap share words
    const bool all = workers_.for_each(seen_.height, wanted_, [&](int64_t y, unsigned worker) {
        for (int x = 0; x < seen_.width; ++x) found[size_t(y) * size_t(seen_.width) + size_t(x)] = is_edge(x, int(y), *scratch_[worker]);
    });
    if (!all) return std::nullopt;
    EdgePixels edges(seen_.width, seen_.height);
    for (int y = 0; y < seen_.height; ++y)
        for (int x = 0; x < seen_.width; ++x)
            if (found[size_t(y) * size_t(seen_.width) + size_t(x)]) edges.add(x, y);
    return edges;
}

} // namespace

std::optional<EdgePixels> find_edge_pixels(const KernelContext& context, const Kernel& kernel, const Workers& workers,
                                           std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    return Pilot(context, kernel, workers, scratch, wanted).find();
}

} // namespace blush
