// Compiles a scene for bleed probes and traces their batches (bleed_paths.h) on many threads.
#pragma once

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/diagnostics/bleed_paths.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush {

class BleedTracer {
public:
    // 0 threads: one per core.
    explicit BleedTracer(unsigned threads, bool low_priority = false);

    // Compiles what differs from the last scene. The gains of a light mix are applied to the lights.
    void begin(const Scene& scene, const RenderSettings& settings);
    // Batches [first, first + count) of a target, in order. Empty if `wanted` (called often, from many threads) returned false. The result
    // does not depend on the number of threads.
    std::vector<BleedSums> trace(const BleedTarget& target, int64_t first, int64_t count, const std::function<bool()>& wanted = {});
    // Batch `batch` of each target.
    std::vector<BleedSums> trace_each(std::span<const BleedTarget> targets, int64_t batch, const std::function<bool()>& wanted = {});

    // Of the last scene: the groups of its lights, one for each light and each emissive object; the origin of places; the message about
    // light that paths cannot find (missing_light.h), empty: none; whether anything emits light.
    const LightGroups& lights() const { return groups_; }
    const Vec3d& origin() const { return compiled_.origin(); }
    const std::string& missing_light() const { return compiled_.missing_light(CausticFinders::none); }
    bool has_light() const { return compiled_.has_light(); }

private:
    std::vector<BleedSums> traced(int64_t count, const std::function<bool()>& wanted,
                                  const std::function<BleedSums(const KernelContext&, int64_t i, TileScratch&)>& trace_one);

    Workers workers_;
    std::vector<std::unique_ptr<TileScratch>> scratch_; // by worker
    ExpandedMeshes meshes_;
    std::optional<Scene> expanded_;
    RenderScene compiled_;
    LightGroups groups_;
    RenderSettings settings_;
};

} // namespace blush
