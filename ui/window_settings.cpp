#include "ui/window_settings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace blush {
namespace {

constexpr size_t recent_limit = 10;

// The entry if it is there and of the right type and range, else what `value` was.
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

} // namespace

std::filesystem::path window_settings_file() {
    const auto folder = [](const char* variable) {
        const char* text = std::getenv(variable);
        return std::filesystem::path(text ? text : "");
    };
    if (const auto config = folder("XDG_CONFIG_HOME"); !config.empty()) return config / "blush" / "window.json";
    if (const auto home = folder("HOME"); !home.empty()) return home / ".config" / "blush" / "window.json";
    return {};
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
    read(json, "follow_viewport", settings.follow_viewport);
    read(json, "overlays", settings.overlays);
    read(json, "snapshot_folder", settings.snapshot_folder);
    read(json, "snapshot_files", settings.snapshot_files);
    read(json, "snapshot_half", settings.snapshot_half);
    read(json, "snapshot_film", settings.snapshot_film);
    read(json, "browser_folder", settings.browser_folder);
    if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array()) {
        for (const auto& entry : *recent) {
            if (entry.is_string() && settings.recent.size() < recent_limit) settings.recent.push_back(entry.get<std::string>());
        }
    }
    return settings;
}

Result<void> write_window_settings(const std::filesystem::path& file, const WindowSettings& settings) {
    const nlohmann::json json{{"width", settings.width},
                              {"height", settings.height},
                              {"maximized", settings.maximized},
                              {"outliner", settings.splitters.outliner},
                              {"inspector", settings.splitters.inspector},
                              {"follow_viewport", settings.follow_viewport},
                              {"overlays", settings.overlays},
                              {"recent", settings.recent},
                              {"snapshot_folder", settings.snapshot_folder},
                              {"snapshot_files", settings.snapshot_files},
                              {"snapshot_half", settings.snapshot_half},
                              {"snapshot_film", settings.snapshot_film},
                              {"browser_folder", settings.browser_folder}};
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    const std::filesystem::path temporary = file.string() + ".new";
    std::ofstream out(temporary);
    // A path may hold bytes that are not UTF-8; they are replaced rather than thrown over.
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
    if (recent.size() > recent_limit) recent.resize(recent_limit);
}

} // namespace blush
