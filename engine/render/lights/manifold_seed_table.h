// Builds the seeds of manifold sampling from photons (shading/manifold_seeds.h).
#pragma once

#include "core/parallel.h"
#include "render/compile/scene_tables.h"
#include "render/lights/guiding_trial.h"
#include "render/lights/receiver_grid.h"
#include "shading/manifold_seeds.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace blush {

// Of one image. Does not depend on the number of threads.
class ManifoldSeedTable {
public:
    ManifoldSeedTable() = default;
    // Reads the lights, parts and materials of the scene. Empty if no photon has arrived by specular surfaces alone. Nothing if `wanted`
    // returned false meanwhile; an empty `wanted` never does.
    static std::optional<ManifoldSeedTable> make(std::span<const ChainPhoton> photons, const SceneTables& scene, const Workers& workers,
                                                 const std::function<bool()>& wanted);

    bool empty() const { return seeds_.empty(); }
    // Valid as long as this object.
    ManifoldTables tables(const CausticCasterTables& casters) const;
    size_t memory_bytes() const {
        return regions_of_cell_.capacity() * sizeof(int32_t) + seeds_.capacity() * sizeof(ManifoldSeed) +
               regions_.capacity() * sizeof(ManifoldRegion) + segments_.capacity() * sizeof(ManifoldSegment);
    }

private:
    // False if `wanted` returned false.
    bool build(std::span<const ChainPhoton> photons, const SceneTables& scene, const Workers& workers, const std::function<bool()>& wanted);
    void add_regions(const CellBlocks& blocks, const ByKey<const ChainPhoton*>& photons);
    void add_region(std::span<const ChainPhoton* const> photons, size_t seeds);

    ReceiverGrid grid_;
    std::vector<int32_t> regions_of_cell_, group_of_light_;
    std::vector<ManifoldRegion> regions_;
    std::vector<ManifoldSegment> segments_;
    std::vector<ManifoldSeed> seeds_;
    std::vector<ManifoldGroup> groups_;
};

} // namespace blush
