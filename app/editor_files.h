// What the editor does with files, in the background: opening, importing, environment images, snapshots, reloading.
#pragma once

#include "app/commands/load_scene.h"
#include "color/color_management.h"
#include "core/result.h"
#include "render/showcase.h"
#include "scene/document.h"
#include "ui/background_job.h"
#include "ui/denoise_view.h"
#include "ui/panels/panels.h"
#include "ui/ui_state.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace blush {

// Tells when a file has been rewritten: its time differs from before and has been the same for one look.
class FileWatch {
public:
    void watch(const std::filesystem::path& file);
    bool changed();

private:
    std::filesystem::path file_;
    std::filesystem::file_time_type known_{}, seen_{};
};

class EditorFiles {
public:
    explicit EditorFiles(std::function<void()> wake) : wake_(std::move(wake)) {}

    const std::filesystem::path& scene_file() const { return scene_file_; }
    const Scene& imported() const { return imported_; } // as it is in the file

    // Each starts a job and returns; a newer one of the same sort cancels the older.
    // `overrides` of the command line hold for the file they were given with; `aspect` frames a scene without a camera.
    void open(const std::filesystem::path& file, const SceneOverrides& overrides = {}, float aspect = 1.6f) {
        start_import(file, Purpose::open, overrides, aspect);
    }
    void import_scene(const std::filesystem::path& file) { start_import(file, Purpose::merge, {}, 1); }
    void reload() { start_import(scene_file_, Purpose::reload, {}, 1); }
    void load_environment(const std::filesystem::path& file);
    // Gives the selected light the distribution of a photometric file, at once.
    void load_ies(const std::filesystem::path& file, Document& document, UiState& ui) const;

    // Brings finished work into the document, and looks once a second whether the scene file was rewritten: it is then
    // loaded again, or, when there are edits to lose, a toast offers it. True if a scene was opened.
    bool poll(Document& document, UiState& ui);

    // The job to show progress of.
    std::optional<RunningJob> running() const;
    void cancel();

private:
    enum class Purpose { open, merge, reload };
    void start_import(const std::filesystem::path& file, Purpose purpose, const SceneOverrides& overrides, float aspect);
    bool finish_import(Document& document, UiState& ui, Result<LoadedScene> loaded);
    void finish_environment(Document& document, UiState& ui, Result<ImagePtr> image);
    void look_at_scene_file(const Document& document, UiState& ui);

    std::function<void()> wake_;
    std::filesystem::path scene_file_;
    Scene imported_; // as it came from the file: what snapshots list the edits against
    FileWatch watch_;
    std::chrono::steady_clock::time_point next_look_{};

    Purpose purpose_ = Purpose::open;
    std::filesystem::path importing_, environment_;
    std::unique_ptr<BackgroundJob<Result<LoadedScene>>> import_job_;
    std::unique_ptr<BackgroundJob<Result<ImagePtr>>> environment_job_;
};

} // namespace blush
