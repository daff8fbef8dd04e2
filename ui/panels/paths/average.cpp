#include "core/math.h"
#include "ui/panels/paths/sections.h"
#include "ui/widgets/bars.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/value_text.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

Plot mean_plot(const PathSet& set) {
    Plot plot{"", "paths", "", {}, {}, {}};
    PlotCurve mean{"mean", plot_color_on_dark(0), {}, PlotCurve::Line::solid, PlotCurve::Dots::none};
    PlotCurve half{"± 95 %", plot_color_on_dark(1), {}, PlotCurve::Line::solid, PlotCurve::Dots::none};
    for (const RunningMean& m : set.means) {
        mean.points.push_back({double(m.samples), m.mean, m.low, m.high});
        half.points.push_back({double(m.samples), m.half()});
    }
    plot.curves = {mean, half};
    // Through the last point, as the first ones are the least certain.
    if (!half.points.empty() && half.points.back().y > 0) {
        const PlotCurve::Point& last = half.points.back();
        PlotCurve guide{"1/√N", "#909090", {}, PlotCurve::Line::dashed, PlotCurve::Dots::none};
        for (const PlotCurve::Point& p : half.points) guide.points.push_back({p.x, last.y * std::sqrt(last.x / p.x)});
        plot.curves.push_back(guide);
    }
    return plot;
}

// The names of the curves in a row above the chart, where they cover none of them.
void draw_key(const Plot& plot) {
    for (size_t k = 0; k < plot.curves.size(); ++k) {
        if (k > 0) ImGui::SameLine(0, ImGui::GetFontSize());
        ImGui::PushStyleColor(ImGuiCol_Text, parse_color(plot.curves[k].color));
        ImGui::TextUnformatted(plot.curves[k].name.c_str());
        ImGui::PopStyleColor();
    }
}

void draw_mean_plot(PanelContext& c, const PathSet& set) {
    const float em = ImGui::GetFontSize();
    const ImFont& font = *ImGui::GetFont();
    const Plot plot = mean_plot(set);
    draw_key(plot);
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.f), em * 12}, origin = ImGui::GetCursorScreenPos();
    draw_plot(*ImGui::GetWindowDrawList(), plot, compute_plot_layout(plot, plot_metrics(size, font, em, false)), origin, font, em,
              plot_tones_dark());
    ImGui::InvisibleButton("mean", size);
    c.ui.probe.record_last_item("Paths/Mean");
    tip_for_last_item(c.ui,
                      "Mean of the first N paths with its 95 % interval, and half the width of the interval, which falls as 1/√N. It is "
                      "that of independent samples; Sobol points are at least as good.");
}

// Bars of the number of paths, on a log scale so that a single firefly is seen, and of their share of the light.
void draw_histogram(PanelContext& c, const LogHistogram& h) {
    if (h.counts.empty()) return quiet_text("No path has found light.");
    const float em = ImGui::GetFontSize(), height = em * 4.5f, width = std::max(ImGui::GetContentRegionAvail().x, 1.f);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + width, at.y + height}, tone::line);
    const float step = width / float(h.counts.size());
    const double most = double(*std::ranges::max_element(h.counts));
    for (size_t k = 0; k < h.counts.size(); ++k) {
        const float left = at.x + step * float(k) + 1, right = std::max(left + 1, left + step - 2), bottom = at.y + height;
        const float count = height * float(std::log1p(double(h.counts[k])) / std::log1p(most));
        draw.AddRectFilled({left, bottom - count}, {right, bottom}, tone::field_filled);
        draw.AddRectFilled({left, bottom - height * float(std::min(h.shares[k], 1.0))}, {(left + right) / 2, bottom}, tone::light);
    }
    ImGui::InvisibleButton("histogram", {width, height});
    c.ui.probe.record_last_item("Paths/Histogram");
    tip_for_last_item(
        c.ui, "Contributions of the paths, from the smallest to the largest. Grey: the number of paths, on a log scale. Yellow: their "
              "share of the light. Few paths at the right with much of the light are fireflies.");
    const std::string low = shown_number(h.low), high = shown_number(h.high) + " nits";
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(low.c_str());
    ImGui::SameLine(width - ImGui::CalcTextSize(high.c_str()).x + ImGui::GetStyle().WindowPadding.x);
    ImGui::TextUnformatted(high.c_str());
    ImGui::PopStyleColor();
    if (h.zeros > 0) quiet_text(fmt::format("{} paths have found no light.", h.zeros));
}

