#include "ui/snapshots/snapshot_strip.h"

#include "ui/gl/texture_id.h"
#include "ui/viewport/regions.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

constexpr float card_width = 9, card_gap = 0.6f; // ems

// Button A or B of a card: shows and selects the side of the comparison.
void side_button(PanelContext& c, const Snapshot& s, uint64_t& side, const char* letter, const ImVec2& at) {
    ImGui::SetCursorScreenPos(at);
    const bool chosen = side == s.id;
    ImGui::PushStyleColor(ImGuiCol_Button, chosen ? tone::field_filled : IM_COL32(20, 20, 20, 170));
    ImGui::PushStyleColor(ImGuiCol_Text, chosen ? tone::text : tone::dim_text);
    if (ImGui::SmallButton(fmt::format("{}##{}", letter, s.id).c_str())) {
        if (chosen) {
            side = live_image;
            c.ui.snapshots.compare.mode = Comparison::Mode::off;
        } else {
            c.ui.snapshots.choose(side, s.id);
        }
    }
    ImGui::PopStyleColor(2);
    c.ui.probe.record_last_item(fmt::format("Snapshot/{}/{}", s.id, letter));
    tip_for_last_item(c.ui, "Compare this snapshot: A is left of the wipe, B right of it. The default is the live image.");
}

bool menu_item(PanelContext& c, const char* name, bool enabled = true) {
    const bool pressed = ImGui::MenuItem(name, nullptr, false, enabled);
    c.ui.probe.record_last_item(std::string("Snapshot menu/") + name);
    return pressed;
}

void draw_menu(PanelContext& c, const Snapshot& s) {
    if (!ImGui::BeginPopupContextItem(fmt::format("menu{}", s.id).c_str())) return;
    SnapshotsView& v = c.ui.snapshots;
    if (menu_item(c, "Restore", s.no_state.empty())) v.requests.push_back({SnapshotRequest::What::restore, s.id});
    if (menu_item(c, "Wipe against the live image")) {
        v.compare.a = s.id;
        v.compare.b = live_image;
        v.compare.mode = Comparison::Mode::wipe;
    }
    if (menu_item(c, "Name, note, file...")) {
        v.details = s.id;
        c.ui.docks.to_front.insert("snapshot");
    }
    if (menu_item(c, "Save as EXR")) v.requests.push_back({SnapshotRequest::What::save, s.id});
    ImGui::Separator();
    if (menu_item(c, "Delete")) delete_snapshot(c, s);
    ImGui::EndPopup();
}

void draw_fitting(const std::string& text, const ImVec2& at, float width, ImU32 color) {
    ImGui::GetWindowDrawList()->AddText(at, color, elided(text, width).c_str());
}

// Where its image and samples are, if not in memory; empty: in memory.
const char* place_of(const Snapshot& s) {
    if (s.place == Snapshot::Place::lost) return "file missing";
    if (s.place == Snapshot::Place::file) return s.film_in_file ? "on disk" : "on disk, no samples";
    return s.film || s.layers ? "" : "no samples";
}

void draw_place(PanelContext& c, const Snapshot& s, const ImVec2& low, float width, float bottom) {
    const std::string text = place_of(s);
    if (text.empty()) return;
    const float em = ImGui::GetFontSize();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({low.x + 1, bottom - em * 1.3f}, {low.x + width - 1, bottom - 1}, IM_COL32(20, 20, 20, 170));
    draw_fitting(text, {low.x + em * 0.3f, bottom - em * 1.2f}, width - em * 0.6f, tone::dim_text);
    c.ui.probe.record(fmt::format("Snapshot/{}/{}", s.id, text), {low.x, bottom - em, width, em});
}

