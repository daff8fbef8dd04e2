// The menu bar: all commands that are in a menu, with their shortcuts.
#include "ui/panels/panels.h"

#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/imgui_state.h"

#include <algorithm>
#include <cfloat>
#include <filesystem>
#include <fmt/format.h>
#include <imgui_internal.h> // the request of an arrow key
#include <iterator>
#include <string_view>

namespace blush {
namespace {

void item(PanelContext& c, Command command, bool enabled = true, const char* name = nullptr, bool checked = false) {
    const Shortcut& s = shortcut(command);
    if (ImGui::MenuItem(name ? name : s.name, to_string(s.press).c_str(), checked, enabled)) c.ui.commands.push_back(command);
    c.ui.probe.record_last_item(fmt::format("Menu/{}", s.name));
}

// Of names of files and edits.
float max_name_width() { return std::min(ImGui::GetFontSize() * 32, ImGui::GetIO().DisplaySize.x * 0.45f); }

void draw_recent(PanelContext& c) {
    if (!ImGui::BeginMenu("Open recent", !c.ui.settings.recent.empty())) return;
    for (const std::string& file : c.ui.settings.recent) {
        const std::string shown = elided_middle(file, max_name_width());
        if (ImGui::MenuItem((shown + "###" + file).c_str())) c.ui.files.push_back({FileRequest::Use::open, file});
        if (shown != file) tip_for_last_item(c.ui, file.c_str());
    }
    ImGui::EndMenu();
}

void draw_demos(PanelContext& c) {
    if (!ImGui::BeginMenu("Demos", !c.ui.demos.empty())) return;
    for (const std::string& file : c.ui.demos) {
        const std::string name = std::filesystem::path(file).stem().string();
        if (ImGui::MenuItem((elided_middle(name, max_name_width()) + "###" + name).c_str()))
            c.ui.files.push_back({FileRequest::Use::open, file});
        c.ui.probe.record_last_item("Menu/Demos/" + name);
    }
    ImGui::EndMenu();
}

void draw_lessons(PanelContext& c) {
    const bool open = ImGui::BeginMenu("Lessons", !c.ui.lesson.shipped.empty());
    c.ui.probe.record_last_item("Menu/Lessons");
    if (!open) return;
    for (const LessonView::File& lesson : c.ui.lesson.shipped) {
        if (ImGui::MenuItem((lesson.title + "###" + lesson.file.string()).c_str())) c.ui.lesson.to_open = lesson.file;
        c.ui.probe.record_last_item("Menu/Lessons/" + lesson.title);
    }
    ImGui::EndMenu();
}

constexpr const char* menus[] = {"File", "Edit", "Lights", "View", "Window", "Help"};

// Left and Right go on to the neighbouring menu. ImGui closes a menu if they lead to nothing in it, such as a submenu.
void turn_to_neighbour(MenuBarView& bar) {
    constexpr int count = int(std::size(menus));
    bar.to_open = bar.turn != 0 && !any_popup_open() ? (bar.open + bar.turn + count) % count : -1;
    bar.turn = bar.open >= 0 ? int(ImGui::IsKeyPressed(key::right)) - int(ImGui::IsKeyPressed(key::left)) : 0;
    bar.open = -1;
    if (bar.to_open >= 0) ImGui::NavMoveRequestCancel(); // ImGui's own, which goes on along the bar and would close the menu
}

bool begin_menu(PanelContext& c, const char* name) {
    const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(name);
    c.ui.probe.record(std::string("Menu bar/") + name, {at.x, at.y, size.x, ImGui::GetFrameHeight()});
    // A menu that is taller than the window scrolls. The status bar stays visible.
    ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, ImGui::GetIO().DisplaySize.y - 2.5f * ImGui::GetFrameHeight()});
    MenuBarView& bar = c.ui.menu_bar;
    const int index = int(std::ranges::find(menus, std::string_view(name)) - std::begin(menus));
    if (bar.to_open == index) ImGui::OpenPopup(name);
    const bool open = ImGui::BeginMenu(name);
    if (open) bar.open = index;
    return open;
}

