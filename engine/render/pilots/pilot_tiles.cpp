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
