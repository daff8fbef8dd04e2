#include "ui/window/window_settings.h"

#include "core/files.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace blush {
namespace {

constexpr size_t max_panel_settings = 1000, max_ids = 100000, max_floating_text = 1 << 16;
constexpr size_t max_snapshots = 64, max_bookmarks = 64, max_instruments = 64, max_plans = 64;

// Reads the entry if it exists with the right type and range; otherwise `value` is unchanged.
template <class T> void read(const nlohmann::json& json, const char* key, T& value, T low, T high) {
    const auto it = json.find(key);
    if (it == json.end() || !it->is_number()) return;
    const double number = it->get<double>();
    if (std::isfinite(number)) value = T(std::clamp(number, double(low), double(high)));
}
void read(const nlohmann::json& json, const char* key, bool& value) {
    const auto it = json.find(key);
    if (it != json.end() && it->is_boolean()) value = it->get<bool>();
}
void read(const nlohmann::json& json, const char* key, std::string& value) {
    const auto it = json.find(key);
    if (it != json.end() && it->is_string()) value = it->get<std::string>();
}

void read_strings(const nlohmann::json& json, const char* key, std::vector<std::string>& strings, size_t most) {
    const auto list = json.find(key);
    if (list == json.end() || !list->is_array()) return;
    for (const auto& entry : *list)
        if (entry.is_string() && strings.size() < most) strings.push_back(entry.get<std::string>());
}

void read_ids(const nlohmann::json& json, const char* key, std::vector<uint32_t>& ids) {
    const auto list = json.find(key);
    if (list == json.end() || !list->is_array()) return;
    for (const auto& id : *list)
        if (id.is_number_unsigned() && ids.size() < max_ids) ids.push_back(id.get<uint32_t>());
}

void read_plans(const nlohmann::json& json, std::vector<PlanMemory>& plans) {
    const auto list = json.find("plans");
    if (list == json.end() || !list->is_array()) return;
    for (const auto& entry : *list) {
        PlanMemory plan;
        if (!entry.is_object()) continue;
        read(entry, "folder", plan.folder);
        read(entry, "in_strip", plan.in_strip, int64_t(0), int64_t(1) << 53);
        if (!plan.folder.empty() && plans.size() < max_plans) plans.push_back(std::move(plan));
    }
}

nlohmann::json plans_json(const std::vector<PlanMemory>& plans) {
    nlohmann::json list = nlohmann::json::array();
    for (const PlanMemory& plan : plans) list.push_back({{"folder", plan.folder}, {"in_strip", plan.in_strip}});
    return list;
}

SceneMemory read_scene(const nlohmann::json& json) {
    SceneMemory m;
    if (!json.is_object()) return m;
    read(json, "file", m.file);
    read(json, "zoom", m.zoom, 0., 1e3);
    read(json, "u", m.u, 0., 1.);
    read(json, "v", m.v, 0., 1.);
    read_ids(json, "selected", m.selected);
    read(json, "material", m.material, 0u, UINT32_MAX);
    read_ids(json, "turned", m.turned);
    read(json, "mix_group", m.mix_group);
    read_strings(json, "snapshots", m.snapshots, max_snapshots);
    read_strings(json, "instruments", m.instruments, max_instruments);
    read_plans(json, m.plans);
    return m;
}

void read_dock(const nlohmann::json& json, Dock& dock) {
    const auto found = json.find("dock");
    if (found == json.end() || !found->is_object()) return;
    read(*found, "right", dock.sizes.right, 1.f, 200.f);
    read(*found, "bottom", dock.sizes.bottom, 1.f, 200.f);
    read(*found, "front_right", dock.front[0]);
    read(*found, "front_bottom", dock.front[1]);
    const auto tabs = found->find("tabs");
    if (tabs == found->end() || !tabs->is_array()) return;
    for (const auto& entry : *tabs) {
        DockTab tab;
        bool bottom = false;
        if (!entry.is_object()) continue;
        read(entry, "id", tab.id);
        read(entry, "bottom", bottom);
        read(entry, "floats", tab.floats);
        tab.side = bottom ? DockSide::bottom : DockSide::right;
        const bool known = std::ranges::count(dock.tabs, tab.id, &DockTab::id) > 0;
        if (!tab.id.empty() && !known && dock.tabs.size() < max_instruments) dock.tabs.push_back(std::move(tab));
    }
}

nlohmann::json dock_json(const Dock& dock) {
    nlohmann::json tabs = nlohmann::json::array();
    for (const DockTab& tab : dock.tabs) tabs.push_back({{"id", tab.id}, {"bottom", tab.side == DockSide::bottom}, {"floats", tab.floats}});
    return {{"right", dock.sizes.right},
            {"bottom", dock.sizes.bottom},
            {"front_right", dock.front[0]},
            {"front_bottom", dock.front[1]},
            {"tabs", tabs}};
}

void read_panels(const nlohmann::json& json, std::map<std::string, double>& panels) {
    const auto found = json.find("panels");
    if (found == json.end() || !found->is_object()) return;
    for (const auto& [name, value] : found->items())
        if (value.is_number() && panels.size() < max_panel_settings) panels[name] = value.get<double>();
}

nlohmann::json scenes_json(const std::vector<SceneMemory>& scenes) {
    nlohmann::json list = nlohmann::json::array();
    for (const SceneMemory& m : scenes)
        list.push_back({{"file", m.file},
                        {"zoom", m.zoom},
                        {"u", m.u},
                        {"v", m.v},
                        {"selected", m.selected},
                        {"material", m.material},
                        {"turned", m.turned},
                        {"mix_group", m.mix_group},
                        {"snapshots", m.snapshots},
                        {"instruments", m.instruments},
                        {"plans", plans_json(m.plans)}});
    return list;
}

} // namespace