void draw_file_menu(PanelContext& c) {
    item(c, Command::open);
    draw_recent(c);
    draw_demos(c);
    c.ui.probe.record_last_item("Menu/Demos");
    item(c, Command::import_scene);
    item(c, Command::environment);
    const Node* node = c.scene().nodes.find(c.ui.selected);
    item(c, Command::ies, node && c.scene().lights.contains(node->light));
    item(c, Command::reload);
    item(c, Command::import_report, true, nullptr, c.ui.import_report.open);
    ImGui::Separator();
    item(c, Command::save_scene);
    item(c, Command::save_scene_as);
    ImGui::Separator();
    item(c, Command::snapshot_exr);
    item(c, Command::snapshot_png);
    item(c, Command::snapshot_folder);
    item(c, Command::snapshots_beside_scene, !c.ui.settings.snapshot_folder.empty());
    ImGui::Separator();
    item(c, Command::farm, true, nullptr, c.ui.farm.open);
    ImGui::Separator();
    item(c, Command::load_convergence);
    ImGui::Separator();
    item(c, Command::quit);
}

void draw_edit_menu(PanelContext& c) {
    const Document& d = c.document;
    const auto named = [](const char* verb, const std::string& edit) {
        return elided(fmt::format("{}: {}", verb, edit), max_name_width());
    };
    item(c, Command::undo, d.can_undo(), d.can_undo() ? named("Undo", d.undo_label()).c_str() : nullptr);
    item(c, Command::redo, d.can_redo(), d.can_redo() ? named("Redo", d.redo_label()).c_str() : nullptr);
    item(c, Command::history, true, nullptr, c.ui.show_history);
    item(c, Command::undelete_snapshot, c.ui.snapshots.can_put_back());
    ImGui::Separator();
    const bool selected = c.scene().nodes.contains(c.ui.selected);
    item(c, Command::duplicate, selected);
    item(c, Command::rename, selected);
    item(c, Command::remove, selected);
    item(c, Command::clear_selection, selected);
    ImGui::Separator();
    item(c, Command::add_ground);
    item(c, Command::add_catcher);
}

void draw_lights_menu(PanelContext& c) {
    if (ImGui::BeginMenu("Add")) {
        for (const Command command :
             {Command::add_point, Command::add_spot, Command::add_sun, Command::add_rectangle, Command::add_disk, Command::add_sphere})
            item(c, command);
        ImGui::EndMenu();
    }
    item(c, Command::light_by_studio);
    item(c, Command::light_by_sky);
    ImGui::Separator();
    const Node* node = c.scene().nodes.find(c.ui.selected);
    const bool light = node && c.scene().lights.contains(node->light);
    item(c, Command::mute);
    item(c, Command::solo);
    item(c, Command::group_lights, light);
    ImGui::Separator();
    item(c, Command::place_highlight, light, nullptr, c.ui.placing_by == PlacingBy::highlight);
    item(c, Command::place_shadow, light, nullptr, c.ui.placing_by == PlacingBy::shadow);
    item(c, Command::look_through_light, light || c.ui.light_camera, nullptr, c.ui.light_camera.has_value());
    ImGui::Separator();
    item(c, Command::light_table, true, nullptr, c.ui.light_table.open);
}

void draw_text_size(PanelContext& c) {
    const bool open = ImGui::BeginMenu("Text size");
    c.ui.probe.record_last_item("Menu/Text size");
    if (!open) return;
    for (const int size : {80, 90, 100, 110, 125, 150, 175, 200}) {
        const std::string name = fmt::format("{} %", size);
        if (ImGui::MenuItem(name.c_str(), nullptr, c.ui.settings.text_size == size)) c.ui.settings.text_size = size;
        c.ui.probe.record_last_item("Menu/Text size/" + name);
    }
    ImGui::EndMenu();
}

