#include "render/lights/learned_portals.h"

#include "core/math.h"
#include "core/rec709.h"
#include "render/lights/receiver_grid.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace blush {
namespace {

constexpr int portal_block = 2;           // cells along a block
constexpr int min_trials = 32;            // of a cell with a portal,
constexpr double min_escapes = 4;         // and of its block: escaped rays
constexpr double prior_escapes = 8;       // weight of the block's distribution in that of its cell
constexpr double neighbour_weight = 0.25; // of each of four bins beside a bin
constexpr int directions_along_bin = 8;   // that the mean radiance of a bin is taken over, squared

using Bins = std::array<double, portal_bins>;

// Mean luminance of the environment over each bin.
Bins radiance_of_bins(const EnvironmentTables& environment) {
    Bins mean{};
    constexpr int n = directions_along_bin;
    for (int bin = 0; bin < portal_bins; ++bin)
        for (int i = 0; i < n * n; ++i) {
            const float u = (float(i % n) + 0.5f) / n, v = (float(i / n) + 0.5f) / n;
            const float height = 2 * (float(bin / portal_side) + u) / portal_side - 1, radius = sqrt(1 - height * height);
            const SinCos<float> azimuth = sincos_turns((float(bin % portal_side) + v) / portal_side - 0.5f);
            const Vec3 radiance = environment_radiance<float>(environment, {radius * azimuth.sin, height, radius * azimuth.cos}, true);
            mean[size_t(bin)] += double(luminance(radiance)) / (n * n);
        }
    return mean;
}

Bins smoothed(const Bins& bins) {
    Bins result{};
    constexpr int n = portal_side;
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const auto at = [&](int r, int c) { return bins[size_t(std::clamp(r, 0, n - 1) * n + (c + n) % n)]; };
            result[size_t(row * n + column)] = at(row, column) + neighbour_weight * (at(row - 1, column) + at(row + 1, column) +
                                                                                     at(row, column - 1) + at(row, column + 1));
        }
    return result;
}

double sum_of(const Bins& bins) {
    double sum = 0;
    for (const double x : bins) sum += x;
    return sum;
}

// Vose 1991, "A linear algorithm for generating random numbers with a given distribution". `share` sums to 1.
void append_alias_table(const Bins& share, std::vector<PortalBin>& bins) {
    constexpr double cut_steps = 0x1p24;
    std::array<PortalBin, portal_bins> table{};
    Bins scaled{};
    std::vector<size_t> small, large;
    for (size_t i = 0; i < scaled.size(); ++i) {
        scaled[i] = share[i] * portal_bins;
        table[i] = {float(scaled[i] / (4 * std::numbers::pi)), uint32_t(0xffffff) << 8 | uint32_t(i)};
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const size_t low = small.back(), high = large.back();
        small.pop_back();
        table[low].cut_alias = uint32_t(scaled[low] * cut_steps) << 8 | uint32_t(high);
        scaled[high] -= 1 - scaled[low];
        if (scaled[high] >= 1) continue;
        large.pop_back();
        small.push_back(high);
    }
    bins.insert(bins.end(), table.begin(), table.end());
}

struct Region {
    int64_t tried = 0;
    Bins escaped{};
};

} // namespace

LearnedPortals::LearnedPortals(std::span<const EscapeTrial> trials, const EnvironmentTables& environment, bool alone) {
    std::vector<Vec3> positions;
    for (const EscapeTrial& t : trials) positions.push_back(t.position);
    const ReceiverGrid grid = make_receiver_grid(positions, cells_along_longest);
    if (grid.cells_per_metre == 0) return;
    const CellBlocks blocks{grid, portal_block};
    std::vector<Region> of_cell(size_t(grid.count())), of_block(size_t(blocks.count()));
    int64_t tried = 0;
    for (const EscapeTrial& t : trials) {
        if (t.is_delta || !is_finite_position(t.position) || !is_finite_position(t.direction)) continue;
        const int cell = receiver_cell<float>(grid, t.position), bin = portal_bin<float>(t.direction);
        ++tried;
        for (Region* region : {&of_cell[size_t(cell)], &of_block[size_t(blocks.of(cell))]}) {
            ++region->tried;
            region->escaped[size_t(bin)] += t.escaped;
        }
    }

    const Bins radiance = radiance_of_bins(environment);
    std::vector<int32_t> rows(size_t(grid.count()), -1);
    int64_t reached = 0;
    for (int cell = 0; cell < grid.count(); ++cell) {
        const Region &own = of_cell[size_t(cell)], &around = of_block[size_t(blocks.of(cell))];
        const double escaped = sum_of(own.escaped), escaped_around = sum_of(around.escaped);
        if (own.tried < min_trials || escaped_around < min_escapes) continue;
        if (escaped > largest_escaping_share * double(own.tried)) continue;
        Bins share{};
        for (size_t i = 0; i < share.size(); ++i) share[i] = own.escaped[i] + prior_escapes * around.escaped[i] / escaped_around;
        share = smoothed(share);
        for (size_t i = 0; i < share.size(); ++i) share[i] *= radiance[i];
        const double sum = sum_of(share);
        if (!(sum > 0)) continue;
        for (double& x : share) x = (1 - uniform_share) * x / sum + uniform_share / portal_bins;
        rows[size_t(cell)] = int32_t(bins_.size()) / portal_bins;
        append_alias_table(share, bins_);
        reached += own.tried;
    }
    if (bins_.empty()) return;
    shape_ = {.rows = nullptr, .bins = nullptr, .grid = grid, .alone = alone};
    rows_ = std::move(rows);
    reach_ = double(reached) / double(tried);
}

PortalTables LearnedPortals::tables() const {
    PortalTables tables = shape_;
    tables.rows = rows_.empty() ? nullptr : rows_.data();
    tables.bins = bins_.data();
    return tables;
}

} // namespace blush
