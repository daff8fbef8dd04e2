#include "render/lights/receiver_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blush {
namespace {

constexpr double outermost = 0.01;     // share of the positions beyond each face of the grid
constexpr double phase = 0.3819660113; // of the grid in cells: surfaces at round coordinates must not lie between two cells

} // namespace

bool is_finite_position(const Vec3& position) { return std::isfinite(position.x + position.y + position.z); }

ReceiverGrid make_receiver_grid(const std::vector<Vec3>& positions, int cells_along_longest) {
    std::array<float, 3> low, extent;
    std::vector<float> along;
    for (size_t axis = 0; axis < 3; ++axis) {
        along.clear();
        for (const Vec3& p : positions)
            if (is_finite_position(p)) along.push_back(axis == 0 ? p.x : axis == 1 ? p.y : p.z);
        if (along.empty()) return {};
        const auto quantile = [&](double share) {
            const auto at = along.begin() + std::ptrdiff_t(share * double(along.size() - 1));
            std::ranges::nth_element(along, at);
            return *at;
        };
        low[axis] = quantile(outermost);
        extent[axis] = quantile(1 - outermost) - low[axis];
    }
    ReceiverGrid grid;
    const float size = std::ranges::max(extent) / float(cells_along_longest), before = float(phase) * size;
    grid.cells_per_metre = 1 / size;
    if (!(size > 0) || !std::isfinite(grid.cells_per_metre)) return {};
    grid.low = {low[0] - before, low[1] - before, low[2] - before};
    for (size_t axis = 0; axis < 3; ++axis) grid.cells[axis] = int(extent[axis] * grid.cells_per_metre + float(phase)) + 1;
    return grid;
}

} // namespace blush
