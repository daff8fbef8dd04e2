// Renders a range of samples of a look and writes it as a part.
#pragma once

#include "app/commands/load_scene.h"
#include "app/commands/plan/parts.h"
#include "render/film/sample_allocation.h"

#include <atomic>

namespace blush {

class Renderer;
struct LoopResult;

// How a process renders.
struct RenderRun {
    unsigned threads = 0; // 0: one per core
    bool quiet = false;
};

// The absolute name of a scene's file.
std::filesystem::path scene_path(const std::filesystem::path& folder, const PlanScene& scene);

// Imports the scene of a look and applies its edits. Errors: another scene than when the plan was made, other lights or environment
// files, unreadable, interrupted (stopped_by_signal of task_log.h).
Result<LoadedScene> load_look(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look, const RenderRun& run,
                              const std::atomic<bool>& interrupted);

// The allocation of adaptive sampling that the pilot of this look decided. Errors: unreadable, damaged, another one than that whose
// hash the plan names.
Result<SampleAllocation::Shares> allocation_of(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look);

// Writes the sums of the renderer after this loop. Errors: cannot write.
Result<void> write_part(const std::filesystem::path& file, const RenderPlan& plan, const PlanLook& look, const LoadedScene& loaded,
                        const RenderSettings& settings, const LoopResult& loop, Renderer& renderer);

// Renders and writes these samples. If it is interrupted, those so far: a valid, shorter part. Errors: interrupted before the
// first sample (stopped_by_signal of task_log.h), cannot write.
Result<Part> render_part(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look, const LoadedScene& loaded,
                         SampleSpan samples, const RenderRun& run, const std::atomic<bool>& interrupted);

} // namespace blush
