// Render tab: size, stop rules and path tracing settings. The same settings as `blush render` has.
#include "scene/reuse_setting.h"
#include "ui/panels/panels.h"
#include "ui/panels/roulette/roulette_fields.h"
#include "ui/panels/strategies/heuristic_fields.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/presets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace blush {
namespace {

void draw_size(Fields& f, PanelContext& c, RenderSettings& r) {
    f.checkbox("Fit viewport", c.ui.settings.follow_viewport, "Render at the size of the viewport. Otherwise at the size below.");
    if (!c.ui.settings.follow_viewport) {
        std::vector<const char*> names;
        for (const SizePreset& preset : size_presets) names.push_back(preset.name);
        names.push_back("Custom");
        int preset = int(preset_of_size(r));
        if (f.choice("Preset", preset, names, "Common image sizes.") && size_t(preset) < size_presets.size()) {
            r.width = size_presets[size_t(preset)].width;
            r.height = size_presets[size_t(preset)].height;
        }
        int64_t width = r.width, height = r.height;
        if (f.integer("Width", width, 1, 65536, 1280, "Pixels.")) r.width = int(width);
        if (f.integer("Height", height, 1, 65536, 720, "Pixels.")) r.height = int(height);
    }
    f.number("Resolution", r.resolution_scale,
             {.min = 0.1f,
              .max = 2,
              .reset = 1,
              .unit = "×",
              .bar = true,
              .tip = "Fraction of the full width and height. Half the resolution converges four times as fast.",
              .format = "%.2f"});
    f.info("", fmt::format("{} × {} pixels", c.render_width, c.render_height));
    const PixelRect part = pixels_of(r.region, std::max(c.render_width, 1), std::max(c.render_height, 1));
    if (r.region == ImageRegion{}) {
        if (f.button("Render region", "Drag a rectangle in the image. Only its pixels are rendered."))
            c.ui.commands.push_back(Command::render_region);
    } else {
        f.info("Region", fmt::format("{} × {} from {}, {}", part.x1 - part.x0, part.y1 - part.y0, part.x0, part.y0));
        if (f.button("Render whole image")) c.ui.commands.push_back(Command::render_all);
    }
}

void draw_stop_rules(Fields& f, RenderSettings& r) {
    std::vector<const char*> names;
    for (const QualityPreset& preset : quality_presets) names.push_back(preset.name);
    names.push_back("Custom");
    int preset = int(preset_of_quality(r));
    if (f.choice("Quality", preset, names, "Stop rules: 32, 256 or 1024 samples per pixel, or until the estimated relMSE is 0.01 %.") &&
        size_t(preset) < quality_presets.size()) {
        r.spp = quality_presets[size_t(preset)].spp;
        r.error = quality_presets[size_t(preset)].error;
    }
    f.integer("Samples", r.spp, 0, int64_t(1) << 40, 1024,
              "Stop at this many samples per pixel. 0: no limit. Four times the samples halve the noise.");
    float seconds = float(r.seconds), per_cent = float(r.error * 100);
    if (f.number(
            "Time", seconds,
            {.min = 0, .max = 1e7f, .reset = 0, .unit = "s", .step = 0.5f, .tip = "Stop after this render time in seconds. 0: no limit."}))
        r.seconds = seconds;
    if (f.number("Error", per_cent,
                 {.min = 0,
                  .max = 100,
                  .reset = 0,
                  .unit = "%",
                  .step = 0.001f,
                  .tip =
                      "Stop when the estimated relative mean squared error (relMSE) is below this. 0: no limit. It is estimated from two "
                      "independent halves of the samples."}))
        r.error = per_cent / 100;
}

void draw_reuse(Fields& f, RenderSettings& r) {
    static constexpr const char* names[] = {"Auto", "Off", "4 pixels", "8 pixels", "16 pixels"};
    static constexpr int sizes[] = {reuse_auto, 1, 4, 8, 16};
    int choice = int(std::find(std::begin(sizes), std::end(sizes), r.reuse) - std::begin(sizes));
    if (f.choice(
            "Path reuse", choice, names,
            "Groups of this many nearby pixels share the light that their paths find at a second diffuse surface. It is unbiased; "
            "indirect light gets less noisy for more shadow rays. Auto: 8 or 16 pixels where a pilot measures that this pays; the section "
            "Specialisation below says what it found."))
        r.reuse = sizes[choice];
}

void draw_paths(Fields& f, RenderSettings& r) {
    static constexpr const char* strategies[] = {"Both (MIS)", "Light sampling", "BSDF sampling"};
    static constexpr const char* caustic_strategies[] = {"Auto", "Off", "Path guiding", "Light paths", "Manifold sampling"};
    static constexpr const char* filters[] = {"Blackman-Harris", "Box"};
    static constexpr const char* samplers[] = {"Sobol points", "Random numbers"};
    draw_bounce_limit_fields(f, r);
    draw_roulette_fields(f, r.roulette);
    int strategy = int(r.strategy), filter = int(r.filter), sampler = int(r.sampler);
    if (f.choice("Direct light", strategy, strategies,
                 "How direct light is sampled: light sampling (NEE), BSDF sampling, or both combined by multiple importance "
                 "sampling (MIS). All are unbiased; the noise differs."))
        r.strategy = Strategy(strategy);
    if (r.strategy == Strategy::mis) draw_heuristic_fields(f, r.heuristic);
    int caustics = int(r.caustics);
    if (f.choice("Caustics", caustics, caustic_strategies,
                 "Which strategies for caustics of mirrors and glass may be used. Auto: all that a pilot finds to pay; the section "
                 "Specialisation below says which. The others are for comparison. All are unbiased; the noise differs."))
        r.caustics = CausticStrategy(caustics);
    f.checkbox("Compensate MIS", r.mis_compensation,
               "MIS compensation (Karlik et al. 2019): light sampling leaves the even part of an environment to BSDF sampling, which finds "
               "it with less noise. Only with MIS. "
               "Unbiased; the noise differs.");
    if (f.choice("Pixel filter", filter, filters, "Reconstruction filter: Blackman-Harris, 1.5 pixels wide, or a box of one pixel."))
        r.filter = PixelFilter(filter);
    if (f.choice("Sampler", sampler, samplers,
                 "Source of the random numbers: Sobol points, which are stratified, or independent random numbers, for comparison. "
                 "Both are unbiased; the noise differs."))
        r.sampler = SamplerType(sampler);
    f.checkbox("Multiscatter", r.energy_compensation,
               "Compensate the energy that rough metal and glass lose by multiple scattering between microfacets. Off is "
               "what glTF specifies.");
    f.checkbox("Adaptive", r.adaptive,
               "Adaptive sampling: after 16 samples per pixel, noisy regions get more samples and others fewer, the same number on "
               "average. Each half "
               "buffer controls the samples of the other, so it is unbiased.");
    draw_reuse(f, r);
    f.checkbox("Smooth edges", r.smooth_edges,
               "More samples of the emission at the edges of lamps, the sun and the environment as the camera sees them, and of their "
               "highlights in mirrors and glass, where a pilot finds that this pays; the section Specialisation below says in how many "
               "pixels. Unbiased; the noise differs.");
    int64_t seed = r.seed;
    if (f.integer("Seed", seed, 0, UINT32_MAX, 0,
                  "Another seed gives different noise of the same level. The same seed gives the same image, bit for bit."))
        r.seed = uint32_t(seed);
}

} // namespace

void draw_render_panel(PanelContext& c) {
    RenderSettings r = c.project().render;
    if (ImGui::Button(c.ui.paused ? "Resume" : "Pause", {-FLT_MIN, 0})) c.ui.commands.push_back(Command::pause);
    c.ui.probe.record_last_item("Render/Pause");
    tip_for_last_item(c.ui, "A paused render still shows the first image after an edit.");
    Fields f(c.ui, "Render");
    if (section(c.ui, "Image")) draw_size(f, c, r);
    if (section(c.ui, "Stop at")) draw_stop_rules(f, r);
    if (section(c.ui, "Paths")) draw_paths(f, r);
    if (f.changed()) c.apply(SetRender{r}, f.gesture());
    draw_specialisation_section(c);
}

} // namespace blush
