// Strategies panel: BSDF sampling, light sampling and MIS side by side, with their errors over time and what each contributes to MIS.
#include "ui/lab_panel.h"
#include "ui/panels/panels.h"
#include "ui/panels/strategies/heuristic_fields.h"
#include "ui/views/lab/strategies_view.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/widgets/segments.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace blush {
namespace {

constexpr int text_rows = 3;     // below each image
constexpr float least_image = 3; // height, ems

void draw_choices(PanelContext& c, StrategiesView& view) {
    static constexpr const char *budgets[] = {"Equal time", "Equal samples"}, *metrics[] = {"RMSE", "relMSE"};
    const float gap = ImGui::GetFontSize();
    view.show = StrategiesView::Show(
        segments(c.ui, "Strategies/Show", StrategiesView::show_names, int(view.show),
                 "Image: what each strategy renders alone. Variance: of one sample of each. MIS weight: the share of each pixel that a "
                 "strategy contributes to the image of MIS. MIS variance: of what one sample contributes to it."));
    same_line_if_fits(segments_width(budgets), gap);
    view.budget =
        StrategyBudget(segments(c.ui, "Strategies/Budget", budgets, int(view.budget),
                                "Equal time: each strategy gets the same processor time. Equal samples: each gets the same number of "
                                "samples per pixel. A change starts again."));
    same_line_if_fits(segments_width(metrics), gap);
    view.metric = ErrorMetric(segments(c.ui, "Strategies/Error", metrics, int(view.metric),
                                       "RMSE: root mean squared error, in nits. relMSE: mean of the squared error divided by the squared "
                                       "value. MIS: estimated from its half buffers. The others: measured against the image of MIS."));
}

// Settings of the image: its renders follow them, and the Render tab has them, too.
void draw_mis_settings(PanelContext& c) {
    const float em = ImGui::GetFontSize();
    RenderSettings r = c.project().render;
    choose_heuristic(r.heuristic, segments(c.ui, "Strategies/Heuristic", heuristic_names, int(r.heuristic.rule), heuristic_tip));
    if (r.heuristic != c.project().render.heuristic) c.apply(SetRender{r});
    const ImVec2 number{14 * em, ImGui::GetFrameHeight()};
    same_line_if_fits(number.x, em);
    ImGui::BeginChild("number", number, false, ImGuiWindowFlags_NoScrollbar);
    {
        Fields f(c.ui, "Strategies");
        draw_heuristic_number(f, r.heuristic);
        if (f.changed()) c.apply(SetRender{r}, f.gesture());
    }
    ImGui::EndChild();
    const char* const name = "Compensate MIS";
    same_line_if_fits(ImGui::GetFrameHeightWithSpacing() + ImGui::CalcTextSize(name).x, em);
    if (ImGui::Checkbox(name, &r.mis_compensation)) c.apply(SetRender{r});
    c.ui.probe.record_last_item(fmt::format("Strategies/{}", name));
    tip_for_last_item(c.ui, "Light sampling leaves the even part of an environment to BSDF sampling (Karlik et al. 2019).");
}

void text_line(PanelContext& c, const std::string& text, ImU32 color, float width, const std::string& record = {}) {
    elided_text(c.ui, text, color, width);
    if (!record.empty()) c.ui.probe.record_last_item("Strategies/" + record);
}

// Samples and seconds in one row, the error in two.
void draw_figures(PanelContext& c, const StrategySide& side, size_t k, float width) {
    const std::string name = strategy_names[k];
    text_line(c, fmt::format("{} spp, {:.2f} s", side.samples, side.seconds), tone::text, width,
              fmt::format("{}/{} samples in {:.3f} s", name, side.samples, side.seconds));
    const ErrorMetric metric = c.ui.strategies.metric;
    const Interval e = side.error(metric);
    const char* const of = metric == ErrorMetric::rmse ? "RMSE" : "relMSE";
    if (e.known) {
        text_line(c, fmt::format("{} {:.3g}", of, e.value), tone::text, width, fmt::format("{}/Error known", name));
        text_line(c, fmt::format("{:.3g} to {:.3g}", e.low, e.high), tone::dim_text, width);
    } else {
        text_line(c, fmt::format("{} not known", of), tone::dim_text, width);
        tip_for_last_item(c.ui, "Too few samples, an interval that contains 0, or few pixels that carry the error.");
        text_line(c, "", tone::dim_text, width);
    }
}

// One image with its name above and its numbers below, in a column of this width.
void draw_side(PanelContext& c, const StrategyReport* report, size_t k, ImVec2 size, float column) {
    const float em = ImGui::GetFontSize();
    ImGui::BeginGroup();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 mark = ImGui::GetCursorScreenPos();
    draw.AddRectFilled({mark.x, mark.y + em * 0.2f}, {mark.x + em * 0.7f, mark.y + em * 0.9f}, parse_color(strategy_color(k)));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em);
    text_line(c, strategy_names[k], tone::text, column - em);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    c.ui.probe.record_last_item(fmt::format("Strategies/{}/{}", strategy_names[k], c.strategies ? "Image" : "No image"));
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, tone::surround);
    if (report && c.strategies) draw.AddImage(c.strategies, at, {at.x + size.x, at.y + size.y}, {0, float(k) / 3}, {1, float(k + 1) / 3});
    if (report)
        draw_figures(c, report->sides[k], k, column);
    else
        for (int row = 0; row < text_rows; ++row) text_line(c, "", tone::dim_text, column);
    ImGui::EndGroup();
}

