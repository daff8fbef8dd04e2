// Bleed panel: who lights a surface point or a rectangle of the image, as bars with their 95 % intervals, and how far scattered light
// moves its colour; measured again after every edit.
#include "measure/metrics/bleed_text.h"
#include "scene/affine.h"
#include "scene/node_name.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/aov_pixels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace blush {
namespace {

RenderSettings settings_for_probe(const PanelContext& c) {
    RenderSettings settings = c.project().render;
    settings.width = c.render_width;
    settings.height = c.render_height;
    return settings;
}

void follow_probe(PanelContext& c, BleedView& view) {
    if (!view.has_place()) {
        view.runner.reset();
        view.state = {};
        return;
    }
    if (!view.runner) view.runner = std::make_shared<BleedRunner>();
    view.runner->measure({c.scene(), settings_for_probe(c), target_of(view, c.scene(), c.render_width, c.render_height)});
    view.state = view.runner->state();
    if (!view.state.rests && view.state.failure.empty()) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.1);
}

void follow_map(PanelContext& c, BleedView& view) {
    if (!view.map) {
        view.map_runner.reset();
        view.map_state = {};
        return;
    }
    if (!view.map_runner) view.map_runner = std::make_shared<BleedMapRunner>();
    RenderSettings settings = settings_for_probe(c);
    settings.region = {};
    settings.resolution_scale = 1;
    view.map_runner->measure({c.scene(), settings});
    view.map_state = view.map_runner->state();
    if (!view.map_state.rests && view.map_state.failure.empty()) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.2);
}

std::string count_text(int64_t paths) {
    return paths < 1000000 ? fmt::format("{} k", paths / 1000) : fmt::format("{:.1f} M", double(paths) * 1e-6);
}

// One row: a swatch of the light's colour, the name, a bar with its interval, the share. True if it is clicked.
bool draw_share(PanelContext& c, const BleedShare& row, const std::string& name, float figure_width, bool chosen) {
    const float em = ImGui::GetFontSize(), height = std::round(em * 1.4f), gap = em * 0.5f, swatch = em * 0.7f;
    const float width = ImGui::GetContentRegionAvail().x, name_width = std::min(em * 11, width * 0.38f);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(name.c_str());
    const bool clicked = ImGui::InvisibleButton("share", {width, height});
    ImGui::PopID();
    c.ui.probe.record_last_item("Bleed/" + name);
    const bool hovered = ImGui::IsItemHovered();
    const ImU32 text = chosen || hovered ? tone::text : tone::dim_text;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float middle = at.y + height / 2, text_top = at.y + (height - em) / 2;
    draw.AddRectFilled({at.x, middle - swatch / 2}, {at.x + swatch, middle + swatch / 2}, hue_of(to_float(row.rgb)));
    draw.AddText({at.x + swatch + gap, text_top}, text, elided(name, name_width - swatch - gap).c_str());
    const float left = at.x + name_width + gap, room = std::max(em, width - name_width - figure_width - 2 * gap);
    const auto across = [&](double share) { return left + room * float(std::clamp(share, 0.0, 1.0)); };
    draw.AddRectFilled({left, at.y + height * 0.22f}, {left + room, at.y + height * 0.78f}, tone::line);
    draw.AddRectFilled({left, at.y + height * 0.22f}, {across(row.share.value), at.y + height * 0.78f},
                       chosen ? tone::dim_text : tone::field_filled);
    if (row.share.known) {
        draw.AddLine({across(row.share.low), middle}, {across(row.share.high), middle}, tone::text);
        for (const double end : {row.share.low, row.share.high})
            draw.AddLine({across(end), middle - height * 0.18f}, {across(end), middle + height * 0.18f}, tone::text);
    }
    const std::string figure = percent_text(row.share);
    draw.AddText({at.x + width - ImGui::CalcTextSize(figure.c_str()).x, text_top}, tone::text, figure.c_str());
    return clicked;
}

std::string name_of_row(const BleedView& view, const BleedShare& row) {
    return view.list == BleedView::List::senders && row.by == SentBy::light ? row.name + ", direct" : row.name;
}

