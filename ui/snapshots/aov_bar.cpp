#include "ui/snapshots/aov_bar.h"

#include "ui/snapshots/aov_pixels.h"
#include "ui/snapshots/image_pixels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

void draw_list(PanelContext& c, const Frame* frame) {
    ImageView::Show before = ImageView::Show::beauty;
    for (const AovEntry& e : aov_list(frame)) {
        const bool begins_part =
            e.view.show == ImageView::Show::group || e.view.show == ImageView::Show::bounces || e.view.show == ImageView::Show::strategy;
        if (e.view.show != before && begins_part) ImGui::Separator();
        before = e.view.show;
        const ImGuiSelectableFlags flags = e.possible ? 0 : ImGuiSelectableFlags_Disabled;
        const std::string shown = elided(e.name, ImGui::GetFontSize() * 20);
        if (ImGui::Selectable((shown + "###" + e.name).c_str(), c.ui.aov == e.view, flags)) show_aov(c, e.view);
        if (c.ui.aov == e.view) ImGui::SetItemDefaultFocus(); // arrow keys go on from there
        c.ui.probe.record_last_item("Viewport/AOV/" + e.name);
        if (!e.needs.empty() || shown != e.name) tip_for_last_item(c.ui, (e.needs.empty() ? e.name : e.needs).c_str());
    }
}

// On a field, so that it is readable over any image.
void draw_mark(PanelContext& c) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + guide_mark_width(), low.y + side}, tone::field,
                                              ImGui::GetStyle().FrameRounding);
    guide_mark(c.ui, "Guide/Viewport", guide_page::viewport, side);
}

} // namespace

void show_aov(PanelContext& c, const AovView& view) {
    const bool lacks = needs_bounces(view.show) && c.frame && c.frame->bounces.empty();
    const bool lacks_strategies = view.show == ImageView::Show::strategy && c.frame && c.frame->strategies.empty();
    c.ui.aov = view;
    c.ui.bounces.mode = BouncesView::Mode::image; // one of the two modes controls the viewport
    if (lacks_strategies) c.ui.toasts.note("Strategy AOVs are switched on: the render restarts");
    if (lacks) c.ui.toasts.note("Bounce AOVs are switched on: the render restarts");
}

void draw_aov_bar(PanelContext& c, const ImageRect& seen) {
    const float em = ImGui::GetFontSize(), width = em * 9, gap = em * 0.2f, whole = width + gap + guide_mark_width();
    if (c.ui.snapshots.compare.mode != Comparison::Mode::off || seen.width < width * 2) return;
    ImGui::SetNextWindowPos({std::round(seen.x + seen.width - whole - em * 0.5f), std::round(seen.y + em * 0.5f)});
    ImGui::SetNextWindowSize({whole, ImGui::GetFrameHeight()});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::Begin("aovs", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar(3);
    ImGui::SetNextItemWidth(width);
    const Frame* frame = c.frame.get();
    const float room = width - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x;
    const std::string name = elided(name_of(c.ui.aov, frame), room);
    const bool open = ImGui::BeginCombo("##aov", name.c_str(), ImGuiComboFlags_HeightLargest);
    if (!open) {
        c.ui.probe.record_last_item("Viewport/AOV");
        tip_for_last_item(c.ui, "The AOV that the viewport shows. Comma and full stop step through the list.");
    } else {
        draw_list(c, frame);
        ImGui::EndCombo();
    }
    ImGui::SameLine(0, gap);
    draw_mark(c);
    ImGui::End();
}

void draw_map_scale(ImDrawList& draw, const ImageRect& seen, const Frame& frame, const ImageView& view) {
    const auto scale = is_special(frame, view) ? map_scale(frame, view.show) : std::nullopt;
    // Between the line at the upper edge and the environment dial.
    const float em = ImGui::GetFontSize(), top = em * 4.4f, room = seen.height - top - em * 6, swatch = em * 1.1f;
    const float height = std::floor(std::min(em * 14, room));
    if (!scale || height < em * 4) return;
    const ImVec2 at{seen.x + em, std::floor(seen.y + top + (room - height) / 2)};
    draw.AddRectFilled({at.x - em * 0.5f, at.y - em * 1.8f}, {at.x + em * 6, at.y + height + em * 0.8f}, IM_COL32(20, 20, 20, 220),
                       em * 0.2f);
    draw.AddText({at.x, at.y - em * 1.4f}, tone::text, scale->title.c_str());
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
        const Vec3 c = scale->color((float(i) + 0.5f) / steps);
        const float low = at.y + height * (1 - float(i) / steps), high = at.y + height * (1 - float(i + 1) / steps);
        draw.AddRectFilled({at.x, std::floor(high)}, {at.x + swatch, std::floor(low)}, ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1}));
    }
    draw.AddRect({at.x, at.y}, {at.x + swatch, at.y + height}, tone::field_filled);
    const std::string* labels[] = {&scale->high, &scale->middle, &scale->low};
    for (int i = 0; i < 3; ++i)
        draw.AddText({at.x + swatch + em * 0.6f, at.y + height * float(i) / 2 - em * 0.5f}, tone::text, labels[i]->c_str());
}

} // namespace blush
