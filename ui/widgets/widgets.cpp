#include "ui/widgets/widgets.h"

#include "core/math.h"
#include "core/text.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/value_menu.h"
#include "ui/widgets/value_text.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <imgui_internal.h> // for arrows

namespace blush {
namespace {

constexpr float label_share = 0.4f; // of a row's width

float label_width() { return std::floor(ImGui::GetWindowContentRegionMax().x * label_share); }

const char* number_format_of(float value, const NumberStyle& style) { return *style.format ? style.format : number_format(double(value)); }

// "%.4g" and "m" -> "%.4g m"; a per cent sign is doubled. A fraction is its own format: ImGui then does not round the value.
std::string format_with_unit(float value, const NumberStyle& style) {
    std::string format = style.fraction ? fraction_text(double(value)) : number_format_of(value, style);
    if (*style.unit) format += ' ';
    for (const char* c = style.unit; *c; ++c) format += *c == '%' ? "%%" : std::string(1, *c);
    return format;
}

// The value, or 0 if the format would show it as a negative zero.
float shown_value(float value, const char* format) {
    if (!(value < 0)) return value + 0.f; // no -0
    char text[64];
    std::snprintf(text, sizeof text, format, double(value));
    return text[0] == '-' && without_sign_of_zero(text)[0] != '-' ? 0.f : value;
}

// In ImGui, Shift makes drags ten times faster; here they become ten times finer.
float drag_speed(float speed) { return ImGui::GetIO().KeyShift ? speed / 100 : speed; }

// Typed into a field that is shown as a fraction: ImGui itself would read "1/125" as 1.
bool type_fraction(const char* name, ImGuiID id, float& value, const NumberStyle& style) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImRect box(low, {low.x + ImGui::CalcItemWidth(), low.y + ImGui::GetFrameHeight()});
    ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
    if (!ImGui::ItemAdd(box, id, nullptr, ImGuiItemFlags_Inputable)) return false;
    char text[64];
    std::snprintf(text, sizeof text, "%s", fraction_text(double(value)).c_str());
    const bool edited = ImGui::TempInputText(box, id, name, text, sizeof text, ImGuiInputTextFlags_CharsScientific);
    const auto typed = edited ? pasted_number(text, style.unit) : std::nullopt;
    return typed && std::exchange(value, float(*typed)) != value;
}

void draw_bar(float fraction, float width) {
    const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + width, low.y + ImGui::GetFrameHeight()};
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const bool hovered = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high);
    const float rounding = ImGui::GetStyle().FrameRounding;
    draw.AddRectFilled(low, high, hovered ? tone::field_hovered : tone::field, rounding);
    const float filled = std::round(width * std::clamp(fraction, 0.f, 1.f));
    if (filled >= 1) draw.AddRectFilled(low, {low.x + filled, high.y}, tone::field_filled, rounding);
}

} // namespace

void wrap_cursor_if_dragged(UiState& ui) {
    const bool typing = ImGui::TempInputIsActive(ImGui::GetItemID());
    if (ImGui::IsItemActive() && !typing && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) ui.wraps_cursor = true;
}

Fields::Fields(UiState& ui, const char* scope) : ui_(ui), scope_(scope) { ImGui::PushID(scope); }
Fields::~Fields() { ImGui::PopID(); }

void Fields::begin_row(const char* label, const char* tip) {
    ImGui::AlignTextToFramePadding();
    const std::string shown = elided(label, label_width() - ImGui::GetCursorPosX());
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.68f, 0.68f, 0.68f, 1));
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopStyleColor();
    tip_for_last_item(ui_, shown == label ? tip : std::string(label).append("\n").append(tip).c_str());
    ImGui::SameLine(label_width());
    ImGui::SetNextItemWidth(-FLT_MIN);
}

bool Fields::finish(const char* label, const char* tip, bool changed) {
    // With Tab, the next field starts in the frame that ends the last one: each ends only its own gesture.
    const unsigned id = ImGui::GetItemID();
    if (ImGui::IsItemActivated()) {
        ui_.gestures.begin();
        ui_.values.active_item = id;
    }
    if (changed) {
        changed_ = true;
        gesture_ = ui_.gestures.current();
    }
    if (ImGui::IsItemDeactivated() && ui_.values.active_item == id) ui_.gestures.end();
    if (!ImGui::IsItemActive()) tip_for_last_item(ui_, tip);
    ui_.probe.record_last_item(std::string(scope_) + "/" + label);
    return changed;
}

bool Fields::apply_value_action(const std::string& name, float& value, const NumberStyle& style, float reset, Vec3* all, bool color) {
    const std::string path = std::string(scope_) + "/" + name;
    switch (value_action(ui_, path, false, all != nullptr)) {
    case ValueAction::copy: copy_text(ui_, number_text(value)); return false;
    case ValueAction::copy_all: copy_text(ui_, triple_text(*all)); return false;
    case ValueAction::reset: return std::exchange(value, reset) != reset;
    case ValueAction::paste: {
        const std::string text = pasted_text();
        if (const auto number = pasted_number(text, style.unit)) {
            const float wanted = float(std::clamp(*number, double(style.min), double(style.max)));
            return std::exchange(value, wanted) != wanted;
        }
        const auto three = !all ? std::nullopt : color ? pasted_color(text) : pasted_triple(text);
        if (!three) {
            warn_invalid_paste(ui_, name, all ? "Use a number, or three numbers." : "Use a number.");
            return false;
        }
        const auto clamped = [&](float x) { return std::clamp(x, style.min, style.max); };
        *all = {clamped(three->x), clamped(three->y), clamped(three->z)};
        return true;
    }
    default: return false;
    }
}

