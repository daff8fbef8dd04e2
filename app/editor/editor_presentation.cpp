#include "app/editor/editor_presentation.h"

#include "app/commands/lesson/lesson_file.h"
#include "ui/panels/instruments.h"
#include "ui/window/theme.h"
#include "ui/window/window.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

constexpr float pointer_radius = 1.5f; // font sizes

// A lesson opens and closes these itself.
bool is_of_lesson(const std::string& id) { return id == "lesson" || std::ranges::find(lesson_panels, id) != lesson_panels.end(); }

void draw_pointer() {
    if (!ImGui::IsMousePosValid()) return;
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float radius = pointer_radius * ImGui::GetFontSize();
    draw.AddCircleFilled(mouse, radius, IM_COL32(255, 255, 255, 40));
    // Two rings, so that it is seen on white and on black.
    draw.AddCircle(mouse, radius, IM_COL32(0, 0, 0, 160), 0, 3);
    draw.AddCircle(mouse, radius, IM_COL32(255, 255, 255, 220), 0, 1.5f);
}

void draw_highlight(const Region& r) {
    const float em = ImGui::GetFontSize(), gap = em / 4;
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    draw.AddRect({r.x - gap, r.y - gap}, {r.x + r.width + gap, r.y + r.height + gap}, tone::light, em / 3, 0, std::max(em / 8, 1.5f));
}

} // namespace

void EditorPresentation::poll(PanelContext c, Window& window) {
    PresentationView& view = c.ui.presentation;
    std::erase_if(view.hidden, [&](const std::string& id) { return !find_instrument(instruments(), id)->is_open(c); });
    if (view.wanted == view.on) return;
    view.wanted ? begin(c, window) : end(c, window);
    window.request_frames(3);
}

void EditorPresentation::begin(PanelContext& c, Window& window) {
    UiState& ui = c.ui;
    const std::vector<std::string> open = open_instruments(instruments(), c);
    kept_ = {window.full_screen(), ui.panels_hidden, ui.snapshots.open, ui.lesson.is_on(), ui.settings.dock, ui.snapshots.compare, open};
    ui.presentation = {.wanted = true, .on = true, .hidden = {}};
    for (const std::string& id : open)
        if (!ui.lesson.is_on() || !is_of_lesson(id)) ui.presentation.hidden.insert(id);
    ui.panels_hidden = ui.snapshots.open = false;
    if (!kept_->full_screen) window.toggle_full_screen();
}

void EditorPresentation::end(PanelContext c, Window& window) {
    UiState& ui = c.ui;
    ui.presentation = {};
    if (!kept_) return;
    // What the user has opened for the talk closes; the panels of a lesson stay those of its step.
    const bool lesson = kept_->lesson || ui.lesson.is_on();
    for (const Instrument& i : instruments()) {
        const bool wanted = std::ranges::count(kept_->open, i.id) > 0;
        if (i.remembered && !(lesson && is_of_lesson(i.id)) && i.is_open(c) != wanted) i.set_open(c, wanted);
    }
    ui.snapshots.compare = kept_->compare;
    ui.snapshots.open = kept_->strip;
    ui.panels_hidden = kept_->panels_hidden;
    const std::array<std::string, 2> shown = std::exchange(ui.settings.dock, kept_->dock).front;
    // Those that come back do not come to the front of their dock; those that were there do.
    ui.docks.open = open_instruments(instruments(), c);
    for (size_t side = 0; side < shown.size(); ++side)
        ui.docks.to_front.insert(lesson && is_of_lesson(shown[side]) ? shown[side] : kept_->dock.front[side]);
    if (window.full_screen() != kept_->full_screen) window.toggle_full_screen();
    kept_.reset();
}

bool EditorPresentation::takes(const KeyPress& press, UiState& ui) {
    if (!ui.presentation.on || press.ctrl || press.shift || press.alt) return false;
    const int first = press.key > key::pad_zero ? key::pad_zero + 1 : key::zero + 1, number = press.key - first;
    if (number < 0 || number > 8) return false;
    SnapshotsView& snapshots = ui.snapshots;
    Comparison& compare = snapshots.compare;
    if (size_t(number) >= snapshots.list.size()) {
        ui.toasts.note(fmt::format("There is no snapshot {}", number + 1),
                       fmt::format("The strip has {}. {} takes one.", snapshots.list.size(), keys_of(shortcut(Command::snapshot_exr))));
        return true;
    }
    const uint64_t id = snapshots.list[size_t(number)]->id;
    const bool shown = compare.mode == Comparison::Mode::flicker && compare.a == id && !compare.shows_b;
    compare = {.mode = shown ? Comparison::Mode::off : Comparison::Mode::flicker, .a = id, .b = live_image, .kind = compare.kind};
    return true;
}

void draw_marks(const UiState& ui) {
    if (ui.dialog || ui.browser) return;
    if (const auto region = ui.probe.watched_region(); region && ui.lesson.is_on()) draw_highlight(*region);
    if (ui.presentation.on) draw_pointer();
}

int text_size_shown(const UiState& ui) {
    const int size = ui.settings.text_size;
    return ui.presentation.on ? std::max(size, std::min(size * presentation_type / 100, max_text_size)) : size;
}

} // namespace blush