// Three columns, as high as `height` with their text if the images then have a size that shows anything.
void draw_sides(PanelContext& c, const StrategyReport* report, float height) {
    const float gap = std::round(ImGui::GetFontSize() * 0.6f), line = ImGui::GetTextLineHeightWithSpacing();
    const float aspect =
        report ? float(report->width) / float(report->height) : float(c.render_width) / float(std::max(1, c.render_height));
    const float column = std::max(1.f, std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3)), left = ImGui::GetCursorPosX();
    const float highest = std::max(ImGui::GetFontSize() * least_image, height - (text_rows + 1) * line - ImGui::GetStyle().ItemSpacing.y);
    const float width = std::max(1.f, std::floor(std::min(column, highest * aspect)));
    for (size_t k = 0; k < std::size(strategy_names); ++k) {
        if (k > 0) ImGui::SameLine(left + float(k) * (column + gap));
        draw_side(c, report, k, {width, std::max(1.f, std::floor(width / aspect))}, column);
    }
}

// What is below the images. `notes`: what matters for how to read them; the rest is dim.
struct Texts {
    std::vector<std::string> notes, rest;
    float height(float width) const {
        float sum = 0;
        for (const auto* list : {&notes, &rest})
            for (const std::string& text : *list)
                sum += ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y + ImGui::GetStyle().ItemSpacing.y;
        return sum;
    }
};

Texts texts_of(const StrategyReport* report, StrategiesView::Show show) {
    Texts t;
    if (!report) {
        t.rest.push_back("The first round is being rendered.");
        return t;
    }
    t.notes = strategy_notes(*report);
    t.rest.push_back(strategy_caption(*report, show));
    return t;
}

void draw_texts(PanelContext& c, const Texts& texts) {
    for (const std::string& note : texts.notes) {
        wrapped_text(note);
        c.ui.probe.record_last_item("Strategies/Note");
    }
    for (const std::string& text : texts.rest) quiet_text(text);
}

void draw_chart(PanelContext& c, const StrategyReport* report, float height) {
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.f), height}, origin = ImGui::GetCursorScreenPos();
    const Plot plot = strategy_plot(report ? *report : StrategyReport(), c.ui.strategies.metric);
    const ImFont& font = *ImGui::GetFont();
    const float em = ImGui::GetFontSize();
    const PlotLayout l = compute_plot_layout(plot, plot_metrics(size, font, em, false));
    draw_plot(*ImGui::GetWindowDrawList(), plot, l, origin, font, em, plot_tones_dark());
    ImGui::Dummy(size);
    for (size_t k = 0; k < std::size(strategy_names); ++k)
        c.ui.probe.record_last_item(fmt::format("Strategies/Chart/{}/{} points", strategy_names[k], plot.curves[k].points.size()));
    if (!l.curves.empty()) return;
    const char* const text = "No error is known yet.";
    const float width = std::min(ImGui::CalcTextSize(text).x, size.x - 4 * em), from = origin.x + (size.x - width) / 2;
    ImGui::GetWindowDrawList()->AddText(&font, em, {from, origin.y + size.y / 2 - 2 * em}, tone::dim_text, text, nullptr, width + 1);
}

} // namespace

void draw_strategy_report(PanelContext& c, const StrategyReport* report) {
    const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
    draw_choices(c, c.ui.strategies);
    draw_mis_settings(c);
    const Texts texts = texts_of(report, c.ui.strategies.show);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    if (room.x < 2 * room.y || room.x < 40 * em) {
        draw_sides(c, report, em * 30);
        draw_texts(c, texts);
        return draw_chart(c, report, std::max(ImGui::GetContentRegionAvail().y, em * 14));
    }
    // In a flat dock the chart is beside the images.
    const float width = std::floor(room.x * 0.62f);
    ImGui::BeginChild("images", {width, 0});
    draw_sides(c, report, ImGui::GetContentRegionAvail().y - texts.height(width));
    draw_texts(c, texts);
    ImGui::EndChild();
    ImGui::SameLine(0, 2 * gap);
    ImGui::BeginChild("chart", {0, 0});
    draw_chart(c, report, std::max(ImGui::GetContentRegionAvail().y, em * 8));
    ImGui::EndChild();
}

void draw_strategies_panel(PanelContext& c) {
    StrategiesView& view = c.ui.strategies;
    if (const std::string& failure = measure_while_open(c, view, StrategyWork::Input{c.scene(), lab_image_settings(c), view.budget});
        !failure.empty())
        return quiet_text(failure);
    draw_strategy_report(c, view.state.output.get());
}

} // namespace blush
