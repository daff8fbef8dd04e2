// Places a grid over the receivers that a pilot has met.
#pragma once

#include "shading/receiver_grid.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace blush {

// A grid over these positions but for the outermost in each direction, with so many cells along its longest side. Positions that are not
// finite are ignored. The grid scales exactly with powers of two. cells_per_metre is 0 if there is nothing to cover.
ReceiverGrid make_receiver_grid(const std::vector<Vec3>& positions, int cells_along_longest);

bool is_finite_position(const Vec3& position);

// The cells of a grid in cubic blocks of `side` cells: where a cell has learned little, its block says more.
struct CellBlocks {
    const ReceiverGrid& grid;
    int32_t side;

    int32_t along(int axis) const { return (grid.cells[axis] + side - 1) / side; }
    int32_t count() const { return along(0) * along(1) * along(2); }
    int32_t of(int32_t cell) const {
        const int32_t x = cell % grid.cells[0], y = cell / grid.cells[0] % grid.cells[1], z = cell / (grid.cells[0] * grid.cells[1]);
        return (z / side * along(1) + y / side) * along(0) + x / side;
    }
    template <class Visit> void for_each_cell(int32_t block, const Visit& visit) const {
        const int32_t x0 = block % along(0) * side, y0 = block / along(0) % along(1) * side, z0 = block / (along(0) * along(1)) * side;
        for (int32_t z = z0; z < std::min(z0 + side, grid.cells[2]); ++z)
            for (int32_t y = y0; y < std::min(y0 + side, grid.cells[1]); ++y)
                for (int32_t x = x0; x < std::min(x0 + side, grid.cells[0]); ++x) visit((z * grid.cells[1] + y) * grid.cells[0] + x);
    }
};

// Values by key, as cells, blocks, or their sides. Receivers are surfaces, so most keys have none, and cost nothing.
template <class T> class ByKey {
public:
    // The values of a key keep their order. Keys are not negative.
    explicit ByKey(std::vector<std::pair<int32_t, T>> entries) {
        std::vector<uint64_t> order; // keys and indices: faster to sort than values
        order.reserve(entries.size());
        for (size_t i = 0; i < entries.size(); ++i) order.push_back(uint64_t(uint32_t(entries[i].first)) << 32 | i);
        std::ranges::sort(order);
        values_.reserve(entries.size());
        for (const uint64_t o : order) {
            auto& [key, value] = entries[size_t(uint32_t(o))];
            if (keys_.empty() || keys_.back() != key) {
                keys_.push_back(key);
                begins_.push_back(values_.size());
            }
            values_.push_back(std::move(value));
        }
        begins_.push_back(values_.size());
    }
    // Those with values, ascending.
    const std::vector<int32_t>& keys() const { return keys_; }
    // Of keys()[k].
    std::span<const T> values_at(size_t k) const { return std::span(values_).subspan(begins_[k], begins_[k + 1] - begins_[k]); }
    std::span<const T> values_of(int32_t key) const {
        const auto found = std::ranges::lower_bound(keys_, key);
        if (found == keys_.end() || *found != key) return {};
        return values_at(size_t(found - keys_.begin()));
    }

private:
    std::vector<int32_t> keys_;
    std::vector<size_t> begins_;
    std::vector<T> values_;
};

} // namespace blush
