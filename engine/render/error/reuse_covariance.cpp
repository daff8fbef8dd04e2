#include "render/error/reuse_covariance.h"

#include "core/sampler.h"
#include "render/film/film.h"
#include "render/film/sample_allocation.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int max_pixels = 1 << 17; // limit, in blocks spread over the film, to bound the time

Vec3d half_difference(const PixelHalfBuffers& p) {
    if (!p.known) return {0, 0, 0};
    return (p.a - p.b) * std::sqrt(p.weight_a * (1 - p.weight_a));
}

// Ratio of the mean square of the sum of half differences in a block to the sum of squares; 1 if pixels are independent. For the
// blocks of groups, and for the tiles of a sample plan within them, in one pass.
struct BlockRatios {
    double blocks = 1, tiles = 1;
};
BlockRatios ratios_of_blocks(const Film& film, const ReuseGroups& groups) {
    constexpr int side = SampleAllocation::tile_size;
    const int width = groups.block_width, height = groups.block_height;
    const int across = (film.width() + width - 1) / width, blocks = across * ((film.height() + height - 1) / height);
    double of_blocks = 0, of_tiles = 0, apart = 0;
    for (int block = 0; block < blocks; block += 1 + int(int64_t(blocks) * width * height / max_pixels)) {
        const int left = block % across * width, top = block / across * height;
        const int right = std::min(left + width, film.width()), bottom = std::min(top + height, film.height());
        Vec3d sum{0, 0, 0};
        for (int tile_y = top; tile_y < bottom; tile_y += side)
            for (int tile_x = left; tile_x < right; tile_x += side) {
                Vec3d tile{0, 0, 0};
                for (int y = tile_y; y < std::min(tile_y + side, bottom); ++y)
                    for (int x = tile_x; x < std::min(tile_x + side, right); ++x) {
                        const Vec3d d = half_difference(film.half_buffers(size_t(y) * size_t(film.width()) + size_t(x)));
                        tile = tile + d;
                        apart += dot(d, d);
                    }
                sum = sum + tile;
                of_tiles += dot(tile, tile);
            }
        of_blocks += dot(sum, sum);
    }
    return apart > 0 ? BlockRatios{of_blocks / apart, of_tiles / apart} : BlockRatios{};
}

} // namespace

ReuseCovariance measure_reuse_covariance(const Film& film, const ReuseGroups& groups) {
    constexpr int near_side = SampleAllocation::tile_size;
    const double most = groups.size();
    ReuseCovariance shared;
    const BlockRatios ratios = ratios_of_blocks(film, groups);
    shared.means = std::clamp(ratios.blocks, 1.0, most);
    const double near = std::clamp(ratios.tiles, 1.0, shared.means);
    const auto of_products = [](double ratio, double partners) { return ratio * ratio / partners; };
    shared.products = 1 + of_products(near - 1, near_side * near_side * (1 - 1 / most)) +
                      of_products(shared.means - near, groups.block_width * groups.block_height - near_side * near_side);
    return shared;
}

ReuseCovariance measure_sampler_covariance(const Film& film) {
    constexpr int side = 1 << block_bits;
    return {.means = std::max(1.0, ratios_of_blocks(film, {.block_width = side, .block_height = side}).blocks)};
}

ReuseCovariance measure_block_covariance(const Film& film) {
    constexpr int min_blocks = 16;
    ReuseCovariance shared;
    for (int side = 1 << block_bits; (film.width() / side) * (film.height() / side) >= min_blocks; side *= 2) {
        const double ratio = ratios_of_blocks(film, {.block_width = side, .block_height = side}).blocks;
        shared.means = std::max(shared.means, ratio);
        shared.products = std::max(shared.products, 1 + (ratio - 1) * (ratio - 1) / (double(side) * double(side)));
    }
    return shared;
}

ErrorEstimate estimate_error(const Film& film, int reuse, const Workers& workers, const EdgePixels* edges) {
    return film.estimate_error(workers, reuse > 1 ? measure_reuse_covariance(film, reuse_groups(reuse)).products : 1, edges);
}

} // namespace blush
