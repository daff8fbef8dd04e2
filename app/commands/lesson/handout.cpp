#include "app/commands/lesson/handout.h"

#include "app/commands/lesson/states.h"
#include "app/commands/progress.h"
#include "app/commands/render/render_loop.h"
#include "app/commands/render/write_image.h"
#include "io/image/image_io.h"
#include "render/film/coverage.h"
#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

const Error was_interrupted{.what = "interrupted: no handout is written"};

// The size of the step, scaled so that the longer side has `longer` pixels.
void scale_to(int longer, RenderSettings& settings) {
    const double scale = double(longer) / std::max(settings.width, settings.height);
    settings.width = std::max(1, int(std::lround(settings.width * scale)));
    settings.height = std::max(1, int(std::lround(settings.height * scale)));
}

PlaneSet planes_for(const ViewSettings& view) {
    return {.albedo = view.false_color.of == FalseColor::Of::lux, .ids = view.background_as_it_is};
}

// Display-encoded, as the window shows the frame.
Result<std::vector<uint8_t>> picture(const Frame& frame, const ViewSettings& view, const ColorManagement& color) {
    std::vector<float> rgb = beauty_rgb(frame);
    const std::vector<float> coverage = coverage_of(frame);
    const ViewSettings shown = settled(view, metered_exposure(view.auto_exposure, frame.rgba, 4));
    if (const Result<void> done = show(color, shown, rgb, {frame.albedo, coverage}); !done) return done.error();
    return encode_png(frame.width, frame.height, rgb);
}

// Renders, and notes the error at growing numbers of samples. False if interrupted. Time to estimate is not counted.
bool render(Renderer& renderer, int64_t spp, HandoutStep& step, const std::atomic<bool>& interrupted) {
    while (step.samples < spp) {
        const int64_t end = std::min(next_error_look(step.samples), spp);
        const Clock::time_point begun = Clock::now();
        const bool done = renderer.render(step.samples, end - step.samples, [&] { return !interrupted; });
        step.seconds += std::chrono::duration<double>(Clock::now() - begun).count();
        if (!done || interrupted) return false;
        step.samples = end;
        step.error = renderer.estimate_error();
        if (const ErrorEstimate& e = step.error; e.rmse_known) step.rms.push_back({step.seconds, e.rmse, e.rmse_low, e.rmse_high});
    }
    return true;
}

Result<HandoutStep> measure_step(const LessonStep& step, const Project& state, const HandoutOptions& options, const ColorManagement& color,
                                 const std::atomic<bool>& interrupted) {
    HandoutStep out;
    RenderSettings settings = state.render;
    scale_to(options.size, settings);
    const ViewSettings view = view_in_window(step, state.view);
    const int64_t spp = options.spp_given || !step.settings.contains("spp") ? options.spp : settings.spp;
    settings.spp = spp;
    Renderer renderer({.threads = options.threads, .planes = planes_for(view)});
    renderer.update(state.scene, settings);
    if (!render(renderer, spp, out, interrupted)) return was_interrupted;
    const Frame frame = renderer.resolve();
    out.width = frame.width;
    out.height = frame.height;
    out.error = frame.error;
    out.missing_light = frame.missing_light;
    out.bias = bias_of_settings(settings);
    Result<std::vector<uint8_t>> png = picture(frame, view, color);
    if (!png) return png.error();
    out.png = *std::move(png);
    if (!options.claims) return out;
    for (const LessonClaim& claim : step.claims) {
        out.claims.push_back(measure_claim(step, state, claim, options.threads, [&] { return !interrupted; }));
        if (interrupted) return was_interrupted;
    }
    return out;
}

} // namespace

std::string bias_of_settings(const RenderSettings& s) {
    std::vector<std::string> why;
    if (s.max_bounces != unlimited_bounces)
        why.push_back(fmt::format("light of more than {} {} is missing", s.max_bounces, s.max_bounces == 1 ? "bounce" : "bounces"));
    if (s.roulette.rule == Roulette::Rule::biased_cut)
        why.push_back("paths of low throughput are cut off without compensation, and their light is missing");
    if (s.clamp.limit > 0) why.push_back(fmt::format("samples are clamped to {:g} nits, and light above it is missing", s.clamp.limit));
    std::string text;
    for (const std::string& part : why) text += (text.empty() ? "" : "; ") + part;
    return text;
}

Result<std::vector<HandoutStep>> measure_handout(const Lesson& lesson, const std::vector<Project>& states, const HandoutOptions& options,
                                                 const ColorManagement& color, Progress& progress, const std::atomic<bool>& interrupted) {
    std::vector<HandoutStep> steps;
    for (size_t i = 0; i < states.size(); ++i) {
        progress.update(double(i) / double(states.size()), fmt::format("step {}", i + 1));
        Result<HandoutStep> step = measure_step(lesson.steps[i], states[i], options, color, interrupted);
        if (!step) return step.error();
        steps.push_back(*std::move(step));
    }
    return steps;
}

} // namespace blush
