#include "render/lights/manifold_seed_table.h"

#include "shading/path_guiding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace blush {
namespace {

constexpr size_t seeds_of_region = 128, seeds_of_scene = 256;
constexpr size_t photons_of_region = 64;                   // else a larger one is taken
constexpr std::array<int32_t, 4> block_sides{1, 2, 4, 8};  // of a region, in cells
constexpr float margin = 0.25f;                            // of a block's side: photons so near to it count, too
constexpr std::array<int, 4> grid_sides{192, 128, 96, 64}; // cells along the longest side: the first with
constexpr double max_grid_cells = 64.0 * 64 * 64;          // no more than so many in all
constexpr size_t photons_per_question = 4096;              // whether the table is still wanted

bool is_usable(const ChainPhoton& p) {
    return is_finite_position(p.position) && is_finite_position(p.target) && std::isfinite(p.flux) && p.flux > 0 &&
           dot(p.normal, p.normal) > 0;
}

ReceiverGrid grid_of(const std::vector<Vec3>& positions) {
    ReceiverGrid grid;
    for (const int side : grid_sides) {
        grid = make_receiver_grid(positions, side);
        if (double(grid.cells[0]) * double(grid.cells[1]) * double(grid.cells[2]) <= max_grid_cells) break;
    }
    return grid;
}

// Lights whose points can be sampled evenly. Not those of surfaces that have specular events themselves: a chain
// would not know where it ends. Nor those of panes: paths that pass one straight keep all of its light.
bool ends_chains(const SceneTables& scene, const LightRecord& light) {
    switch (LightKind(light.kind)) {
    case LightKind::triangle:
        return !(scene.materials.materials[scene.parts[light.part].material].flags & (material_chains | material_pane));
    case LightKind::point:
    case LightKind::sphere:
    case LightKind::sun: return true;
    default: return false;
    }
}

// By block and side: the photons in it or near to it. Nothing if `wanted` returned false.
std::optional<ByKey<const ChainPhoton*>> by_block(const CellBlocks& blocks, std::span<const ChainPhoton* const> photons,
                                                  const std::function<bool()>& wanted) {
    std::vector<std::pair<int32_t, const ChainPhoton*>> near;
    const float reach = margin * float(blocks.side) / blocks.grid.cells_per_metre;
    for (size_t i = 0; i < photons.size(); ++i) {
        if (i % photons_per_question == 0 && wanted && !wanted()) return std::nullopt;
        const ChainPhoton& p = *photons[i];
        const Vec3 corner{reach, reach, reach};
        const int32_t low = guiding_cell<float>(blocks.grid, p.position - corner, p.normal), face = low % guiding_sides;
        const int32_t high = guiding_cell<float>(blocks.grid, p.position + corner, p.normal);
        const auto from = blocks.place(blocks.of(low / guiding_sides)), to = blocks.place(blocks.of(high / guiding_sides));
        // Along each axis, the blocks of both corners are the same or neighbours.
        for (int32_t z = from[2]; z <= to[2]; ++z)
            for (int32_t y = from[1]; y <= to[1]; ++y)
                for (int32_t x = from[0]; x <= to[0]; ++x) near.emplace_back(blocks.at(x, y, z) * guiding_sides + face, &p);
    }
    return ByKey<const ChainPhoton*>(std::move(near));
}

} // namespace

std::optional<ManifoldSeedTable> ManifoldSeedTable::make(std::span<const ChainPhoton> photons, const SceneTables& scene,
                                                         const Workers& workers, const std::function<bool()>& wanted) {
    ManifoldSeedTable table;
    if (!table.build(photons, scene, workers, wanted)) return std::nullopt;
    return table;
}