std::filesystem::path window_settings_file() {
    const auto folder = user_folder("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? folder : folder / "blush" / "window.json";
}

WindowSettings read_window_settings(const std::filesystem::path& file) {
    WindowSettings settings;
    std::ifstream in(file);
    const nlohmann::json json = nlohmann::json::parse(in, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object()) return settings;
    read(json, "width", settings.width, 320, 16384);
    read(json, "height", settings.height, 240, 16384);
    read(json, "maximized", settings.maximized);
    read(json, "outliner", settings.splitters.outliner, 1.f, 100.f);
    read(json, "inspector", settings.splitters.inspector, 1.f, 100.f);
    read_dock(json, settings.dock);
    read(json, "text_size", settings.text_size, min_text_size, max_text_size);
    read(json, "follow_viewport", settings.follow_viewport);
    read(json, "overlays", settings.overlays);
    read(json, "snapshot_folder", settings.snapshot_folder);
    read(json, "snapshot_files", settings.snapshot_files);
    read(json, "snapshot_half", settings.snapshot_half);
    read(json, "snapshot_film", settings.snapshot_film);
    read(json, "snapshot_memory", settings.snapshot_memory, int64_t(1), int64_t(1) << 30);
    read(json, "desktop_file_dialog", settings.desktop_file_dialog);
    read(json, "browser_folder", settings.browser_folder);
    read(json, "floating", settings.floating);
    if (settings.floating.size() > max_floating_text) settings.floating.clear();
    read_panels(json, settings.panels);
    if (const auto scenes = json.find("scenes"); scenes != json.end() && scenes->is_array()) {
        for (const auto& entry : *scenes)
            if (settings.scenes.size() < remembered_files) settings.scenes.push_back(read_scene(entry));
    }
    read_strings(json, "bookmarks", settings.bookmarks, max_bookmarks);
    read_strings(json, "recent", settings.recent, remembered_files);
    return settings;
}

Result<void> write_window_settings(const std::filesystem::path& file, const WindowSettings& settings) {
    const nlohmann::json json{{"width", settings.width},
                              {"height", settings.height},
                              {"maximized", settings.maximized},
                              {"outliner", settings.splitters.outliner},
                              {"inspector", settings.splitters.inspector},
                              {"dock", dock_json(settings.dock)},
                              {"text_size", settings.text_size},
                              {"follow_viewport", settings.follow_viewport},
                              {"overlays", settings.overlays},
                              {"recent", settings.recent},
                              {"bookmarks", settings.bookmarks},
                              {"snapshot_folder", settings.snapshot_folder},
                              {"snapshot_files", settings.snapshot_files},
                              {"snapshot_half", settings.snapshot_half},
                              {"snapshot_film", settings.snapshot_film},
                              {"snapshot_memory", settings.snapshot_memory},
                              {"desktop_file_dialog", settings.desktop_file_dialog},
                              {"browser_folder", settings.browser_folder},
                              {"panels", settings.panels},
                              {"floating", settings.floating},
                              {"scenes", scenes_json(settings.scenes)}};
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    const std::filesystem::path temporary = file.string() + ".new";
    std::ofstream out(temporary);
    // A path may contain bytes that are not UTF-8; they are replaced instead of throwing.
    out << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    out.close();
    if (!out) return Error{file.string(), "cannot write the window's settings", ""};
    std::filesystem::rename(temporary, file, error);
    if (error) return Error{file.string(), "cannot write the window's settings: " + error.message(), ""};
    return {};
}

void remember_recent(std::vector<std::string>& recent, const std::string& file) {
    std::erase(recent, file);
    recent.insert(recent.begin(), file);
    if (recent.size() > remembered_files) recent.resize(remembered_files);
}

} // namespace blush