bool Fields::number_field(const char* id, float& value, const NumberStyle& style) {
    const float width = ImGui::CalcItemWidth();
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
    const std::string format = format_with_unit(value, style);
    float edited = shown_value(value, number_format_of(value, style));
    bool changed = false;
    if (style.bar) {
        draw_bar((value - style.min) / (style.max - style.min), width);
        // Dragged like a field: the bar follows the mouse. So a click without movement changes nothing.
        for (const ImGuiCol c : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
            ImGui::PushStyleColor(c, ImVec4(0, 0, 0, 0));
        changed = ImGui::DragFloat(id, &edited, drag_speed((style.max - style.min) / width), style.min, style.max, format.c_str(), flags);
        ImGui::PopStyleColor(3);
    } else if (style.fraction && ImGui::TempInputIsActive(ImGui::GetID(id))) {
        changed = type_fraction(id, ImGui::GetID(id), edited, style);
    } else {
        const float speed = style.step > 0 ? style.step : std::max(std::abs(value) * 0.005f, 1e-4f);
        changed = ImGui::DragFloat(id, &edited, drag_speed(speed), style.min, style.max, format.c_str(), flags);
    }
    wrap_cursor_if_dragged(ui_);
    if (changed && std::isfinite(edited)) value = std::clamp(edited, style.min, style.max);
    return changed && std::isfinite(edited);
}

bool Fields::number(const char* label, float& value, const NumberStyle& style) {
    ImGui::PushID(label);
    begin_row(label, style.tip);
    bool changed = number_field("##value", value, style);
    changed |= apply_value_action(label, value, style, style.reset, nullptr, false);
    ImGui::PopID();
    return finish(label, style.tip, changed);
}

bool Fields::angle(const char* label, float& radians, const NumberStyle& style) {
    constexpr float to_degrees = float(degrees_per_radian);
    NumberStyle degrees_style = style;
    degrees_style.unit = "°";
    degrees_style.format = "";
    float degrees = radians * to_degrees;
    if (!number(label, degrees, degrees_style)) return false;
    radians = degrees / to_degrees;
    return true;
}

bool Fields::integer(const char* label, int64_t& value, int64_t min, int64_t max, int64_t reset, const char* tip) {
    ImGui::PushID(label);
    begin_row(label, tip);
    const float speed = std::max(0.1f, float(std::abs(value)) * 0.01f);
    int64_t edited = value;
    bool changed =
        ImGui::DragScalar("##value", ImGuiDataType_S64, &edited, drag_speed(speed), &min, &max, "%lld", ImGuiSliderFlags_AlwaysClamp);
    wrap_cursor_if_dragged(ui_);
    switch (value_action(ui_, std::string(scope_) + "/" + label, false, false)) {
    case ValueAction::copy: copy_text(ui_, std::to_string(value)); break;
    case ValueAction::reset: edited = reset; break;
    case ValueAction::paste:
        if (const auto number = pasted_number(pasted_text()))
            edited = int64_t(std::clamp(std::round(*number), -9e18, 9e18));
        else
            warn_invalid_paste(ui_, label, "Use a number.");
        break;
    default: break;
    }
    edited = std::clamp(edited, min, max);
    changed |= edited != value;
    if (changed) value = edited;
    ImGui::PopID();
    return finish(label, tip, changed);
}

bool Fields::vector(const char* label, Vec3& value, const Vec3& reset, const NumberStyle& style) {
    static constexpr const char* ids[] = {"##X", "##Y", "##Z"};
    static constexpr ImU32 axis_tones[] = {tone::axis_x, tone::axis_y, tone::axis_z};
    float* const components[] = {&value.x, &value.y, &value.z};
    const float resets[] = {reset.x, reset.y, reset.z};
    ImGui::PushID(label);
    begin_row(label, style.tip);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x * 0.6f, total = ImGui::GetContentRegionAvail().x;
    bool changed = false;
    for (int i = 0; i < 3; ++i) {
        if (i) ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(std::floor((total - 2 * gap) / 3));
        const ImVec2 low = ImGui::GetCursorScreenPos();
        const std::string name = std::string(label) + " " + (ids[i] + 2);
        bool edited = number_field(ids[i], *components[i], style);
        edited |= apply_value_action(name, *components[i], style, resets[i], &value, false);
        const ImVec2 high{low.x + std::max(2.f, ImGui::GetFontSize() / 7), low.y + ImGui::GetFrameHeight()};
        ImGui::GetWindowDrawList()->AddRectFilled(low, high, axis_tones[i], ImGui::GetStyle().FrameRounding, ImDrawFlags_RoundCornersLeft);
        changed |= finish(name.c_str(), style.tip, edited);
    }
    ImGui::PopID();
    return changed;
}

bool Fields::checkbox(const char* label, bool& value, const char* tip) {
    ImGui::PushID(label);
    begin_row(label, tip);
    const bool changed = ImGui::Checkbox("##value", &value);
    ImGui::PopID();
    return finish(label, tip, changed);
}

bool Fields::choice(const char* label, int& index, std::span<const char* const> names, const char* tip) {
    ImGui::PushID(label);
    begin_row(label, tip);
    bool changed = false;
    const std::string chosen = index >= 0 && size_t(index) < names.size() ? names[size_t(index)] : "";
    const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x;
    const std::string shown = elided(chosen, room);
    const bool open = ImGui::BeginCombo("##value", shown.c_str());
    ui_.probe.record_last_item(std::string(scope_) + "/" + label);
    if (!open) tip_for_last_item(ui_, (shown == chosen ? std::string(tip) : chosen.substr(0, chosen.find("##")) + "\n" + tip).c_str());
    if (open) {
        for (int i = 0; i < int(names.size()); ++i) {
            const bool picked = ImGui::Selectable(names[size_t(i)], i == index);
            ui_.probe.record_last_item(std::string(scope_) + "/" + label + "/" + names[size_t(i)]);
            if (i == index) ImGui::SetItemDefaultFocus();
            if (!picked || i == index) continue;
            index = i;
            changed = true;
        }
        ImGui::EndCombo();
    }
    ImGui::PopID();
    if (changed) {
        changed_ = true;
        gesture_ = no_gesture;
    }
    return changed;
}

bool Fields::choice(const char* label, std::string& name, std::span<const std::string> names, const char* tip) {
    std::vector<const char*> texts;
    for (const std::string& n : names) texts.push_back(n.c_str());
    int index = int(std::ranges::find(names, name) - names.begin());
    if (!choice(label, index, std::span<const char* const>(texts), tip)) return false;
    name = names[size_t(index)];
    return true;
}

bool Fields::text(const char* label, std::string& value, const char* tip) {
    ImGui::PushID(label);
    begin_row(label, tip);
    std::string edited = value;
    elided_input(ui_, "##value", edited, ImGuiInputTextFlags_AutoSelectAll);
    const bool changed = ImGui::IsItemDeactivatedAfterEdit() && edited != value;
    if (changed) value = edited;
    ImGui::PopID();
    return finish(label, tip, changed);
}

void Fields::info(const char* label, const std::string& text, const char* tip) {
    begin_row(label, tip);
    ImGui::AlignTextToFramePadding();
    const std::string shown = elided(text, ImGui::GetContentRegionAvail().x);
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopStyleColor();
    tip_for_last_item(ui_, (shown == text || *tip ? std::string(tip) : text).c_str());
}

bool Fields::removable(const std::string& name) {
    ImGui::PushID(name.c_str());
    const float right = ImGui::GetWindowContentRegionMax().x;
    ImGui::SetCursorPosX(label_width() + ImGui::GetStyle().FramePadding.x);
    ImGui::AlignTextToFramePadding();
    elided_text(ui_, name, tone::text, ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.x);
    ImGui::SameLine(right - ImGui::GetFrameHeight());
    const bool pressed = ImGui::Button("×", {ImGui::GetFrameHeight(), 0});
    ui_.probe.record_last_item(std::string(scope_) + "/Remove " + name);
    tip_for_last_item(ui_, "Remove");
    ImGui::PopID();
    changed_ |= pressed;
    return pressed;
}

bool Fields::button(const char* label, const char* tip) {
    ImGui::SetCursorPosX(label_width());
    const bool pressed = ImGui::Button(label, {-FLT_MIN, 0});
    tip_for_last_item(ui_, tip);
    ui_.probe.record_last_item(std::string(scope_) + "/" + label);
    return pressed;
}

bool section(UiState& ui, const char* name, bool open_at_first) {
    const float em = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
    ImGui::Dummy({0, em * 0.2f});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::string key = std::string("section.") + name;
    const auto kept = ui.settings.panels.find(key);
    bool open = kept == ui.settings.panels.end() ? open_at_first : kept->second != 0;
    ImGui::PushFont(heading_font());
    if (ImGui::InvisibleButton(name, {width, height})) ui.settings.panels[key] = open = !open;
    const ImU32 color = ImGui::IsItemHovered() ? IM_COL32_WHITE : tone::text;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddLine(at, {at.x + width, at.y}, tone::line);
    ImGui::RenderArrow(&draw, {at.x, at.y + height * 0.5f - em * 0.38f}, color, open ? ImGuiDir_Down : ImGuiDir_Right, 0.75f);
    draw.AddText({at.x + em * 1.15f, at.y + (height - em) / 2}, color, name);
    ImGui::PopFont();
    ui.probe.record_last_item(std::string("Section/") + name);
    return open;
}

void quiet_text(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    wrapped_text(text);
    ImGui::PopStyleColor();
}

} // namespace blush
