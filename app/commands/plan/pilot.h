// Measures what a task costs, by a short render of one look.
#pragma once

#include "app/commands/plan/render_part.h"

namespace blush {

// `import_seconds`: what reading the scene took. `scratch`: a file that is written, read and removed. Renders for about two seconds,
// at least two samples. Errors: interrupted, the file cannot be written.
Result<MeasuredCosts> measure_costs(const RenderPlan& plan, const PlanLook& look, const LoadedScene& loaded, double import_seconds,
                                    const std::filesystem::path& scratch, const RenderRun& run, const std::atomic<bool>& interrupted);

// The larger of each, for plans of several scenes.
MeasuredCosts worst_of(const MeasuredCosts& a, const MeasuredCosts& b);

} // namespace blush