void draw_view_menu(PanelContext& c) {
    item(c, Command::frame_selection, c.scene().nodes.contains(c.ui.selected));
    item(c, Command::frame_all);
    item(c, Command::camera_view);
    item(c, Command::toggle_projection, true, nullptr, c.scene().view.lens.orthographic);
    item(c, Command::toggle_overlays, true, nullptr, c.ui.settings.overlays);
    item(c, Command::toggle_zoom, true, nullptr, c.ui.zoom.scale > 0);
    draw_text_size(c);
    ImGui::Separator();
    item(c, Command::exposure_up);
    item(c, Command::exposure_down);
    item(c, Command::exposure_reset);
    item(c, Command::exposure_meter, c.frame != nullptr);
    item(c, Command::exposure_auto, true, nullptr, c.project().view.auto_exposure != AutoExposure::off);
    item(c, Command::pick_white, c.frame != nullptr);
    item(c, Command::reset_white, c.project().view.white != Vec3{1, 1, 1});
    item(c, Command::toggle_denoise, c.denoiser_problem.empty(), nullptr, c.ui.denoise.wants_denoised());
    ImGui::Separator();
    item(c, Command::render_region, c.frame != nullptr);
    item(c, Command::render_all, c.project().render.region != ImageRegion{});
    item(c, Command::pause, true, nullptr, c.ui.paused);
    ImGui::Separator();
    const Comparison::Mode mode = c.ui.snapshots.compare.mode;
    const bool any = !c.ui.snapshots.list.empty();
    item(c, Command::compare_wipe, any, nullptr, mode == Comparison::Mode::wipe);
    item(c, Command::compare_flicker, any, nullptr, mode == Comparison::Mode::flicker);
    item(c, Command::compare_difference, any, nullptr, mode == Comparison::Mode::difference);
    ImGui::Separator();
    item(c, Command::measure, c.frame != nullptr);
    item(c, Command::meters, true, nullptr, c.ui.meters.open);
    item(c, Command::paths, true, nullptr, c.ui.paths.open);
    item(c, Command::bleed, true, nullptr, c.ui.bleed.open);
    item(c, Command::scopes, true, nullptr, c.ui.scopes.open);
    item(c, Command::light_mix, true, nullptr, c.ui.light_mix.open);
    item(c, Command::bounces, true, nullptr, c.ui.bounces.open);
    item(c, Command::convergence, true, nullptr, c.ui.convergence.open);
    item(c, Command::roulette, true, nullptr, c.ui.roulette.open);
    item(c, Command::strategies, true, nullptr, c.ui.strategies.open);
    item(c, Command::integrators, true, nullptr, c.ui.integrators.open);
    item(c, Command::samplers, true, nullptr, c.ui.sampler.open);
    item(c, Command::health, true, nullptr, c.ui.health.open);
}

} // namespace

void draw_menu_bar(PanelContext& c) {
    turn_to_neighbour(c.ui.menu_bar);
    if (begin_menu(c, "File")) {
        draw_file_menu(c);
        ImGui::EndMenu();
    }
    if (begin_menu(c, "Edit")) {
        draw_edit_menu(c);
        ImGui::EndMenu();
    }
    if (begin_menu(c, "Lights")) {
        draw_lights_menu(c);
        ImGui::EndMenu();
    }
    if (begin_menu(c, "View")) {
        draw_view_menu(c);
        ImGui::EndMenu();
    }
    if (begin_menu(c, "Window")) {
        item(c, Command::toggle_panels, true, nullptr, c.ui.panels_hidden);
        item(c, Command::full_screen);
        item(c, Command::presentation, true, nullptr, c.ui.presentation.on);
        item(c, Command::snapshot_strip, true, nullptr, c.ui.snapshots.open);
        item(c, Command::dock_all, std::ranges::any_of(c.ui.settings.dock.tabs, &DockTab::floats));
        ImGui::Separator();
        ImGui::MenuItem("Desktop's file dialog", nullptr, &c.ui.settings.desktop_file_dialog);
        tip_for_last_item(c.ui, "Use the desktop's file dialog, if available, instead of Blush's file browser.");
        ImGui::EndMenu();
    }
    if (begin_menu(c, "Help")) {
        item(c, Command::guide);
        item(c, Command::shortcuts);
        draw_lessons(c);
        ImGui::EndMenu();
    }
}

} // namespace blush
