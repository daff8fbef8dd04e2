// File operations of the editor, in the background: open, import, environment images, snapshots, reload.
#pragma once

#include "app/common/scene_overrides.h"
#include "color/color_management.h"
#include "core/result.h"
#include "io/gltf/read/import.h"
#include "io/gltf/write/save.h"
#include "io/project/sidecar_json.h"
#include "render/session/published_frames.h"
#include "scene/document/document.h"
#include "ui/jobs/background_job.h"
#include "ui/panels/panels.h"
#include "ui/views/denoise_view.h"
#include "ui/window/ui_state.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace blush {

// Detects that a file was rewritten: its modification time has changed, and is the same in two consecutive checks.
class FileWatch {
public:
    using Time = std::filesystem::file_time_type;
    // Time of the last change; Time{} if the file is missing.
    static Time time_of(const std::filesystem::path& file);
    // `known`: of the version that was read or written.
    void watch(const std::filesystem::path& file, Time known);
    // True once for each new version.
    bool changed();

private:
    std::filesystem::path file_;
    Time known_{}, seen_{};
};

// Command line options for the first file.
struct OpenOptions {
    SceneOverrides overrides = {};
    float aspect = 1.6f;                           // for framing a scene without a camera
    bool keep_settings = false, keep_view = false; // keep them instead of those saved with the scene
};

class EditorFiles {
public:
    explicit EditorFiles(std::function<void()> wake) : wake_(std::move(wake)) {}

    const std::filesystem::path& scene_file() const { return scene_file_; }
    const Scene& imported() const { return imported_; } // the scene as in its file
    const GltfOrigin& origin() const { return origin_; }
    // True if the scene file has settings written by Blush, or was saved by this window.
    bool written_by_blush() const { return written_by_blush_; }

    // Each of these starts a job and returns; it cancels an older job of the same type.
    void open(const std::filesystem::path& file, const OpenOptions& options = {}) { start_import(file, Purpose::open, options); }
    // Opens the scene of a sidecar with its edits. If the file has changed since, edits are reapplied by name, and the import
    // report lists conflicts.
    void recover(const Sidecar& sidecar) { start_import(sidecar.scene, Purpose::open, {}, sidecar); }
    void import_scene(const std::filesystem::path& file) { start_import(file, Purpose::merge); }
    // Reloads the file; `keep_edits`: and reapplies the edits, as one undo step. Keep them also if there is nothing to save: a studio
    // at opening is no edit to save, and another program may have overwritten saved edits.
    void reload(bool keep_edits) {
        keep_edits_ = keep_edits;
        start_import(scene_file_, Purpose::reload);
    }
    // Saves the current document; `file` becomes scene_file().
    void save(const std::filesystem::path& file, const Project& project);
    // Preview of the scene that is being opened, while its textures are loading: a separate document. Null: none.
    Document* preview() { return preview_ ? &*preview_ : nullptr; }
    // What the preview lacks, for the caption above the image.
    const std::string& preview_note() const { return preview_note_; }
    bool saving() const { return save_job_ != nullptr; }
    void load_environment(const std::filesystem::path& file);
    // Reads an image for the texture slot in ui.map, in the background.
    void load_map(const std::filesystem::path& file, UiState& ui);
    // Loads an IES file for the selected light, synchronously.
    void load_ies(const std::filesystem::path& file, Document& document, UiState& ui) const;

    // Applies finished jobs to the document, and checks once per second whether the scene file was rewritten. It is then reloaded
    // or, if there are unsaved edits, a toast offers to reload it.
    struct Finished {
        bool opened = false, recovered = false, saved = false;
        bool stored_exposure = true; // the opened file has an exposure
    };
    Finished poll(Document& document, UiState& ui);

    // The job whose progress is shown.
    std::optional<RunningJob> running() const;
    void cancel();

private:
    enum class Purpose { open, merge, reload };
    // An imported file, with the command line overrides applied.
    struct Opened {
        ImportedScene imported;
        Scene scene;
        std::optional<Scene> lit; // with studio lighting, if the file has no light
        std::optional<Project> recovered;
        std::map<Id<Camera>, float> camera_aspects;
    };
    // Passed from the importing thread to this one.
    class EarlyScene {
    public:
        void put(Opened opened) {
            const std::lock_guard lock(mutex_);
            opened_ = std::move(opened);
        }
        std::optional<Opened> take() {
            const std::lock_guard lock(mutex_);
            return std::exchange(opened_, std::nullopt);
        }

    private:
        std::mutex mutex_;
        std::optional<Opened> opened_;
    };
    void start_import(const std::filesystem::path& file, Purpose purpose, const OpenOptions& options = {},
                      const std::optional<Sidecar>& sidecar = {});
    static Result<Opened> import_file(const std::filesystem::path& file, const OpenOptions& options, const std::optional<Sidecar>& sidecar,
                                      JobProgress& progress, std::function<void(const ImportedScene&)> on_preview_scene);
    // The edited scene on top of a reloaded file.
    struct KeptEdits {
        Scene scene;
        bool unsaved = false; // the file lacks some
    };
    std::optional<KeptEdits> edits_on(Opened& opened, const Document& document, const UiState& ui) const;
    // Settings of the document when this file is open.
    Project opened_project(const Opened& opened, const Project& before) const;
    // Makes the scene the document, with the studio lighting as an undo step of its own if the file has no light.
    void reset_document(Document& document, UiState& ui, Project project, std::optional<Scene> lit) const;
    Finished finish_import(Document& document, UiState& ui, Result<Opened> opened);
    bool finish_save(Document& document, UiState& ui, Result<SavedGltf> saved);
    void finish_environment(Document& document, UiState& ui, Result<ImagePtr> image);
    void finish_map(Document& document, UiState& ui, Result<ImagePtr> image);
    void look_at_scene_file(const Document& document, UiState& ui);

    std::function<void()> wake_;
    std::filesystem::path scene_file_;
    Scene imported_; // as imported from the file: snapshots save edits relative to it
    GltfOrigin origin_;
    bool written_by_blush_ = false;
    std::optional<Scene> exported_; // as another program last wrote the file; none: not known
    bool opened_in_studio_ = false;
    FileWatch watch_;
    std::chrono::steady_clock::time_point next_look_{};

    Purpose purpose_ = Purpose::open;
    std::filesystem::path importing_, environment_, map_file_;
    FileWatch::Time importing_since_{}; // version of the file that is being read
    bool keep_settings_ = false, keep_view_ = false;
    bool keep_edits_ = false;           // for a reload
    std::shared_ptr<EarlyScene> early_; // of the running import
    std::optional<Document> preview_;
    std::string preview_note_;
    Project saving_; // the document when the save started
    std::unique_ptr<BackgroundJob<Result<Opened>>> import_job_;
    std::unique_ptr<BackgroundJob<Result<SavedGltf>>> save_job_;
    MapView map_; // slot that the image is for
    std::unique_ptr<BackgroundJob<Result<ImagePtr>>> environment_job_, map_job_;
};

} // namespace blush