void draw_split(PanelContext& c, const char* scope, const char* heading, const std::vector<std::pair<std::string, Vec3d>>& parts,
                double whole, const char* tip) {
    quiet_text(heading);
    std::vector<Bar> bars;
    for (const auto& [name, light] : parts) {
        const double share = whole > 0 ? dot(luminance_weights, light) / whole : 0;
        if (share > 0) bars.push_back({name, share, fmt::format("{:.1f} %", 100 * share)});
    }
    draw_bars(c.ui, scope, bars, tip);
}

void draw_splits(PanelContext& c, const PathSet& set) {
    const double whole = dot(luminance_weights, set.sum.mean);
    std::vector<std::pair<std::string, Vec3d>> lengths, strategies;
    for (size_t k = 0; k < set.sum.by_length.size(); ++k)
        lengths.emplace_back(k == 0                              ? "seen"
                             : k + 1 == set.sum.by_length.size() ? fmt::format("{}+", k)
                                                                 : fmt::format("{}", k),
                             set.sum.by_length[k]);
    constexpr std::array names{"BSDF", "guided", "NEE", "manifold", "light vertices", "light paths"};
    static_assert(names.size() == std::tuple_size_v<LightByStrategy>);
    for (size_t k = 0; k < set.sum.by_strategy.size(); ++k) strategies.emplace_back(names[k], set.sum.by_strategy[k]);
    draw_split(c, "Paths/Bounces", "Mean by the number of bounces", lengths, whole,
               "Share of the mean's luminance. Seen: the camera sees the light itself.");
    draw_split(
        c, "Paths/Strategies", "Mean by strategy", strategies, whole,
        "Share of the mean's luminance, by the strategy that found it: a ray that met the light after BSDF sampling or path guiding, NEE, "
        "manifold sampling, light vertices or light paths.");
}

// The pixel in the newest image, if it is that of the click.
std::string image_text(const PanelContext& c) {
    const PathsView& view = c.ui.paths;
    const PathWork::Input& at = *view.request;
    if (at.pixels.size() != 1 || !c.frame || c.frame->width != at.settings.width || c.frame->height != at.settings.height) return {};
    if (c.scene().view != view.view) return {};
    const size_t i = size_t(at.pixels[0].y) * size_t(c.frame->width) + size_t(at.pixels[0].x);
    const float* rgba = &c.frame->rgba[4 * i];
    return fmt::format("; the image has {}", shown_number(double(luminance(Vec3{rgba[0], rgba[1], rgba[2]}))));
}

} // namespace

void draw_path_average(PanelContext& c, const PathSet& set) {
    if (set.means.empty()) return;
    const RunningMean& m = set.means.back();
    const Vec3d& rgb = set.sum.mean;
    quiet_text(fmt::format("Mean luminance {} ± {:.2g} nits{}", shown_number(m.mean), m.half(), image_text(c)));
    c.ui.probe.record_last_item("Paths/Mean text");
    quiet_text(fmt::format("Linear RGB {}  {}  {}", shown_number(rgb.x), shown_number(rgb.y), shown_number(rgb.z)));
    draw_mean_plot(c, set);
    draw_histogram(c, set.contributions);
    draw_splits(c, set);
    for (const std::string& what : set.left_out) quiet_text("Not in the sum: " + what + ".");
}

} // namespace blush