void draw_shares(PanelContext& c, BleedView& view, const BleedReport& report, BleedTarget::Kind kind) {
    const std::vector<BleedShare>& rows = rows_of(view, report);
    float figure_width = ImGui::GetFontSize() * 5;
    for (const BleedShare& row : rows) figure_width = std::max(figure_width, ImGui::CalcTextSize(percent_text(row.share).c_str()).x);
    const BleedShare* chosen = sender_of(view, report);
    for (const BleedShare& row : rows) {
        const bool clicked = draw_share(c, row, name_of_row(view, row), figure_width, &row == chosen);
        const std::string tip = name_of_row(view, row) + ": " + light_text(row.light, kind);
        tip_for_last_item(c.ui, tip.c_str());
        if (clicked && row.object != 0 && c.scene().nodes.contains({row.object})) {
            view.chosen = row.object;
            c.ui.select({row.object});
        }
    }
}

void draw_report(PanelContext& c, BleedView& view, const BleedReport& report, BleedTarget::Kind kind) {
    wrapped_text(summary_of(report, kind));
    c.ui.probe.record_last_item("Bleed/Summary");
    if (const BleedShare* sender = sender_of(view, report)) {
        wrapped_text(sentence_of(*sender, kind));
        c.ui.probe.record_last_item("Bleed/Sentence");
    }
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.3f});
    draw_shares(c, view, report, kind);
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.3f});
    quiet_text(
        fmt::format("{}, {} paths{}", light_text(report.whole, kind), count_text(report.paths), view.state.rests ? "" : ", measuring"));
    for (const std::string& limit : limits_of(report, c.project().render)) quiet_text(limit);
}

void draw_choices(PanelContext& c, BleedView& view) {
    Fields f(c.ui, "Bleed");
    if (view.has_place()) f.info("Place", place_of(view, c.scene(), c.render_width, c.render_height));
    int quantity = int(view.quantity), list = int(view.list);
    if (view.point && f.choice("Light", quantity, BleedView::quantity_names,
                               "Light that arrives at the point (lux), or that leaves it towards the camera (nits)."))
        view.quantity = BleedView::Quantity(quantity);
    if (view.has_place() && f.choice("Split by", list, BleedView::list_names,
                                     "Who sent the light here last; the light that it comes from; how often it was scattered."))
        view.list = BleedView::List(list);
    f.checkbox("Greatest sender", view.map,
               "Colour each part of the image, 16 x 16 pixels, by the object that sends it the most scattered light. "
               "Runs in the background: four passes of 256 paths in each part.");
}

// The objects of the map, those with the most parts first.
void draw_map_legend(PanelContext& c, const BleedGrid& grid) {
    std::map<uint32_t, int> parts;
    for (const BleedCell& cell : grid.cells)
        if (cell.object != 0) ++parts[cell.object];
    std::vector<std::pair<int, uint32_t>> order;
    for (const auto& [object, count] : parts) order.emplace_back(count, object);
    std::ranges::sort(order, std::greater{});
    constexpr size_t most_shown = 8;
    const float em = ImGui::GetFontSize();
    for (size_t i = 0; i < std::min(order.size(), most_shown); ++i) {
        const Id<Node> id{order[i].second};
        const Node* node = c.scene().nodes.find(id);
        if (!node) continue;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + em * 0.15f}, {at.x + em * 0.7f, at.y + em * 0.85f},
                                                  hue_of(id_color(id.value)));
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em * 1.2f);
        elided_text(c.ui, node_name(c.scene(), id, *node), tone::dim_text);
    }
}

} // namespace

void draw_bleed_panel(PanelContext& c) {
    BleedView& view = c.ui.bleed;
    follow_probe(c, view);
    follow_map(c, view);
    if (ImGui::Button(view.has_place() ? "Probe another place" : "Probe a place")) c.ui.tool = ViewTool::bleed;
    c.ui.probe.record_last_item("Bleed/Probe");
    tip_for_last_item(c.ui, "Click a surface, or drag a rectangle in the image.");
    draw_choices(c, view);
    if (!view.map_state.failure.empty()) quiet_text(view.map_state.failure);
    if (view.map) draw_map_legend(c, view.map_state.output);
    if (!view.has_place())
        return quiet_text("Shows who lights a place: which object or light sent its light there, and how that colours it.");
    if (!view.state.failure.empty()) return quiet_text(view.state.failure);
    if (!view.state.output) return quiet_text("Measuring.");
    draw_report(c, view, *view.state.output, target_of(view, c.scene(), c.render_width, c.render_height).kind);
}

} // namespace blush
