// `blush plan SCENE... -o DIR`: resolves looks, measures, cuts them into tasks.
#pragma once

#include "app/commands/plan/looks.h"
#include "app/commands/plan/render_part.h"

namespace blush {

// What the command line says.
struct PlanInput {
    std::vector<std::string> scenes, snapshots;
    std::filesystem::path folder; // of the plan; exists
    RenderOptions options;        // spp, error, texture memory
    Words words;                  // what else was given of the render options
    std::string looks, frames, cameras, variants;
    int64_t turntable = 0;
    double frames_per_second = 24;
    std::string layers = "film";
    bool gather = false;          // copies scenes into the folder
    std::optional<int64_t> chunk; // empty: chosen
    int64_t workers = 0;          // for which it is chosen; 0: not known
    std::string program;
};

// Errors: a scene that cannot be read, a look that cannot be stored as edits of its file, too many looks, interrupted.
Result<RenderPlan> make_plan(const PlanInput& input, const RenderRun& run, const std::atomic<bool>& interrupted);

// Appends tasks for the samples of these looks, in chunks aligned to multiples of the chunk: the first chunk of every look, then the
// second, so that all looks become visible together.
struct LookSamples {
    size_t look = 0;
    SampleSpan samples;
};
void add_tasks(RenderPlan& plan, const std::vector<LookSamples>& wanted);

} // namespace blush