// A click restores its state; the buttons and the menu do the rest.
void draw_card(PanelContext& c, const SnapshotPtr& snapshot, const ThumbnailPart& part, float width) {
    const Snapshot& s = *snapshot;
    const float em = ImGui::GetFontSize(), image_height = width * Thumbnail::height / Thumbnail::width;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton(fmt::format("card{}", s.id).c_str(), {width, image_height + em * 2.6f}))
        c.ui.snapshots.requests.push_back({SnapshotRequest::What::restore, s.id});
    ImGui::SetItemAllowOverlap(); // the buttons A and B are over it
    c.ui.probe.record_last_item(fmt::format("Snapshot/{}", s.id));
    const bool hovered = ImGui::IsItemHovered();
    const std::string tip = fmt::format("{}\n{}{}{}\n{}", s.name, s.figures(), s.note.empty() ? "" : "\n", s.note,
                                        s.no_state.empty() ? "Click to restore this state. It can be undone." : s.no_state);
    draw_menu(c, s); // before the tooltip, whose text would otherwise be the item
    tip_for_last_item(c.ui, tip.c_str());

    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 high{at.x + width, at.y + image_height};
    if (part.texture) draw.AddImage(part.texture, at, high, {0, part.v0}, {1, part.v1});
    draw_place(c, s, at, width, high.y);
    draw.AddRect(at, high, hovered ? tone::text : tone::line);
    draw_fitting(s.name, {at.x, high.y + em * 0.15f}, width, tone::text);
    draw_fitting(s.figures(), {at.x, high.y + em * 1.35f}, width, tone::dim_text);
    const ImVec2 after = ImGui::GetCursorScreenPos();
    side_button(c, s, c.ui.snapshots.compare.a, "A", {at.x + em * 0.2f, at.y + em * 0.2f});
    side_button(c, s, c.ui.snapshots.compare.b, "B", {at.x + em * 1.6f, at.y + em * 0.2f});
    ImGui::SetCursorScreenPos(after);
}

} // namespace

float snapshot_strip_height(const SnapshotsView& v) {
    if (!v.open || v.list.empty()) return 0;
    const float em = ImGui::GetFontSize();
    return card_width * em * Thumbnail::height / Thumbnail::width + em * 2.6f + 2 * card_gap * em + ImGui::GetStyle().ScrollbarSize;
}

void delete_snapshot(PanelContext& c, const Snapshot& s) {
    const std::string name = s.name;
    c.ui.snapshots.remove(s.id);
    c.ui.toasts.add({Toast::Kind::note, name + " deleted", "", Command::undelete_snapshot});
}

void draw_snapshot_strip(PanelContext& c, const Region& region, const std::function<ThumbnailPart(size_t)>& part) {
    if (region.height <= 0) return;
    const std::vector<SnapshotPtr> list = c.ui.snapshots.list; // a copy: the menu may delete one
    const float em = ImGui::GetFontSize(), width = em * card_width, gap = em * card_gap, mark = guide_mark_width();
    begin_region("Snapshots guide", {region.x + region.width - mark, region.y, mark, region.height}, {.padded = false});
    guide_mark(c.ui, "Guide/Snapshots", guide_page::snapshots, ImGui::GetFrameHeight());
    end_region();
    ImGui::SetNextWindowPos({region.x, region.y});
    ImGui::SetNextWindowSize({region.width - mark, region.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gap, gap});
    ImGui::Begin("Snapshots", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    for (size_t i = 0; i < list.size(); ++i) {
        if (i > 0) ImGui::SameLine(0, gap);
        ImGui::BeginGroup();
        draw_card(c, list[i], part(i), width);
        ImGui::EndGroup();
    }
    int& shown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"));
    if (shown < int(list.size())) ImGui::SetScrollHereX(1); // scrolls to a new one
    shown = int(list.size());
    ImGui::End();
    ImGui::PopStyleVar();
}

void ThumbnailSheet::set_shader(const DisplayShader& shader) {
    shader_ = shader;
    shader_changed_ = true;
}

void ThumbnailSheet::update(const std::vector<SnapshotPtr>& list, const DisplayParameters& numbers) {
    if (list.empty() || !shader_) return;
    const bool other_shader = std::exchange(shader_changed_, false);
    if (other_shader && !pass_.set_shader(*shader_)) return; // the viewport reports the error
    std::vector<uint64_t> ids;
    for (const SnapshotPtr& s : list) ids.push_back(s->id);
    DisplayLook look{numbers, {}};
    look.numbers.false_color = {}; // no false colours: thumbnails should be recognisable, and have no albedo for lux
    if (ids != ids_) {
        std::vector<float> rgba;
        for (const SnapshotPtr& s : list) rgba.insert(rgba.end(), s->thumbnail.rgba.begin(), s->thumbnail.rgba.end());
        pass_.upload(Thumbnail::width, Thumbnail::height * int(list.size()), std::move(rgba));
    }
    if (ids != ids_ || other_shader || look != look_) pass_.begin(look);
    ids_ = ids;
    look_ = look;
    while (pass_.busy()) pass_.advance(1);
}

ThumbnailPart ThumbnailSheet::part(size_t index) const {
    if (index >= ids_.size()) return {};
    const float step = 1 / float(ids_.size());
    return {texture_id(pass_.texture()), float(index) * step, float(index + 1) * step};
}

} // namespace blush
