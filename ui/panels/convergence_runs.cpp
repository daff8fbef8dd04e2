#include "ui/panels/convergence_runs.h"

#include "ui/widgets/elided_text.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"
#include "ui/window/time_text.h"

#include <cmath>
#include <fmt/format.h>
#include <imgui_stdlib.h>

namespace blush {
namespace {

using Kind = ConvergencePoint::Kind;
using Origin = ConvergenceRun::Origin;

// Filled if the run is shown in the chart.
void draw_swatch(PanelContext& c, ConvergenceRun& run) {
    const float side = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("shown", {side, side})) run.shown = !run.shown;
    c.ui.probe.record_last_item(fmt::format("Convergence/{}/Show", run.record.name));
    tip_for_last_item(c.ui, "Show or hide the curve.");
    const ImVec2 low{at.x + side * 0.2f, at.y + side * 0.2f}, high{at.x + side * 0.8f, at.y + side * 0.8f};
    const ImU32 color = parse_color(plot_color_on_dark(run.color));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (run.shown)
        draw.AddRectFilled(low, high, color, 2);
    else
        draw.AddRect(low, high, color, 2);
}

void draw_name(PanelContext& c, ConvergenceView& view, ConvergenceRun& run) {
    if (view.renaming == run.id) {
        ImGui::SetNextItemWidth(-FLT_MIN);
        if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
        ImGui::InputText("##name", &view.rename_text, ImGuiInputTextFlags_AutoSelectAll);
        if (!ImGui::IsItemDeactivated()) return;
        view.runs.rename(run.id, view.rename_text);
        view.renaming = 0;
        return;
    }
    elided_text(c.ui, run.record.name, run.shown ? tone::text : tone::dim_text);
    c.ui.probe.record_last_item(fmt::format("Convergence/{}", run.record.name));
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        view.renaming = run.id;
        view.rename_text = run.record.name;
    }
    tip_for_last_item(c.ui, "Double-click to rename.");
}

void figure(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

void draw_figures(const ConvergenceView& view, const ConvergenceRun& run, bool all) {
    auto points = run.record.points(Kind::estimated);
    const Kind kind = points.empty() ? Kind::measured : Kind::estimated;
    if (points.empty()) points = run.record.points(kind);
    const bool any = !points.empty();
    const double error = any ? points.back().error(view.metric).value : 0;
    const Interval slope = fit(run.record, kind, view.metric, view.axis).slope;
    figure(error > 0 ? fmt::format("{:.3g}", error) : "");
    if (all) figure(slope.known ? fmt::format("{}{:.2f}", slope.value <= -0.005 ? "−" : "", std::abs(slope.value)) : "");
    figure(any ? fmt::format("{} spp", points.back().spp) : "");
    if (all) figure(any ? elapsed_text(points.back().seconds) : "");
}

// Returns true if the run is to be removed.
bool draw_buttons(PanelContext& c, ConvergenceRun& run) {
    ImGui::TableNextColumn();
    if (run.origin != Origin::stored) {
        if (ImGui::SmallButton(run.kept ? "Kept" : "Keep")) run.kept = !run.kept;
        c.ui.probe.record_last_item(fmt::format("Convergence/{}/Keep", run.record.name));
        tip_for_last_item(c.ui, "New runs replace the oldest ones. Kept runs are not replaced.");
    }
    ImGui::TableNextColumn();
    if (run.origin == Origin::live) return false;
    const bool removed = ImGui::SmallButton("×");
    c.ui.probe.record_last_item(fmt::format("Convergence/{}/Remove", run.record.name));
    tip_for_last_item(c.ui, "Remove the run from the list.");
    return removed;
}

} // namespace

void draw_convergence_runs(PanelContext& c, ConvergenceView& view, float height) {
    // A narrow table has no columns for slope and time, so that there is room for the names.
    const bool all = ImGui::GetContentRegionAvail().x > ImGui::GetFontSize() * 30;
    if (!ImGui::BeginTable(all ? "runs" : "runs, narrow", all ? 8 : 6, ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit,
                           {0, std::max(height, 1.f)}))
        return;
    int& shown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), int(view.runs.all().size()));
    const bool grown = int(view.runs.all().size()) > shown;
    shown = int(view.runs.all().size());
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("Run", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn(view.metric == ErrorMetric::rmse ? "RMSE" : "relMSE");
    if (all) ImGui::TableSetupColumn("Slope");
    ImGui::TableSetupColumn("Samples");
    if (all) ImGui::TableSetupColumn("Time");
    for (int button = 0; button < 2; ++button) ImGui::TableSetupColumn("");
    ImGui::TableHeadersRow();
    int removed = 0;
    for (const ConvergenceRun& listed : view.runs.all()) {
        ConvergenceRun& run = *view.runs.find(listed.id);
        ImGui::PushID(run.id);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        draw_swatch(c, run);
        ImGui::TableNextColumn();
        draw_name(c, view, run);
        draw_figures(view, run, all);
        if (draw_buttons(c, run)) removed = run.id;
        ImGui::PopID();
    }
    if (grown) ImGui::SetScrollHereY(1); // to the newest
    ImGui::EndTable();
    if (removed) view.runs.remove(removed);
}

} // namespace blush