bool ManifoldSeedTable::build(std::span<const ChainPhoton> photons, const SceneTables& scene, const Workers& workers,
                              const std::function<bool()>& wanted) {
    const LightTables& lights = scene.lights;
    // Groups, of lights that some photon comes from.
    group_of_light_.assign(size_t(lights.count), -1);
    std::map<std::pair<int32_t, int32_t>, int32_t> group_of_part;
    std::vector<const ChainPhoton*> usable;
    std::vector<Vec3> positions;
    const auto key_of = [&](int32_t light) {
        const LightRecord& r = lights.lights[light];
        return LightKind(r.kind) == LightKind::triangle ? std::pair(0, r.part) : std::pair(1, light);
    };
    for (const ChainPhoton& p : photons) {
        if (!is_usable(p) || p.light < 0 || p.light >= lights.count || !ends_chains(scene, lights.lights[p.light])) continue;
        usable.push_back(&p);
        positions.push_back(p.position);
        group_of_part.emplace(key_of(p.light), 0);
    }
    if (usable.empty()) return true;
    for (auto& [key, group] : group_of_part) {
        group = int32_t(groups_.size());
        groups_.push_back({-1, 0, 0});
    }
    for (int32_t light = 0; light < lights.count; ++light) {
        if (!ends_chains(scene, lights.lights[light])) continue;
        const auto found = group_of_part.find(key_of(light));
        if (found == group_of_part.end()) continue;
        ManifoldGroup& group = groups_[size_t(found->second)];
        if (group.lights == 0) group.first_light = light;
        if (light != group.first_light + group.lights) continue; // not consecutive
        ++group.lights;
        group_of_light_[size_t(light)] = found->second;
    }

    grid_ = grid_of(positions);
    regions_of_cell_.assign(size_t(grid_.count()) * guiding_sides, 0);
    std::erase_if(usable, [&](const ChainPhoton* p) { return group_of_light_[size_t(p->light)] < 0; });
    std::ranges::stable_sort(usable, {}, [&](const ChainPhoton* p) { return group_of_light_[size_t(p->light)]; });
    add_region(usable, seeds_of_scene);
    for (const ManifoldSegment& s : segments_) groups_[size_t(s.group)].share = float(s.count) / float(regions_[0].count);
    // Lights without a seed in region 0 are left to the other strategies.
    for (int32_t& group : group_of_light_)
        if (group >= 0 && !(groups_[size_t(group)].share > 0)) group = -1;
    std::erase_if(usable, [&](const ChainPhoton* p) { return group_of_light_[size_t(p->light)] < 0; });
    if (grid_.cells_per_metre == 0) return true;

    // Sorting the photons takes most of the time.
    std::array<std::optional<ByKey<const ChainPhoton*>>, block_sides.size()> sorted;
    if (!workers.for_each(int64_t(block_sides.size()), wanted, [&](int64_t size, unsigned) {
            sorted[size_t(size)] = by_block({grid_, block_sides[size_t(size)]}, usable, wanted);
        }))
        return false;
    for (size_t size = block_sides.size(); size-- > 0;) {
        if (!sorted[size]) return false;
        add_regions({grid_, block_sides[size]}, *sorted[size]);
    }
    return true;
}

// Of the cubes of blocks.side^3 cells that have enough photons.
void ManifoldSeedTable::add_regions(const CellBlocks& blocks, const ByKey<const ChainPhoton*>& photons) {
    for (size_t b = 0; b < photons.keys().size(); ++b) {
        const std::span<const ChainPhoton* const> some = photons.values_at(b);
        if (some.size() < photons_of_region) continue;
        const int32_t block = photons.keys()[b] / guiding_sides, face = photons.keys()[b] % guiding_sides;
        blocks.for_each_cell(block,
                             [&](int32_t cell) { regions_of_cell_[size_t(cell * guiding_sides + face)] = int32_t(regions_.size()); });
        add_region(some, seeds_of_region);
    }
}

// `photons`: sorted by group. So many of them become seeds, each in proportion to its flux (systematic resampling).
void ManifoldSeedTable::add_region(std::span<const ChainPhoton* const> photons, size_t seeds) {
    double flux = 0;
    for (const ChainPhoton* p : photons) flux += double(p->flux);
    const size_t count = std::min(seeds, photons.size());
    ManifoldRegion region{int32_t(seeds_.size()), int32_t(count), int32_t(segments_.size()), 0};
    double before = 0;
    size_t next = 0;
    for (size_t k = 0; k < count; ++k) {
        const double wanted = (double(k) + 0.5) * flux / double(count);
        while (next + 1 < photons.size() && before + double(photons[next]->flux) < wanted) before += double(photons[next++]->flux);
        const ChainPhoton& p = *photons[next];
        const int32_t group = group_of_light_[size_t(p.light)];
        if (region.segments == 0 || segments_.back().group != group) {
            segments_.push_back({group, int32_t(seeds_.size()), 0});
            ++region.segments;
        }
        ++segments_.back().count;
        seeds_.push_back({p.position, p.target, p.chain, int32_t(segments_.size()) - 1});
    }
    regions_.push_back(region);
}

ManifoldTables ManifoldSeedTable::tables(const CausticCasterTables& casters) const {
    if (empty()) return {};
    return {regions_of_cell_.data(),         regions_.data(), segments_.data(), seeds_.data(), groups_.data(), group_of_light_.data(),
            int32_t(group_of_light_.size()), grid_,           casters};
}

} // namespace blush
