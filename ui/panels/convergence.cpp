// Convergence panel: error over render time of the current and stored runs, and the predicted time to the target error.
#include "ui/panels/convergence_runs.h"
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/widgets/segments.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace blush {
namespace {

using Kind = ConvergencePoint::Kind;

void toggle(PanelContext& c, const char* name, bool& value, const char* tip) {
    same_line_if_fits(ImGui::GetFrameHeightWithSpacing() + ImGui::CalcTextSize(name).x, ImGui::GetFontSize());
    ImGui::Checkbox(name, &value);
    c.ui.probe.record_last_item(fmt::format("Convergence/{}", name));
    tip_for_last_item(c.ui, tip);
}

void draw_settings(PanelContext& c, ConvergenceView& view) {
    static constexpr const char *metrics[] = {"RMSE", "relMSE"}, *axes[] = {"Seconds", "Samples"};
    const float em = ImGui::GetFontSize();
    view.metric =
        ErrorMetric(segments(c.ui, "Convergence/Error", metrics, int(view.metric),
                             "RMSE: root mean squared error, in the units of the image. relMSE: mean of the squared error divided by the "
                             "squared value, so dark regions count as much as bright ones."));
    same_line_if_fits(em * 10, em);
    view.axis = ProgressAxis(segments(c.ui, "Convergence/Over", axes, int(view.axis), "The x axis of the chart."));
    same_line_if_fits(em * 9, em);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Target");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(em * 5);
    float& target = view.targets[size_t(view.metric)];
    const float speed = std::max(target * 0.01f, 1e-5f);
    ImGui::DragFloat("##target", &target, speed, 0, 1e6f, target > 0 ? "%.3g" : "none", ImGuiSliderFlags_AlwaysClamp);
    wrap_cursor_if_dragged(c.ui);
    c.ui.probe.record_last_item("Convergence/Target");
    tip_for_last_item(c.ui,
                      "Target error. The panel predicts from the fitted slope when it is reached. Drag, or Ctrl+click to type; 0 is none.");
    ImGui::BeginDisabled(!c.denoiser_problem.empty());
    toggle(c, "Denoised", view.denoised,
           "Adds a curve of the denoised image, over render time without denoising time. Its error cannot be estimated from the half "
           "buffers. It is measured against the reference or, without one, against a later raw image of this run that is accurate "
           "enough.");
    ImGui::EndDisabled();
    toggle(c, "Reference", view.reference,
           "Measure against a reference: an image with many samples and another seed. References stored by `blush converge` for "
           "the same scene, "
           "view and size are found. A new one can be rendered.");
}

void draw_reference(PanelContext& c, ConvergenceView& view) {
    using State = ReferenceStatus::State;
    if (!view.reference) return;
    const ReferenceStatus& news = view.reference_status;
    std::string text;
    const char* button = nullptr;
    switch (news.state) {
    case State::none: text = "The search for a reference begins after the first samples."; break;
    case State::looking: text = "Searching for a stored reference"; break;
    case State::absent:
        text = "No stored reference for this image.";
        button = "Render reference";
        break;
    case State::rendering:
        text = fmt::format("Rendering the reference, {:.0f} %. The live render is paused.", std::floor(100 * news.progress));
        button = "Stop";
        break;
    case State::stopping: text = "Stopping"; break;
    case State::there:
        text = fmt::format("Reference: {} spp, its own RMSE is {:.3g}.", news.spp, news.rmse);
        button = "Improve";
        break;
    }
    if (!news.problem.empty()) text += " " + news.problem;
    quiet_text(text);
    if (!button) return;
    same_line_if_fits(ImGui::CalcTextSize(button).x + 2 * ImGui::GetStyle().FramePadding.x);
    if (ImGui::SmallButton(button))
        view.wanted_reference =
            news.state == State::rendering ? ConvergenceView::ReferenceRequest::stop : ConvergenceView::ReferenceRequest::render;
    c.ui.probe.record_last_item("Convergence/Reference/Render");
    tip_for_last_item(c.ui,
                      "Renders twice as many samples as the image or the current reference has. The reference is stored for later runs.");
}

// Draws crosshair lines through the point under the mouse, with its values beside it.
void draw_readout(const ConvergenceView& view, const ConvergencePlot& p, const PlotLayout& l, ImVec2 origin) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float em = ImGui::GetFontSize();
    const auto found = pick(p.plot, l, double(mouse.x - origin.x), double(mouse.y - origin.y), 3 * double(em));
    if (!found || found->curve >= p.sources.size()) return;
    const ConvergencePlot::Source& source = p.sources[found->curve];
    const ImVec2 at{origin.x + float(found->at.x), origin.y + float(found->at.y)};
    const float left = origin.x + float(l.left), right = origin.x + float(l.right), top = origin.y + float(l.top),
                bottom = origin.y + float(l.bottom);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    constexpr ImU32 hair = IM_COL32(255, 255, 255, 70);
    draw.AddLine({at.x, top}, {at.x, bottom}, hair);
    draw.AddLine({left, at.y}, {right, at.y}, hair);
    draw.AddCircle(at, em * 0.35f, parse_color(p.plot.curves[found->curve].color), 0, 2);
    const ConvergenceRun* run = view.runs.find(source.run);
    const std::string text = readout_text(run ? run->record.name : "", source.points[found->point], view.metric);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()), room{em * 0.6f, em * 0.4f};
    // Above and to the right of the point, where a falling curve leaves room, unless that is outside the axes.
    const float x = at.x + em + size.x + 2 * room.x < right ? at.x + em : at.x - em - size.x - 2 * room.x;
    const float y = std::max(top + 1, at.y - em - size.y - 2 * room.y);
    draw.AddRectFilled({x, y}, {x + size.x + 2 * room.x, y + size.y + 2 * room.y}, IM_COL32(18, 18, 18, 235), em * 0.25f);
    draw.AddRect({x, y}, {x + size.x + 2 * room.x, y + size.y + 2 * room.y}, tone::field_filled, em * 0.25f);
    draw.AddText({x + room.x, y + room.y}, tone::text, text.c_str());
}

