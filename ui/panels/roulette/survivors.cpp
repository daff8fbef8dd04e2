#include "ui/panels/roulette/survivors.h"

#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

using Fate = Survivor::Fate;

// The pixel whose values are shown; else that in the middle of the image.
TracedPixel chosen_pixel(const PanelContext& c) {
    const double u = c.ui.pixel ? c.ui.pixel->u : 0.5, v = c.ui.pixel ? c.ui.pixel->v : 0.5;
    return {std::clamp(int(u * c.render_width), 0, std::max(c.render_width - 1, 0)),
            std::clamp(int(v * c.render_height), 0, std::max(c.render_height - 1, 0))};
}

PathWork::Input input_of(const PanelContext& c, const Roulette& roulette) {
    PathWork::Input input;
    input.scene = c.scene();
    input.settings = c.project().render;
    input.settings.width = c.render_width;
    input.settings.height = c.render_height;
    input.settings.resolution_scale = 1;
    input.settings.roulette = roulette;
    // Each path counts for its own pixel, as it is.
    input.settings.reuse = 1;
    input.settings.smooth_edges = false;
    input.settings.clamp = {};
    input.pixels = {chosen_pixel(c)};
    input.samples = c.ui.roulette.survivors.paths;
    return input;
}

// The mark is as large as the weight: its area, at most that of its cell.
void draw_mark(ImDrawList& draw, const ImVec2& center, float cell, const Survivor& s, double largest) {
    const float radius = std::max(1.f, 0.46f * cell * float(std::sqrt(s.weight / largest)));
    const float arm = 0.2f * cell, line = std::max(1.f, cell / 14);
    switch (s.fate) {
    case Fate::lives: return draw.AddCircleFilled(center, radius, tone::light);
    case Fate::ended: return draw.AddCircle(center, radius, tone::dim_text, 0, line);
    case Fate::killed:
        draw.AddLine({center.x - arm, center.y - arm}, {center.x + arm, center.y + arm}, tone::failure, line);
        return draw.AddLine({center.x - arm, center.y + arm}, {center.x + arm, center.y - arm}, tone::failure, line);
    }
}

void draw_marks_of(PanelContext& c, const Survivors& now, double largest) {
    const float width = ImGui::GetContentRegionAvail().x, em = ImGui::GetFontSize();
    const int columns = std::clamp(int(width / (1.6f * em)), 1, 20);
    const float cell = std::floor(width / float(columns));
    const int rows = (int(now.paths.size()) + columns - 1) / columns;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (size_t i = 0; i < now.paths.size(); ++i) {
        const float column = float(int(i) % columns), row = float(int(i) / columns);
        draw_mark(draw, {at.x + (column + 0.5f) * cell, at.y + (row + 0.5f) * cell}, cell, now.paths[i], largest);
    }
    ImGui::Dummy({cell * float(columns), cell * float(rows)});
    c.ui.probe.record_last_item(fmt::format("Roulette/{} of {} paths live", now.counts[size_t(Fate::lives)], now.paths.size()));
    tip_for_last_item(c.ui, "Each mark is a path. A disc lives; its area is its weight. A ring has ended by itself, at a light, outside or "
                            "absorbed, and keeps its weight. A cross was ended by roulette and counts as 0.");
}

// Largest weight of all bounces: marks keep their scale while they grow.
double largest_weight(const PathSet& set) {
    double largest = 1;
    for (const Survivor& s : survivors_behind(set, most_bounces(set)).paths) largest = std::max(largest, s.weight);
    return largest;
}

std::string figures_text(const PathCost& with_roulette, const PathCost& none) {
    std::string text = fmt::format("Mean of the pixel: {:.3g} ± {:.2g} nits, without roulette {:.3g} ± {:.2g}: unchanged within the noise.",
                                   with_roulette.mean, with_roulette.half, none.mean, none.half);
    const double difference = std::abs(with_roulette.mean - none.mean), noise = std::hypot(with_roulette.half, none.half);
    if (difference > noise)
        text =
            fmt::format("Mean of the pixel: {:.3g} ± {:.2g} nits, without roulette {:.3g} ± {:.2g}. More paths tell whether they differ.",
                        with_roulette.mean, with_roulette.half, none.mean, none.half);
    return text;
}

