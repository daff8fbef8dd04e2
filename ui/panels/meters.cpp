// Light meters panel: illuminance in lux at points on surfaces, with 95 % confidence intervals, measured again after every edit
// that affects light.
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {
namespace {

// Returns the meters after edits in the table: renamed or removed.
std::vector<LightMeter> draw_table(PanelContext& c) {
    std::vector<LightMeter> meters = c.project().view.meters;
    const auto& readings = c.ui.meters.state.output;
    size_t gone = meters.size();
    if (!ImGui::BeginTable("meters", 4, ImGuiTableFlags_SizingFixedFit)) return meters;
    const float em = ImGui::GetFontSize();
    ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Illuminance", ImGuiTableColumnFlags_WidthFixed, em * (ImGui::GetContentRegionAvail().x < 20 * em ? 5 : 10));
    const bool narrow = ImGui::GetContentRegionAvail().x < 34 * em;
    ImGui::TableSetupColumn("R : G : B", ImGuiTableColumnFlags_WidthFixed | (narrow ? ImGuiTableColumnFlags_Disabled : 0), em * 9);
    ImGui::TableSetupColumn("");
    ImGui::TableHeadersRow();
    for (size_t i = 0; i < meters.size(); ++i) {
        ImGui::PushID(int(i));
        ImGui::TableNextColumn();
        const std::string scope = "Meters/" + meters[i].name;
        std::string name = meters[i].name;
        ImGui::SetNextItemWidth(-FLT_MIN);
        elided_input(c.ui, "##name", name, ImGuiInputTextFlags_AutoSelectAll);
        if (ImGui::IsItemDeactivatedAfterEdit() && !name.empty()) meters[i].name = name;
        c.ui.probe.record_last_item(scope);
        ImGui::TableNextColumn();
        elided_text(c.ui, i < readings.size() ? reading_text(readings[i]) : "...", tone::text);
        c.ui.probe.record_last_item(scope + "/Reading");
        if (ImGui::TableNextColumn() && i < readings.size() && readings[i].rgb.y > 0) {
            const Vec3d& e = readings[i].rgb;
            ImGui::TextUnformatted(fmt::format("{:.2f} : 1 : {:.2f}", e.x / e.y, e.z / e.y).c_str());
        }
        ImGui::TableNextColumn();
        if (ImGui::SmallButton("Remove")) gone = i;
        ImGui::PopID();
    }
    ImGui::EndTable();
    if (gone < meters.size()) meters.erase(meters.begin() + ptrdiff_t(gone));
    return meters;
}

} // namespace

void follow_meters(PanelContext& c) {
    MetersView& view = c.ui.meters;
    const auto& meters = c.project().view.meters;
    if (meters.empty()) {
        view.runner.reset();
        view.state = {};
        return;
    }
    if (!view.runner) view.runner = std::make_shared<MeterRunner>();
    view.runner->measure({c.scene(), c.project().render, places_of(c.scene(), meters)});
    view.state = view.runner->state();
    if (!view.state.rests && view.state.failure.empty()) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.2);
}

void draw_meters_panel(PanelContext& c) {
    const MetersView& view = c.ui.meters;
    ViewSettings v = c.project().view;
    if (v.meters.empty())
        quiet_text("Place a meter on a surface to measure its illuminance.");
    else
        v.meters = draw_table(c);
    if (!view.state.failure.empty()) quiet_text(view.state.failure);
    if (ImGui::Button("Place a meter")) c.ui.tool = ViewTool::meter;
    c.ui.probe.record_last_item("Meters/Place a meter");
    tip_for_last_item(c.ui, "Click a surface. The meter moves with the object and measures the side facing the viewer.");
    if (v != c.project().view) c.apply(SetView{v});
}

} // namespace blush