struct KeyEntry {
    PlotCurve::Line line;
    std::string text;
    float width() const { return ImGui::CalcTextSize(text.c_str()).x + 3.6f * ImGui::GetFontSize(); } // with line sample and gap
};

// Legend of the line styles, from right to left. The list of runs is the legend of the colours.
std::vector<KeyEntry> key_of(const ConvergencePlot& p) {
    if (p.sources.empty()) return {};
    std::vector<KeyEntry> key{{p.plot.curves.back().line, p.plot.curves.back().name}};
    const auto has = [&](Kind kind) { return std::ranges::find(p.sources, kind, &ConvergencePlot::Source::kind) != p.sources.end(); };
    if (has(Kind::denoised)) key.push_back({PlotCurve::Line::dashed, "denoised"});
    if (has(Kind::measured)) key.push_back({PlotCurve::Line::dotted, "raw, measured"});
    if (has(Kind::estimated)) key.push_back({PlotCurve::Line::solid, "raw, estimated"});
    return key;
}

// Right-aligned in the title line; what does not fit is left out.
void draw_key(const std::vector<KeyEntry>& key, const PlotLayout& l, ImVec2 origin) {
    const float em = ImGui::GetFontSize(), y = origin.y + float(l.top) - 1.55f * em;
    float x = origin.x + float(l.right);
    for (const KeyEntry& entry : key) {
        const float width = ImGui::CalcTextSize(entry.text.c_str()).x;
        if (x - entry.width() < origin.x) return;
        ImGui::GetWindowDrawList()->AddText({std::round(x - width), std::round(y)}, tone::dim_text, entry.text.c_str());
        draw_line_sample(*ImGui::GetWindowDrawList(), entry.line, {x - width - 2.4f * em, y + em * 0.6f}, 2 * em, tone::dim_text, em);
        x -= entry.width();
    }
}

void draw_chart(PanelContext& c, const ConvergenceView& view, float height) {
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.f), height}, origin = ImGui::GetCursorScreenPos();
    ConvergencePlot p = convergence_plot(view.runs, view.plot_options(true));
    p.plot.title = std::exchange(p.plot.y_label, {}); // a horizontal title is easier to read than a vertical axis label
    const ImFont& font = *ImGui::GetFont();
    const float em = ImGui::GetFontSize();
    const PlotLayout l = compute_plot_layout(p.plot, plot_metrics(size, font, em, false));
    const std::vector<KeyEntry> key = key_of(p);
    float needed = ImGui::CalcTextSize(p.plot.title.c_str()).x;
    for (const KeyEntry& entry : key) needed += entry.width();
    if (needed > l.right - l.left) p.plot.title.clear(); // the buttons above already show the metric
    draw_plot(*ImGui::GetWindowDrawList(), p.plot, l, origin, font, em, plot_tones_dark());
    draw_key(key, l, origin);
    ImGui::InvisibleButton("chart", size);
    c.ui.probe.record_last_item("Convergence/Chart");
    if (ImGui::IsItemHovered()) draw_readout(view, p, l, origin);
    if (!l.curves.empty()) return;
    const char* const text = "No error estimate yet: both half buffers need samples.";
    const float width = std::min(ImGui::CalcTextSize(text).x, size.x - 4 * em), from = origin.x + (size.x - width) / 2;
    ImGui::GetWindowDrawList()->AddText(&font, em, {from, origin.y + size.y / 2 - 2 * em}, tone::dim_text, text, nullptr, width + 1);
}

