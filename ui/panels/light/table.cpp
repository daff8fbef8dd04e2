// Light table: all lights and emissive materials by group, with their share of the image's light and noise. Rows can be dragged
// between groups.
#include "ui/gl/icons.h"
#include "ui/lights/light_groups.h"
#include "ui/lights/light_rows.h"
#include "ui/lights/light_tools.h"
#include "ui/lights/multi_edit.h"
#include "ui/lights/multi_edit_apply.h"
#include "ui/panels/light/drag.h"
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/row_clicks.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/value_text.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <cmath>

namespace blush {
namespace {

constexpr const char* how_to_get_shares =
    "Share of the image's light and noise. Available while the light mix renders groups: choose Groups there.";

constexpr const char* of_its_group = "Share of the whole group: the light mix renders one plane per group.";

// Reports of the frame's groups in the current mix; none if the frame has no groups.
std::vector<GroupReport> reports_of(const PanelContext& c) {
    if (!c.frame || !c.frame->light_groups || !c.mixing) return {};
    return report_groups(*c.frame, c.mixing->names, c.mixing->gains);
}

Icon icon_of(const PanelContext& c, const LightRow& row) {
    if (const Light* light = c.scene().lights.find(row.light)) return icon_of(light->kind);
    return row.environment ? Icon::sun : Icon::mesh;
}

// Button M or S, highlighted while it is on.
bool letter_button(PanelContext& c, const char* letter, bool on, ImU32 lit, const std::string& name, const char* tip) {
    const float size = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(letter, {size, size});
    c.ui.probe.record_last_item(name);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float inset = std::round(size * 0.12f);
    const ImU32 back = on ? lit : ImGui::IsItemHovered() ? tone::field_hovered : tone::field;
    draw.AddRectFilled({at.x + inset, at.y + inset}, {at.x + size - inset, at.y + size - inset}, back, 3);
    const ImVec2 text = ImGui::CalcTextSize(letter);
    draw.AddText({at.x + (size - text.x) / 2, at.y + (size - text.y) / 2}, on ? IM_COL32(20, 20, 20, 255) : tone::dim_text, letter);
    tip_for_last_item(c.ui, tip);
    return pressed;
}

// Selected lights are switched together.
void set_switches(PanelContext& c, const LightRow& row, bool on, bool solo) {
    const Edit edit = with_switches(c.scene(), row, on, solo);
    if (const auto* light = std::get_if<SetLight>(&edit))
        set_light(c, light->id, light->light, no_gesture);
    else
        c.apply(edit);
}

void draw_switches(PanelContext& c, const LightRow& row, const std::string& scope) {
    if (letter_button(c, "M", !row.on, tone::failure, scope + "/Mute", "Mute: the light is off. Mute overrides solo."))
        set_switches(c, row, !row.on, row.solo);
    ImGui::SameLine(0, 0);
    if (letter_button(c, "S", row.solo, tone::warning, scope + "/Solo",
                      "Solo: while a light is solo, all lights that are not solo are off."))
        set_switches(c, row, row.on, !row.solo);
}

void set_intensity(PanelContext& c, const LightRow& row, float intensity) {
    const Gesture gesture = c.ui.gestures.current();
    if (row.light) {
        Light light = *c.scene().lights.find(row.light);
        light.intensity = intensity;
        set_light(c, row.light, light, gesture);
    } else if (row.material) {
        Material material = *c.scene().materials.find(row.material);
        material.emissive_strength = intensity;
        c.apply(SetMaterial{row.material, material}, gesture);
    } else {
        Environment e = c.scene().environment;
        e.intensity = intensity;
        c.apply(SetEnvironment{e}, gesture);
    }
}

void draw_intensity(PanelContext& c, const LightRow& row, const std::string& scope) {
    float value = row.intensity;
    ImGui::SetNextItemWidth(-FLT_MIN);
    const std::string format = fmt::format("{} {}", number_format(double(value)), row.unit);
    const bool changed = ImGui::DragFloat("##intensity", &value, std::max(std::abs(value) * 0.005f, 1e-4f), 0, 1e12f, format.c_str(),
                                          ImGuiSliderFlags_AlwaysClamp);
    wrap_cursor_if_dragged(c.ui);
    if (ImGui::IsItemActivated()) c.ui.gestures.begin();
    if (changed && std::isfinite(value)) set_intensity(c, row, value);
    if (ImGui::IsItemDeactivated()) c.ui.gestures.end();
    c.ui.probe.record_last_item(scope + "/Intensity");
}

// The rename field. True when editing ends; `text` is then the new name if it has changed.
bool rename_field(LightTableView& view) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (std::exchange(view.just_begun, false)) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##name", &view.text, ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
    return entered || ImGui::IsItemDeactivated();
}

void begin_renaming(LightTableView& view, Id<Node> node, const std::string& group, const std::string& text) {
    view.renaming = node;
    view.renaming_group = group;
    view.text = text;
    view.just_begun = true;
}

void draw_name(PanelContext& c, RowClicks& clicks, const LightRow& row, const std::string& group, const std::string& scope) {
    LightTableView& view = c.ui.light_table;
    if (row.light && view.renaming == row.node) {
        if (!rename_field(view)) return;
        Node node = *c.scene().nodes.find(row.node);
        node.name = view.text;
        c.apply(SetNode{row.node, node});
        view.renaming = {};
        return;
    }
    const float height = ImGui::GetFrameHeight();
    const bool selected = row.environment ? c.ui.environment_chosen()
                          : row.material  ? c.ui.selected_material == row.material
                                          : c.ui.is_selected(row.node);
    const bool clicked =
        ImGui::Selectable("##row", selected, ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap, {0, height});
    c.ui.probe.record_last_item(scope);
    if (row.light && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        begin_renaming(view, row.node, {}, row.name);
    if (!row.material) {
        drag_light(row.node, row.name);
        if (const auto dropped = dropped_light()) put_dropped_into_group(c, *dropped, group);
    }
    if (row.light) {
        clicks.row(row.node, clicked);
    } else if (clicked) {
        c.ui.select(row.node, row.material);
        if (row.environment) c.ui.tab = InspectorTab::environment;
    }
    ImGui::SameLine(0, 0);
    icon_item(icon_of(c, row), row.enabled ? tone::light : tone::dim_text, height);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    elided_text(c.ui, row.name, row.enabled ? tone::text : tone::dim_text);
}

// In brackets if it is the share of a whole group.
void draw_share(PanelContext& c, const std::optional<RowShare>& share, std::optional<double> RowShare::*figure) {
    ImGui::AlignTextToFramePadding();
    const std::optional<double> known = share ? (*share).*figure : std::nullopt;
    const std::string text = !known ? "-" : fmt::format(fmt::runtime(share->alone ? "{:.1f} %" : "({:.1f} %)"), 100 * *known);
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x - ImGui::GetFontSize() * 0.4f;
    if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    ImGui::TextUnformatted(text.c_str());
    tip_for_last_item(c.ui, share && !share->alone ? of_its_group : how_to_get_shares);
}

void draw_row(PanelContext& c, RowClicks& clicks, const LightRow& row, const std::string& group, std::span<const GroupReport> reports) {
    const std::string scope = "Light table/" + row.name;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, row.enabled ? tone::text : tone::dim_text);
    draw_name(c, clicks, row, group, scope);
    if (ImGui::TableNextColumn()) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(row.type.c_str());
    }
    ImGui::TableNextColumn();
    draw_intensity(c, row, scope);
    ImGui::TableNextColumn();
    draw_switches(c, row, scope);
    const std::optional<RowShare> share = reports.empty() ? std::nullopt : share_of(row, *c.frame->light_groups, reports);
    for (std::optional<double> RowShare::*figure : {&RowShare::energy, &RowShare::noise}) {
        if (ImGui::TableNextColumn()) draw_share(c, share, figure);
    }
    ImGui::PopStyleColor();
}

