#include "app/commands/plan/pilot.h"

#include "app/commands/common.h"
#include "app/commands/progress.h"
#include "app/commands/render/layers.h"
#include "app/commands/render/peak_memory.h"
#include "app/commands/render/render_loop.h"
#include "app/commands/render/resume_image.h"
#include "app/common/run_program.h"
#include "render/renderer.h"

#include <algorithm>
#include <chrono>

namespace blush {
namespace {

constexpr double pilot_seconds = 2;
constexpr int64_t most_pilot_samples = 1024; // of tiny images

class Timer {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count(); }

private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

// To start this program and end it, before it has read anything.
double seconds_of_process() {
    const Timer timer;
    return run_program({"/proc/self/exe", "--version"}) == 0 ? timer.seconds() : 0;
}

struct Moment {
    int64_t samples = 0;
    double seconds = 0;
};

// Seconds of one sample, once pilots have decided and caches are warm: from the later half.
double later_sample(const std::vector<Moment>& moments) {
    const Moment &last = moments.back(),
                 &middle = *std::ranges::find_if(moments, [&](const Moment&m) { return 2 * m.samples >= last.samples; });
    if (middle.samples == last.samples) return last.seconds / double(last.samples);
    return (last.seconds - middle.seconds) / double(last.samples - middle.samples);
}

} // namespace

Result<MeasuredCosts> measure_costs(const RenderPlan& plan, const PlanLook& look, const LoadedScene& loaded, double import_seconds,
                                    const std::filesystem::path& scratch, const RenderRun& run, const std::atomic<bool>& interrupted) {
    RenderSettings settings = look.settings;
    settings.spp = most_pilot_samples;
    const Timer begun;
    Renderer renderer({.threads = run.threads, .planes = planes_of(*parse_layers(plan.layers))});
    renderer.update(loaded.scene, settings);
    const double built = begun.seconds();
    std::vector<Moment> moments;
    std::atomic<bool> enough{false};
    Progress progress(run.quiet);
    const LoopResult loop = run_render_loop(renderer, settings, enough, [&](const LoopProgress& p) {
        moments.push_back({p.samples, p.seconds});
        enough = interrupted || (p.seconds >= pilot_seconds && p.samples >= 2);
        progress.update(std::min(p.seconds / pilot_seconds, 1.0), "measures what a task costs");
    });
    if (interrupted) return Error{.file = look.name, .what = "interrupted"};
    MeasuredCosts costs;
    costs.sample = later_sample(moments);
    costs.start = seconds_of_process() + import_seconds + built + std::max(0.0, loop.seconds - double(loop.samples) * costs.sample);
    const Timer writing;
    if (const Result<void> written = write_part(scratch, plan, look, loaded, settings, loop, renderer); !written)
        return in_file(written.error(), scratch.string());
    costs.write = writing.seconds();
    const Timer reading;
    const Result<ResumeImage> read = read_resume_image(scratch.string());
    costs.read = reading.seconds();
    std::error_code code;
    costs.part_mib = double(std::filesystem::file_size(scratch, code)) / 1048576;
    std::filesystem::remove(scratch, code);
    if (!read) return read.error();
    costs.memory_mib = peak_memory_mb();
    return costs;
}

MeasuredCosts worst_of(const MeasuredCosts& a, const MeasuredCosts& b) {
    return {.start = std::max(a.start, b.start),
            .sample = std::max(a.sample, b.sample),
            .write = std::max(a.write, b.write),
            .read = std::max(a.read, b.read),
            .memory_mib = std::max(a.memory_mib, b.memory_mib),
            .part_mib = std::max(a.part_mib, b.part_mib)};
}

} // namespace blush