std::string price_text(const PathCost& with_roulette, const PathCost& none) {
    if (!(none.variance > 0) || !(none.vertices > 0)) return "Without roulette the paths have no variance.";
    const double variance = with_roulette.variance / none.variance, cost = with_roulette.vertices / none.vertices;
    return fmt::format("The price: {:.2f} times the variance of a path. The gain: {:.2f} times the vertices, {:.1f} instead of {:.1f}. "
                       "Together {:.2f} times the work for the same error.",
                       variance, cost, with_roulette.vertices, none.vertices, variance * cost);
}

void draw_player(PanelContext& c, SurvivorsView& view, int64_t last) {
    Fields f(c.ui, "Survivors");
    if (f.integer("Bounce", view.bounce, 0, last, 0, "Roulette has decided at this many bounces.")) view.playing = false;
    if (f.button(view.playing ? "Stop" : "Play", "Goes from bounce to bounce.")) {
        view.playing = !view.playing;
        view.step_due = ImGui::GetTime() + 1;
    }
}

} // namespace

void draw_survivor_paths(PanelContext& c, const PathSet& with_roulette, const PathSet* without) {
    SurvivorsView& view = c.ui.roulette.survivors;
    const int64_t last = most_bounces(with_roulette);
    view.bounce = std::clamp<int64_t>(view.bounce, 0, last);
    const Survivors now = survivors_behind(with_roulette, view.bounce);
    draw_marks_of(c, now, largest_weight(with_roulette));
    const auto count = [&](Fate fate) { return now.counts[size_t(fate)]; };
    wrapped_text(fmt::format("Bounce {}: {} paths live, each counts {:.3g}-fold. {} have ended by themselves, {} by roulette.", view.bounce,
                             count(Fate::lives), now.living_weight, count(Fate::ended), count(Fate::killed)));
    wrapped_text(fmt::format("Sum of the weights: {:.1f}. Before the first bounce it was {}, and so it stays on average.", now.weight,
                             now.paths.size()));
    const std::optional<PathCost> cost = cost_of(with_roulette), none = without ? cost_of(*without) : std::nullopt;
    if (!cost || !none || !with_roulette.complete || !without->complete) return quiet_text("Paths are being traced.");
    wrapped_text(figures_text(*cost, *none));
    wrapped_text(price_text(*cost, *none));
}

void draw_survivors(PanelContext& c) {
    SurvivorsView& view = c.ui.roulette.survivors;
    if (!section(c.ui, "Survivors, path by path", false)) return view.stop();
    quiet_text("A path goes on with probability p, and then counts 1/p-fold. Otherwise it ends here.");
    {
        Fields f(c.ui, "Survivors");
        f.number("p", view.probability,
                 {.min = 0.05f,
                  .max = 1,
                  .reset = 0.7f,
                  .bar = true,
                  .tip = "Survival probability at every bounce, only here.",
                  .format = "%.2f"});
        f.integer("Paths", view.paths, 10, SurvivorsView::most_paths, 100,
                  "Of the pixel that the Pixel panel shows, else of the middle one.");
    }
    if (!view.with_roulette) view.with_roulette = std::make_shared<PathRunner>();
    if (!view.without) view.without = std::make_shared<PathRunner>();
    view.with_roulette->measure(input_of(c, {.rule = Roulette::Rule::constant, .start = 1, .probability = view.probability}));
    view.without->measure(input_of(c, {.rule = Roulette::Rule::off}));
    view.of_roulette = view.with_roulette->state();
    view.of_none = view.without->state();
    for (const PathRunner::State* state : {&view.of_roulette, &view.of_none})
        if (!state->failure.empty()) return quiet_text(state->failure);
    if (!view.of_roulette.rests || !view.of_none.rests) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.25);
    const PathSet* set = view.of_roulette.output.get();
    if (!set || set->paths.empty()) return quiet_text("Paths are being traced.");
    const int64_t last = most_bounces(*set);
    draw_player(c, view, last);
    if (view.playing) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, play(view, last, ImGui::GetTime()));
    draw_survivor_paths(c, *set, view.of_none.output.get());
    for (const std::string& text : set->left_out) quiet_text("Not in the mean: " + text + ".");
}

} // namespace blush
