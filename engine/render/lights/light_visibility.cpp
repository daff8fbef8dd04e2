#include "render/lights/light_visibility.h"

#include "render/lights/receiver_grid.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int block = 4;           // cells along a block
constexpr double prior_trials = 4; // weight of the coarser estimate

// Rays towards one group: a child of the root or a distant light.
struct Count {
    static constexpr double ray = 0x1p16; // shares are rounded, so that the order of trials does not matter
    uint32_t tried = 0;
    uint64_t arrived = 0; // times `ray`
    void add(const ShadowTrial& t) {
        ++tried;
        if (t.arrived) arrived += uint64_t(std::lround(double(t.transmittance) * ray));
    }
    double visibility(double prior) const { return (double(arrived) / ray + prior_trials * prior) / (tried + prior_trials); }
};

// Group of each record; -1: the tree never selects it.
int group_of(const LightTables& lights, int32_t light) {
    const int32_t slot = lights.lights[light].slot;
    if (slot >= 0) return lights.tree.root_count + (lights.slot_count > 0 ? 0 : slot);
    const uint32_t trail = lights.tree.entries[~slot].trail;
    return trail == no_trail ? -1 : int(trail & (max_tree_children - 1));
}

std::vector<Vec3> positions_of(std::span<const ShadowTrial> trials) {
    std::vector<Vec3> positions;
    for (const ShadowTrial& t : trials) positions.push_back(t.position);
    return positions;
}

} // namespace

LightVisibility::LightVisibility(std::span<const ShadowTrial> trials, const LightTables& lights) {
    const int groups = lights.tree.root_count + lights.tree.distant_count;
    const auto g = size_t(groups);
    const ReceiverGrid grid = make_receiver_grid(positions_of(trials), cells_along_longest);
    if (grid.cells_per_metre == 0) return;
    shape_ = {.factors = nullptr, .words = (groups + visibility_word_lights - 1) / visibility_word_lights, .grid = grid};
    const auto cells = size_t(grid.count()), rows = cells * receiver_sides;
    const CellBlocks blocks{grid, block};
    const auto block_of = [&](size_t cell) { return size_t(blocks.of(int32_t(cell))); };
    std::vector<Count> of_scene(g), of_block(size_t(blocks.count()) * g), of_cell(cells * g), of_row(rows * g);
    for (const ShadowTrial& t : trials) {
        const int group = is_finite_position(t.position) ? group_of(lights, t.light) : -1;
        if (group < 0) continue;
        const size_t row = size_t(visibility_row<float>(shape_, t.position, t.normal)) / size_t(shape_.words), cell = row / receiver_sides;
        of_scene[size_t(group)].add(t);
        of_block[block_of(cell) * g + size_t(group)].add(t);
        of_cell[cell * g + size_t(group)].add(t);
        of_row[row * g + size_t(group)].add(t);
    }

    factors_.assign(rows * size_t(shape_.words), 0);
    double log_ratios = 0, weights = 0;
    for (size_t row = 0; row < rows; ++row) {
        const size_t cell = row / receiver_sides, in_block = block_of(cell);
        // The importances of the row's receivers, up to a factor, are the trials' shares: lights were selected in proportion to them.
        double sum = 0, sum_visible = 0, sum_root = 0;
        for (size_t k = 0; k < g; ++k) {
            const double coarse = of_block[in_block * g + k].visibility(of_scene[k].visibility(1));
            const double visibility = of_row[row * g + k].visibility(of_cell[cell * g + k].visibility(coarse));
            const auto byte = uint32_t(std::max(std::lround(std::sqrt(visibility) * 255), 1L));
            factors_[row * size_t(shape_.words) + k / visibility_word_lights] |= byte << (8 * (k % visibility_word_lights));
            const double tried = of_row[row * g + k].tried;
            sum += tried;
            sum_visible += tried * visibility;
            sum_root += tried * std::sqrt(visibility);
        }
        const bool lit = std::any_of(&of_row[row * g], &of_row[row * g] + g, [](const Count& c) { return c.arrived > 0; });
        if (!lit) continue;
        log_ratios += sum * std::log(sum_root * sum_root / (sum * sum_visible));
        weights += sum;
    }
    if (weights > 0) second_moment_ = std::exp(log_ratios / weights);
}

LightVisibilityGrid LightVisibility::grid() const {
    LightVisibilityGrid grid = shape_;
    grid.factors = factors_.empty() ? nullptr : factors_.data();
    return grid;
}

} // namespace blush
