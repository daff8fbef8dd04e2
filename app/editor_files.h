// What the editor does with files, in the background: opening, importing, environment images, snapshots, reloading.
#pragma once

#include "app/scene_overrides.h"
#include "color/color_management.h"
#include "core/result.h"
#include "io/gltf_import.h"
#include "io/gltf_save.h"
#include "io/sidecar_json.h"
#include "render/showcase.h"
#include "scene/document.h"
#include "ui/background_job.h"
#include "ui/denoise_view.h"
#include "ui/panels/panels.h"
#include "ui/ui_state.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

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

// What the command line says of the file that it names.
struct OpenOptions {
    SceneOverrides overrides = {};
    float aspect = 1.6f;        // frames a scene without a camera
    bool keep_settings = false, keep_view = false; // rather than take those that were saved with the scene
};

class EditorFiles {
public:
    explicit EditorFiles(std::function<void()> wake) : wake_(std::move(wake)) {}

    const std::filesystem::path& scene_file() const { return scene_file_; }
    const Scene& imported() const { return imported_; } // as it is in the file
    const GltfOrigin& origin() const { return origin_; }
    // The scene file holds settings that Blush writes, or has been saved by this window.
    bool written_by_blush() const { return written_by_blush_; }

    // Each starts a job and returns; a newer one of the same sort cancels the older.
    void open(const std::filesystem::path& file, const OpenOptions& options = {}) { start_import(file, Purpose::open, options); }
    // Opens the scene of a sidecar with its edits. If the file changed since, edits are made again by name, and the import report lists conflicts.
    void recover(const Sidecar& sidecar) { start_import(sidecar.scene, Purpose::open, {}, sidecar); }
    void import_scene(const std::filesystem::path& file) { start_import(file, Purpose::merge); }
    // Takes up the file as it is now; `keep_edits`: with the edits that were made to it here, as one step that can be undone.
    void reload(bool keep_edits) {
        keep_edits_ = keep_edits;
        start_import(scene_file_, Purpose::reload);
    }
    // The document as it is now; scene_file() is then the file.
    void save(const std::filesystem::path& file, const Project& project);
    // The scene that is being opened, while its textures are still missing: a document of its own, to be looked at. Null: there is none.
    Document* preview() { return preview_ ? &*preview_ : nullptr; }
    bool saving() const { return save_job_ != nullptr; }
    void load_environment(const std::filesystem::path& file);
    // Reads an image for the map that the window's state says, in the background.
    void load_map(const std::filesystem::path& file, UiState& ui);
    // Gives the selected light the distribution of a photometric file, at once.
    void load_ies(const std::filesystem::path& file, Document& document, UiState& ui) const;

    // Brings finished work into the document, and looks once a second whether the scene file was rewritten: it is then
    // loaded again, or, when there are edits to lose, a toast offers it.
    struct Finished {
        bool opened = false, recovered = false, saved = false;
        bool stored_exposure = true; // what was opened says how it is exposed
    };
    Finished poll(Document& document, UiState& ui);

    // The job to show progress of.
    std::optional<RunningJob> running() const;
    void cancel();

private:
    enum class Purpose { open, merge, reload };
    // An imported file, with the overrides in its scene.
    struct Opened {
        ImportedScene imported;
        Scene scene;
        std::optional<Scene> lit; // with the studio rig, where nothing in the file gives light
        std::optional<Project> recovered;
        std::map<Id<Camera>, float> camera_aspects;
    };
    // From the importing thread to this one.
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
                                      JobProgress& progress, std::function<void(const ImportedScene&)> on_untextured);
    // The settings that a document has once this is open.
    Project opened_project(const Opened& opened, const Project& before) const;
    // Takes the scene up as the document, with the studio rig as a step of its own if the file has no light.
    void reset_document(Document& document, UiState& ui, Project project, std::optional<Scene> lit) const;
    Finished finish_import(Document& document, UiState& ui, Result<Opened> opened);
    bool finish_save(Document& document, UiState& ui, Result<SavedGltf> saved);
    void finish_environment(Document& document, UiState& ui, Result<ImagePtr> image);
    void finish_map(Document& document, UiState& ui, Result<ImagePtr> image);
    void look_at_scene_file(const Document& document, UiState& ui);

    std::function<void()> wake_;
    std::filesystem::path scene_file_;
    Scene imported_; // as it came from the file: what snapshots list the edits against
    GltfOrigin origin_;
    bool written_by_blush_ = false;
    FileWatch watch_;
    std::chrono::steady_clock::time_point next_look_{};

    Purpose purpose_ = Purpose::open;
    std::filesystem::path importing_, environment_, map_file_;
    bool keep_settings_ = false, keep_view_ = false;
    bool keep_edits_ = false; // of a reload
    std::shared_ptr<EarlyScene> early_; // of the import that goes on
    std::optional<Document> preview_;
    Project saving_; // as it was when the save began
    std::unique_ptr<BackgroundJob<Result<Opened>>> import_job_;
    std::unique_ptr<BackgroundJob<Result<SavedGltf>>> save_job_;
    MapView map_; // that the image is for
    std::unique_ptr<BackgroundJob<Result<ImagePtr>>> environment_job_, map_job_;
};

} // namespace blush
