// Roulette lab: the Russian roulette settings, their effect on paths, their efficiency, and a bias test.
#include "core/text.h"
#include "render/integrator/estimator_settings.h"
#include "ui/panels/panels.h"
#include "ui/panels/roulette/roulette_fields.h"
#include "ui/panels/roulette/survivors.h"
#include "ui/widgets/bars.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

// The rule as a formula, with the current numbers.
std::string formula(const Roulette& r) {
    std::string q;
    switch (r.rule) {
    case Roulette::Rule::off: return "q = 1: every path continues until it leaves the scene or its throughput is 0.";
    case Roulette::Rule::max: q = "max(beta)"; break;
    case Roulette::Rule::luminance: q = "Y(beta)"; break;
    case Roulette::Rule::sqrt: q = "sqrt(max(beta))"; break;
    case Roulette::Rule::constant: q = fmt::format("{:.3g}", r.probability); break;
    case Roulette::Rule::automatic: q = "sqrt(max(beta))"; break;
    case Roulette::Rule::adjoint: q = "Y(beta) E[L] / I"; break;
    case Roulette::Rule::efficiency: q = "Y(beta) / I sqrt(E[L^2] / E[rays]) / sqrt(V / C)"; break;
    case Roulette::Rule::splitting: q = "Y(beta) / I sqrt(E[L^2] / E[rays]) / sqrt(V / C)"; break;
    case Roulette::Rule::biased_cut:
        return fmt::format(
            "q = 1 if max(beta) >= {:.3g}, else 0, from bounce {} on, at smooth mirrors and glass from bounce {}. Survivors are not "
            "weighted up: biased.",
            r.threshold, r.start, std::max(r.start, first_rr_bounce_at_delta));
    }
    if (r.cap < 1)
        q = fmt::format("min({:.3g}, {})", r.cap, r.floor > 0 ? fmt::format("max({:.3g}, {})", r.floor, q) : q);
    else if (r.floor > 0)
        q = fmt::format("min(1, max({:.3g}, {}))", r.floor, q);
    else if (r.rule != Roulette::Rule::constant)
        q = fmt::format("min(1, {})", q);
    const char* const otherwise =
        r.rule == Roulette::Rule::automatic
            ? " A learned rule or a later start replaces this where that pays: see Specialisation in the Render tab."
        : r.rule == Roulette::Rule::splitting
            ? " A path that arrives goes on in n = Y(beta) / I sqrt(V[L] / E[work]) / sqrt(V / C) copies, each with beta / n."
            : "";
    return fmt::format("q = {} from bounce {} on; survivors: beta / q. At smooth mirrors and glass q = 1 before bounce {}.{}", q, r.start,
                       std::max(r.start, first_rr_bounce_at_delta), otherwise);
}

void figure_row(const char* name, const std::string& rule, const std::string& none, const char* tip, UiState& ui) {
    ImGui::TableNextColumn();
    elided_text(ui, name, tone::text);
    tip_for_last_item(ui, tip);
    for (const std::string& text : {rule, none}) {
        ImGui::TableNextColumn();
        elided_text(ui, text, tone::text);
    }
}

void draw_figures(PanelContext& c, const RouletteReport& r) {
    if (!ImGui::BeginTable("figures", 3, ImGuiTableFlags_SizingStretchProp)) return;
    for (const char* column : {"", "Current", "Off"}) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    const auto row = [&](const char* name, double RouletteSide::*field, const char* format, double scale, const char* tip) {
        figure_row(name, fmt::format(fmt::runtime(format), scale * (r.rule.*field)),
                   fmt::format(fmt::runtime(format), scale * (r.none.*field)), tip, c.ui);
    };
    row("Path length", &RouletteSide::path_length, "{:.4g}", 1,
        "Mean number of vertices, including the one where the path leaves the scene.");
    row("Rays per path", &RouletteSide::rays_per_path, "{:.4g}", 1, "Rays of one sample: camera, bounce and shadow rays.");
    row("Time per path", &RouletteSide::path_seconds, "{:.4g} µs", 1e6, "Time of one thread.");
    row("Variance", &RouletteSide::variance, "{:.4g}", 1, "Variance of the luminance of one path, mean over the pixels.");
    row("Efficiency", &RouletteSide::efficiency, "{:.4g}", 1, "1 / (variance x time). Higher is better.");
    ImGui::EndTable();
    if (r.efficiency_gain > 0)
        quiet_text(fmt::format("{:.2f} ± {:.2f} times as efficient as without roulette, over {} rounds of {} × {} pixels.",
                               r.efficiency_gain, 2 * r.gain_error, r.rounds, r.width, r.height));
    else
        quiet_text(fmt::format("Round {}: not enough data to compare efficiency yet.", r.rounds));
}

