// Places a grid over the receivers that a pilot has met.
#pragma once

#include "shading/receiver_grid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
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
        return at(x / side, y / side, z / side);
    }
    int32_t at(int32_t x, int32_t y, int32_t z) const { return (z * along(1) + y) * along(0) + x; }
    // The inverse.
    std::array<int32_t, 3> place(int32_t block) const {
        return {block % along(0), block / along(0) % along(1), block / (along(0) * along(1))};
    }
    template <class Visit> void for_each_cell(int32_t block, const Visit& visit) const {
        const std::array<int32_t, 3> at = place(block);
        const int32_t x0 = at[0] * side, y0 = at[1] * side, z0 = at[2] * side;
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
        values_.reserve(entries.size());
        for (const uint32_t i : order_of(entries)) {
            auto& [key, value] = entries[i];
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
    // Indices of the entries, by key. Counting sort, unless the keys are so far apart that their counters would take the time.
    static std::vector<uint32_t> order_of(const std::vector<std::pair<int32_t, T>>& entries) {
        constexpr size_t counters_per_entry = 16;
        int32_t last = 0;
        for (const auto& [key, value] : entries) last = std::max(last, key);
        std::vector<uint32_t> order(entries.size());
        if (size_t(last) / counters_per_entry > entries.size()) {
            std::iota(order.begin(), order.end(), 0u);
            std::ranges::stable_sort(order, {}, [&](uint32_t i) { return entries[i].first; });
            return order;
        }
        std::vector<uint32_t> place(size_t(last) + 2);
        for (const auto& [key, value] : entries) ++place[size_t(key) + 1];
        std::partial_sum(place.begin(), place.end(), place.begin());
        for (size_t i = 0; i < entries.size(); ++i) order[place[size_t(entries[i].first)]++] = uint32_t(i);
        return order;
    }

    std::vector<int32_t> keys_;
    std::vector<size_t> begins_;
    std::vector<T> values_;
};

} // namespace blush
