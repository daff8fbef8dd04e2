#include "app/files/editor_saving.h"

#include "app/common/output_folder.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

// A crash loses less than a minute of work, including the time to write.
constexpr double default_interval = 45; // seconds

// Local time.
std::string time_text(std::filesystem::file_time_type time) {
    const auto system = std::chrono::file_clock::to_sys(time);
    const std::time_t seconds =
        std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::system_clock::duration>(system));
    return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(seconds));
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code missing;
    return std::filesystem::equivalent(a, b, missing);
}

} // namespace

EditorSaving::EditorSaving(EditorFiles& files, Document& document, UiState& ui, std::filesystem::path assets, double interval)
    : files_(files), document_(document), ui_(ui), assets_(std::move(assets)),
      autosave_(recovery_folder(), std::chrono::duration<double>(interval > 0 ? interval : default_interval)) {}

void EditorSaving::save() {
    if (files_.saving() || files_.scene_file().empty()) return;
    if (is_below(files_.scene_file(), assets_)) return ask_for_file();
    if (!files_.written_by_blush()) return ask_about_foreign_file();
    files_.save(files_.scene_file(), document_.project());
}

// NAME.blush.gltf beside NAME.gltf.
std::filesystem::path EditorSaving::name_beside_original() const {
    const std::filesystem::path scene = files_.scene_file();
    return scene.parent_path() / (scene.stem().string() + ".blush" + scene.extension().string());
}

void EditorSaving::ask_about_foreign_file() {
    const std::filesystem::path own = name_beside_original();
    const std::string name = files_.scene_file().filename().string();
    ask({fmt::format("Save over {}?", name),
         fmt::format("Blush did not write this file. Save a copy named {} to keep the original.", own.filename().string()),
         {fmt::format("Save as {}", own.filename().string()), fmt::format("Overwrite {}", name), "Cancel"}},
        [this, own](size_t choice) {
            if (choice == 0) {
                std::error_code unreadable;
                if (std::filesystem::exists(own, unreadable)) return ask_for_file(own); // the dialog asks to replace it
                save_as(own);
            } else if (choice == 1) {
                save_as(files_.scene_file());
            } else {
                after_save_ = {};
            }
        });
}

void EditorSaving::ask_for_file(const std::filesystem::path& proposed) {
    const std::filesystem::path scene = proposed.empty() ? files_.scene_file() : proposed;
    if (scene.empty()) return;
    std::error_code error;
    std::filesystem::path folder = scene.parent_path();
    if (is_below(scene, assets_)) folder = ui_.settings.browser_folder;
    if (!std::filesystem::is_directory(folder, error) || is_below(folder, assets_)) folder = home_folder();
    ui_.browser = FileBrowser{FileRequest::Use::save_scene,     folder, (folder / scene.filename()).string(), {}, true,
                              files_.scene_file().parent_path()};
}

void EditorSaving::save_as(const std::filesystem::path& file) {
    if (!files_.saving()) files_.save(file, document_.project());
}

void EditorSaving::before_losing_edits(const std::string& doing, std::function<void()> then) {
    if (!document_.modified()) return then();
    const std::string name = files_.scene_file().filename().string();
    ask({fmt::format("Save the changes to {}?", name), fmt::format("Otherwise they are lost by {}.", doing), {"Save", "Discard", "Cancel"}},
        [this, then = std::move(then)](size_t choice) {
            if (choice == 1) {
                autosave_.forget();
                then();
            } else if (choice == 0) {
                after_save_ = then;
                save();
            }
        });
}

void EditorSaving::before_reloading(std::function<void(bool keep_edits)> then) {
    if (!document_.modified()) return then(true);
    ask({fmt::format("Reload {} and keep your edits?", files_.scene_file().filename().string()),
         "Edits are reapplied to objects, materials and lights with the same name. On conflicts your edit is kept, and the "
         "import report lists it. Undo returns to the file's version.",
         {"Keep edits", "Discard edits", "Cancel"}},
        [then = std::move(then)](size_t choice) {
            if (choice < 2) then(choice == 0);
        });
}

void EditorSaving::offer_recovery(const std::filesystem::path& scene) {
    const std::vector<RecoveryFile> leftovers = find_recovery_files(recovery_folder());
    const auto wanted =
        std::ranges::find_if(leftovers, [&](const RecoveryFile& l) { return scene.empty() || same_file(l.sidecar.scene, scene); });
    if (wanted == leftovers.end()) return;
    ask({fmt::format("Recover the unsaved changes to {}?", wanted->sidecar.scene.filename().string()),
         fmt::format("Blush ended before they were saved. Last edit: {}.\n{}", time_text(wanted->written), wanted->sidecar.scene.string()),
         {"Recover", "Discard", "Not now"}},
        [this, leftover = *wanted](size_t choice) {
            if (choice == 1) remove_recovery_file(leftover.file);
            if (choice != 0) return;
            recovering_ = leftover;
            files_.recover(leftover.sidecar);
        });
}

void EditorSaving::poll(const EditorFiles::Finished& finished) {
    // The sidecar now belongs to this window.
    if (finished.recovered && recovering_) autosave_.adopt(recovering_->file);
    if (finished.opened) recovering_.reset();
    if (finished.saved && after_save_) std::exchange(after_save_, {})();
    // The save has failed, or the file dialog was cancelled.
    if (after_save_ && !files_.saving() && !ui_.browser && !ui_.dialog && ui_.files.empty()) after_save_ = {};
    if (const auto failed = autosave_.poll(document_, files_.imported(), files_.origin())) ui_.toasts.warn(failed->text());
}

void EditorSaving::poll_dialog() {
    if (!ui_.dialog || !ui_.dialog->chosen) return;
    const size_t choice = *ui_.dialog->chosen;
    ui_.dialog.reset();
    std::exchange(answer_, {})(choice);
}

void EditorSaving::ask(ModalDialog dialog, std::function<void(size_t)> answer) {
    // Hides open popups, which would cover it.
    ui_.browser.reset();
    ui_.pixel.reset();
    ui_.dialog = std::move(dialog);
    answer_ = std::move(answer);
}

} // namespace blush
