// How light paths leave the lights: chooses pairs of lights and casters of caustics, and samples points and directions.
#pragma once

#include "core/sampler.h"
#include "render/compile/scene_tables.h"
#include "render/integrator/light_path_sampling.h"
#include "render/kernels/kernel.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace blush {

// True if some light emits light paths towards weak reflectors (Smoothness::reflects_weakly): one that rays rarely find. `casters`: those
// of `tables`, then weak reflectors.
bool emits_to_weak_reflectors(const SceneTables& tables, const CausticCasterTables& casters);

// Pairs of lights and casters, for one image. Sampled with the density of emission_density().
class LightPathEmission {
public:
    // No more pairs: the table would be slower than it is useful. Beside many lights, fewer casters are aimed at.
    static constexpr int64_t max_pairs = 1 << 20;

    LightPathEmission() = default;
    // For lights that NEE can sample, of these those for which `emits(record)` is true. `scene`: contains all surfaces. Empty if no light
    // reaches a caster, or there are more than max_pairs / 2 lights.
    LightPathEmission(
        const SceneTables& tables, const CasterSphere& scene, const std::function<bool(int32_t)>& emits = [](int32_t) { return true; });

    // For lights without size: paths that no other strategy finds (EmissionTables::alone).
    static LightPathEmission of_zero_size_lights(const SceneTables& tables, const CasterSphere& scene);
    // For all lights, towards the whole scene: for photon maps (photon_map.h).
    static LightPathEmission of_all_lights(const SceneTables& tables, const CasterSphere& scene);

    bool empty() const { return chances_.empty(); }
    // `paths`: light paths for one camera sample of every pixel. Valid as long as this object and the scene.
    EmissionTables tables(float paths) const;
    // The emission of a path; `tables` as above, in the scene's. `index`: kept in the path.
    EmittedPath emit_by(const SceneTables& scene, const EmissionRandom<float>& random, uint32_t index = 0) const;
    // With the first pairs of the sampler (light_paths.h).
    EmittedPath emit(const SceneTables& scene, const Sampler<float>& sampler) const;
    size_t memory_bytes() const { return chances_.size() * sizeof(float) + thresholds_.size() * sizeof(uint32_t); }

private:
    // `flux`: by pair, in any unit.
    void set_chances(const std::vector<double>& flux);

    std::vector<float> chances_; // EmissionTables::chances
    std::vector<uint32_t> thresholds_;
    CausticCasterTables casters_;
    CasterSphere scene_{};
    int32_t lights_ = 0;
    bool alone_ = false;
};

// Light paths [first, first + count) of pass `pass` of an image of `paths_per_pass` paths a pass; the passes of a half have one sequence of
// points. At most tile_capacity paths.
struct LightPathTile {
    int64_t pass = 0, paths_per_pass = 0, first = 0;
    int count = 0;
};
// Traces them with a kernel that has Feature::light_paths: the splats are in scratch.light_paths.
void trace_light_path_tile(const KernelContext& context, const Kernel& kernel, const LightPathEmission& emission, const LightPathTile& tile,
                           TileScratch& scratch);

} // namespace blush