// The heading of a group. It is a drop target: dropped rows join the group.
void draw_group(PanelContext& c, const std::string& group) {
    LightTableView& view = c.ui.light_table;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (!group.empty() && view.renaming_group == group) {
        if (!rename_field(view)) return;
        if (!view.text.empty() && view.text != group) c.apply(rename_group(c.scene(), group, view.text), "Rename group " + group);
        view.renaming_group.clear();
        return;
    }
    ImGui::PushFont(heading_font());
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0, 0.5f});
    const std::string shown = elided(group.empty() ? "No group" : group, ImGui::GetContentRegionAvail().x);
    ImGui::Selectable((shown + "##group").c_str(), false, ImGuiSelectableFlags_SpanAllColumns, {0, ImGui::GetFrameHeight()});
    ImGui::PopStyleVar();
    ImGui::PopFont();
    c.ui.probe.record_last_item("Light table/Group/" + group);
    if (shown != group && !group.empty()) tip_for_last_item(c.ui, group.c_str());
    if (!group.empty() && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        begin_renaming(view, {}, group, group);
    if (const auto dropped = dropped_light()) put_dropped_into_group(c, *dropped, group);
}

void draw_rows(PanelContext& c, const std::vector<LightRows>& all) {
    const float em = ImGui::GetFontSize();
    const ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_Resizable | ImGuiTableFlags_NoSavedSettings;
    if (!ImGui::BeginTable("lights", 6, flags, {0, -ImGui::GetFrameHeightWithSpacing() - em * 0.3f})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch, 1.6f);
    // A narrow dock drops the columns that the icon and the light mix show as well.
    const bool narrow = ImGui::GetContentRegionAvail().x < 34 * em;
    const ImGuiTableColumnFlags extra = ImGuiTableColumnFlags_WidthFixed | (narrow ? ImGuiTableColumnFlags_Disabled : 0);
    ImGui::TableSetupColumn("Type", extra, em * 5);
    ImGui::TableSetupColumn("Intensity", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight() * 2);
    ImGui::TableSetupColumn("Energy", extra, em * 4);
    ImGui::TableSetupColumn("Noise", extra, em * 4);
    ImGui::TableHeadersRow();
    RowClicks clicks;
    const std::vector<GroupReport> reports = reports_of(c);
    const bool grouped = all.size() > 1 || !all[0].group.empty();
    int row_number = 0;
    for (const LightRows& group : all) {
        ImGui::PushID(group.group.c_str());
        if (grouped) draw_group(c, group.group);
        for (const LightRow& row : group.rows) {
            ImGui::PushID(++row_number);
            draw_row(c, clicks, row, group.group, reports);
            ImGui::PopID();
        }
        ImGui::PopID();
    }
    clicks.finish(c.ui);
    ImGui::EndTable();
}

void draw_new_group(PanelContext& c) {
    const float width = ImGui::GetContentRegionAvail().x;
    const std::string label = elided("New group from selection, or drop a light here", width - 2 * ImGui::GetStyle().FramePadding.x);
    if (ImGui::Button((label + "##new").c_str(), {width, 0})) c.ui.commands.push_back(Command::group_lights);
    c.ui.probe.record_last_item("Light table/New group");
    if (const auto dropped = dropped_light()) put_dropped_into_group(c, *dropped, unused_group_name(c.scene()));
}

} // namespace

void draw_light_table(PanelContext& c) {
    const std::vector<LightRows> rows = light_rows(c.scene());
    if (rows.empty()) return quiet_text("No lights in this scene. Add a light or an environment.");
    draw_rows(c, rows);
    draw_new_group(c);
}

} // namespace blush
