// The colour row of Fields: a swatch with a picker, the three numbers, and the eyedropper.
#include "core/srgb.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/value_menu.h"
#include "ui/widgets/value_text.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <cmath>
#include <imgui_internal.h> // for the id of an item
#include <utility>

namespace blush {
namespace {

constexpr float max_color = 1e6f;

ImVec4 shown(const Vec3& linear) { return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z), 1}; }

// The next click in the image sets the field with this id.
void take_dropper(UiState& ui, unsigned field) {
    ui.values.dropper = field;
    ui.values.picked.reset();
    ui.tool = ViewTool::pick_color;
}

} // namespace

bool Fields::apply_color_action(const char* label, Vec3& value, const Vec3& reset) {
    const unsigned id = ImGui::GetItemID();
    if (ui_.values.dropper == id && ui_.values.picked) {
        const Vec3 picked = *std::exchange(ui_.values.picked, std::nullopt);
        ui_.values.dropper = 0;
        const auto clamped = [](float x) { return std::clamp(x, 0.f, max_color); };
        value = {clamped(picked.x), clamped(picked.y), clamped(picked.z)};
        return true;
    }
    switch (value_action(ui_, std::string(scope_) + "/" + label, true, false)) {
    case ValueAction::copy: copy_text(ui_, triple_text(value)); return false;
    case ValueAction::copy_hex: copy_text(ui_, hex_text(value)); return false;
    case ValueAction::copy_srgb: copy_text(ui_, srgb_text(value)); return false;
    case ValueAction::pick: take_dropper(ui_, id); return false;
    case ValueAction::reset: return std::exchange(value, reset) != reset;
    case ValueAction::paste: {
        const auto pasted = pasted_color(pasted_text());
        if (!pasted) {
            warn_invalid_paste(ui_, label, "Use #rrggbb, srgb(r, g, b), or three linear numbers.");
            return false;
        }
        return std::exchange(value, *pasted) != *pasted;
    }
    default: return false;
    }
}

// The popup of the swatch.
bool Fields::draw_picker(const char* label, Vec3& value) {
    const ImVec4 encoded = shown(value), before = shown(ui_.values.before);
    float edited[4] = {encoded.x, encoded.y, encoded.z, 1};
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14);
    bool changed = ImGui::ColorPicker4("##picker", edited,
                                       ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoAlpha | ImGuiColorEditFlags_DisplayHSV |
                                           ImGuiColorEditFlags_Float);
    if (changed) value = {linear_from_srgb(edited[0]), linear_from_srgb(edited[1]), linear_from_srgb(edited[2])};
    changed = finish(label, "", changed);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x, width = ImGui::GetFontSize() * 4, height = ImGui::GetFrameHeight();
    constexpr ImGuiColorEditFlags plain = ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop;
    const std::string path = std::string(scope_) + "/" + label;
    if (ImGui::ColorButton("##before", before, plain, {width, height}) && value != ui_.values.before) {
        value = ui_.values.before;
        changed = changed_ = true;
    }
    ui_.probe.record_last_item(path + "/Before");
    tip_for_last_item(ui_, "The colour before this edit. Click to restore it.");
    ImGui::SameLine(0, 0);
    ImGui::ColorButton("##now", shown(value), plain, {width, height});
    tip_for_last_item(ui_, "The current colour.");
    ImGui::SameLine(0, gap);
    return changed;
}

bool Fields::color(const char* label, Vec3& value, const Vec3& reset, const char* tip) {
    ImGui::PushID(label);
    begin_row(label, tip);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x * 0.6f, total = ImGui::GetContentRegionAvail().x;
    const float swatch = ImGui::GetFrameHeight() * 1.3f, field = std::floor((total - swatch - 3 * gap) / 3);
    const std::string path = std::string(scope_) + "/" + label;
    if (ImGui::ColorButton("##swatch", shown(value), ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {swatch, 0})) {
        ui_.values.before = value;
        ImGui::OpenPopup("picker");
    }
    ui_.probe.record_last_item(path);
    tip_for_last_item(ui_, tip);
    const unsigned id = ImGui::GetItemID();
    bool changed = apply_color_action(label, value, reset);
    changed_ |= changed;
    if (ImGui::BeginPopup("picker")) {
        changed |= draw_picker(label, value);
        if (ImGui::Button("Pick")) {
            take_dropper(ui_, id);
            ImGui::CloseCurrentPopup();
        }
        ui_.probe.record_last_item(path + "/Pick");
        tip_for_last_item(ui_, "Pick the colour of a pixel in the image: scene-linear, before exposure, white balance and view transform.");
        ImGui::EndPopup();
    }
    static constexpr const char* ids[] = {"##R", "##G", "##B"};
    constexpr NumberStyle style{.min = 0, .max = max_color, .step = 0.002f, .format = "%.3f"};
    float* const components[] = {&value.x, &value.y, &value.z};
    const float resets[] = {reset.x, reset.y, reset.z};
    for (int i = 0; i < 3; ++i) {
        ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(field);
        const std::string name = std::string(label) + " " + (ids[i] + 2);
        bool edited = number_field(ids[i], *components[i], style);
        edited |= apply_value_action(name, *components[i], style, resets[i], &value, true);
        changed |= finish(name.c_str(), tip, edited);
    }
    ImGui::PopID();
    return changed;
}

} // namespace blush