// The state of the live run as text.
void draw_summary(const ConvergenceView& view) {
    const ConvergenceRun* live = view.runs.live();
    if (!live) return quiet_text("No run yet.");
    const auto points = live->record.points(Kind::estimated);
    std::string text = fmt::format("{} {}", view.metric == ErrorMetric::rmse ? "RMSE" : "relMSE",
                                   points.empty() ? "not known yet" : error_text(points.back().error(view.metric)));
    text += ",  " + slope_text(fit(live->record, Kind::estimated, view.metric, view.axis).slope);
    if (view.target() > 0) text += ",  " + time_left_text(time_left(live->record, Kind::estimated, view.metric, view.target()));
    wrapped_text(text);
    if (view.denoised && view.waiting > 0)
        quiet_text(fmt::format("{} denoised {} for a raw image{} accurate enough to measure {} against.", view.waiting,
                               view.waiting == 1 ? "image waits" : "images wait", view.reference ? ", or a reference," : "",
                               view.waiting == 1 ? "it" : "them"));
}

void draw_files(PanelContext& c, ConvergenceView& view) {
    if (ImGui::Button("Load...")) c.ui.commands.push_back(Command::load_convergence);
    c.ui.probe.record_last_item("Convergence/Load");
    tip_for_last_item(c.ui, "Add runs from a CSV table that was saved here, or from the convergence.csv of `blush converge`.");
    for (const auto format : {ConvergenceView::Export::csv, ConvergenceView::Export::svg, ConvergenceView::Export::png}) {
        const std::string name = fmt::format("Save {}", ConvergenceView::export_names[int(format)]);
        same_line_if_fits(ImGui::CalcTextSize(name.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x);
        if (ImGui::Button(name.c_str())) view.wanted_export = format;
        c.ui.probe.record_last_item(fmt::format("Convergence/{}", name));
        tip_for_last_item(c.ui, format == ConvergenceView::Export::csv
                                    ? "Saves all points of the visible runs, with confidence intervals, to the snapshot folder."
                                    : "Saves the chart on white to the snapshot folder.");
    }
    const RecorderCost& cost = view.cost;
    if (!(cost.rendering > 0)) return;
    const std::string text =
        fmt::format("recorder {}, estimate {} of the time", share_text(cost.recorder_fraction()), share_text(cost.estimate_fraction()));
    same_line_if_fits(ImGui::CalcTextSize(text.c_str()).x, ImGui::GetFontSize());
    quiet_text(text);
    const std::string tip =
        fmt::format("Of {:.1f} s of rendering in this run, recording errors took {:.3g} ms and measuring them against other images "
                    "{:.3g} ms. Estimating them took {:.3g} ms; the status bar and the stop rules need the estimate in any case. "
                    "Both are limited to half a per cent of the time, with one more measurement when rendering ends.",
                    cost.rendering, 1e3 * cost.recording, 1e3 * cost.measuring, 1e3 * cost.estimating);
    tip_for_last_item(c.ui, tip.c_str());
}

void draw_one_above_the_other(PanelContext& c, ConvergenceView& view) {
    const float em = ImGui::GetFontSize(), line = ImGui::GetFrameHeightWithSpacing();
    draw_settings(c, view);
    draw_reference(c, view);
    const float rows = float(std::min<size_t>(view.runs.all().size(), 6));
    const float below = (rows + 1.5f) * line + (view.denoised ? 2 : 1) * ImGui::GetTextLineHeightWithSpacing() + 2 * line;
    draw_chart(c, view, std::max(ImGui::GetContentRegionAvail().y - below, em * 10));
    draw_summary(view);
    draw_convergence_runs(c, view, std::max(ImGui::GetContentRegionAvail().y - 2 * line, em * 4));
    draw_files(c, view);
}

} // namespace

void draw_convergence_panel(PanelContext& c) {
    ConvergenceView& view = c.ui.convergence;
    const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    if (room.x < 2 * room.y || room.x < 44 * em) return draw_one_above_the_other(c, view);
    // In a flat dock the chart gets the whole height.
    ImGui::BeginChild("chart", {std::floor(room.x * 0.52f), 0});
    draw_chart(c, view, std::max(ImGui::GetContentRegionAvail().y, em * 8));
    ImGui::EndChild();
    ImGui::SameLine(0, 2 * gap);
    ImGui::BeginChild("runs", {0, 0});
    draw_settings(c, view);
    draw_reference(c, view);
    draw_summary(view);
    draw_convergence_runs(c, view, std::max(ImGui::GetContentRegionAvail().y - 2 * ImGui::GetFrameHeightWithSpacing(), em * 4));
    draw_files(c, view);
    ImGui::EndChild();
}

} // namespace blush