void draw_survival(PanelContext& c, const RouletteReport& r) {
    std::vector<Bar> bars;
    for (size_t k = 0; k + 1 < r.rule.alive.size() && k < 12; ++k) {
        const double q = r.rule.survival[k];
        bars.push_back({fmt::format("To {}", k + 1), r.rule.alive[k + 1],
                        fmt::format("{:.1f} %{}", 100 * r.rule.alive[k + 1], q < 0 ? "" : fmt::format("  q {:.2f}", q)), false});
    }
    draw_bars(c.ui, "Survival", bars, "Fraction of the paths that reach this bounce, and the mean survival probability before it.");
}

void draw_bias(const RouletteReport& r) {
    if (r.bias.empty() || r.rounds < 8) return quiet_text("Not enough rounds yet.");
    const RouletteBias& whole = r.bias.front();
    const std::string size = fmt::format("{} ± {:.3f} %", signed_number(100 * whole.difference, 3), 200 * whole.error);
    ImGui::PushStyleColor(ImGuiCol_Text, r.biased() ? tone::failure : tone::text);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(r.biased() ? fmt::format("Biased: the image is off by {}.", size).c_str()
                                      : fmt::format("Unbiased within noise: the image differs by {}.", size).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    if (!ImGui::BeginTable("bias", 3, ImGuiTableFlags_SizingStretchProp)) return;
    for (const char* column : {"", "Share of light", "Difference"}) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    for (size_t i = 1; i < r.bias.size(); ++i) {
        const RouletteBias& b = r.bias[i];
        if (b.share < 5e-5 && !b.significant) continue;
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(b.name.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%.2f %%", 100 * b.share);
        ImGui::TableNextColumn();
        ImGui::PushStyleColor(ImGuiCol_Text, b.significant ? tone::failure : tone::dim_text);
        ImGui::Text("%+.3f ± %.3f %%", 100 * b.difference, 200 * b.error);
        ImGui::PopStyleColor();
    }
    ImGui::EndTable();
}

void draw_measured(PanelContext& c, RouletteView& view) {
    if (!view.runner) view.runner = std::make_shared<RouletteRunner>();
    RenderSettings settings = c.project().render;
    settings.width = c.render_width;
    settings.height = c.render_height;
    view.runner->measure({c.scene(), settings});
    c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.25);
    const RouletteRunner::State state = view.runner->state();
    if (!state.failure.empty()) return quiet_text(state.failure);
    if (state.output.rounds == 0) return quiet_text("The first round is being rendered.");
    draw_roulette_report(c, state.output);
}

} // namespace

void draw_roulette_report(PanelContext& c, const RouletteReport& report) {
    if (section(c.ui, "Compared with no roulette")) draw_figures(c, report);
    if (section(c.ui, "Survival by bounce")) draw_survival(c, report);
    if (section(c.ui, "Bias test")) draw_bias(report);
}

void draw_roulette_panel(PanelContext& c) {
    RouletteView& view = c.ui.roulette;
    RenderSettings r = c.project().render;
    Fields f(c.ui, "Roulette");
    draw_bounce_limit_fields(f, r);
    draw_roulette_fields(f, r.roulette);
    quiet_text(formula(r.roulette));
    int map = int(view.map);
    if (f.choice("Viewport", map, RouletteView::map_names, "What the viewport shows: the image, or a map of the effect of roulette."))
        view.map = RouletteView::Map(map);
    else if (f.changed())
        c.apply(SetRender{r}, f.gesture());
    draw_survivors(c);
    draw_measured(c, view);
}

} // namespace blush
