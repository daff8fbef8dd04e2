#include "render/pilots/pilot_tiles.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace blush {
namespace {

constexpr int min_tiles = 8, max_tiles = 64; // if the film has as many;
constexpr int film_tiles_per_tile = 16;      // between these, one for so many tiles of the film

} // namespace

PilotImage pilot_image(const EstimatorSettings& settings, int pixels, int samples) {
    constexpr int side = 16;
    const double shrink = std::min(1.0, std::sqrt(double(pixels) / (double(settings.width) * double(settings.height))));
    PilotImage image{std::max(1, int(double(settings.width) * shrink)), std::max(1, int(double(settings.height) * shrink)), {}};
    for (int y = 0; y < image.height; y += side)
        for (int x = 0; x < image.width; x += side)
            image.tiles.push_back({.x = x,
                                   .y = y,
                                   .width = std::min(side, image.width - x),
                                   .height = std::min(side, image.height - y),
                                   .first_sample = 0,
                                   .samples = samples});
    return image;
}

std::vector<TileJob> pilot_tiles(int width, int height) {
    const int across = (width + pilot_tile_side - 1) / pilot_tile_side, down = (height + pilot_tile_side - 1) / pilot_tile_side;
    const int all = across * down;
    const auto count = size_t(std::min(all, std::clamp(all / film_tiles_per_tile, min_tiles, max_tiles)));
    const auto along = [](int k, double step, int tiles) {
        const double x = 0.5 + k * step;
        return std::min(int((x - std::floor(x)) * tiles), tiles - 1);
    };
    std::set<std::pair<int, int>> places;
    for (int k = 0; places.size() < count; ++k) places.emplace(along(k, 0.5698402909980532, down), along(k, 0.7548776662466927, across));
    std::vector<TileJob> tiles;
    for (const auto& [row, column] : places) {
        const int x = column * pilot_tile_side, y = row * pilot_tile_side;
        tiles.push_back({.x = x,
                         .y = y,
                         .width = std::min(pilot_tile_side, width - x),
                         .height = std::min(pilot_tile_side, height - y),
                         .first_sample = 0,
                         .samples = pilot_samples});
    }
    return tiles;
}

} // namespace blush
