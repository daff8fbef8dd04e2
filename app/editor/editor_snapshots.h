// Snapshots of the editor: takes them, writes and opens their files, restores their states.
#pragma once

#include "app/commands/opened_snapshot.h"
#include "app/editor/editor_snapshot.h"
#include "app/files/editor_files.h"
#include "app/files/snapshot_store.h"
#include "render/session/render_session.h"
#include "ui/jobs/background_job.h"
#include "ui/panels/panels.h"

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>

namespace blush {

// False if the displayed image is that of the film, `wanted`, with as many samples.
bool worth_restoring(const FilmState& film, const SubmissionPtr& submitted, const SubmissionContent& wanted, const Images& shown);

class EditorSnapshots {
public:
    // `before_leaving`: runs its argument when no unsaved edits would be lost; never if the user cancels.
    // `assets`: the folder of shipped scenes, to which nothing is written.
    EditorSnapshots(std::function<void()> wake, std::filesystem::path assets, std::function<void(std::function<void()>)> before_leaving)
        : wake_(wake), assets_(std::move(assets)), before_leaving_(std::move(before_leaving)), store_(std::move(wake)) {}

    // Everything that defines the displayed image; requires a frame in full resolution.
    struct Shown {
        uint64_t revision = 0;
        Images images;
        DenoiseView view;
        Project project;
        RenderSettings settings;
        Scene imported;
        std::filesystem::path scene_file;
        std::optional<PixelRect> frame = {}; // the camera's frame, if the image extends beyond it
    };
    // Adds it to the strip when the session has returned the samples, and saves it if the settings say so.
    void keep(Shown shown, RenderSession& session);
    // Saves it as a PNG.
    void save_png(const Shown& shown, const ColorManagement& color, const UiState& ui);
    // Reads the files that were in the strip when the scene was last closed, one after the other; unreadable ones are skipped.
    void load_strip(const UiState& ui, const std::filesystem::path& scene_file);
    // Opens an EXR. A snapshot is added to the strip and its state is restored. An image from another program is added to the
    // strip with its layers and shown in the comparison. `panoramas_light`: a panorama becomes the environment instead.
    void open(const std::filesystem::path& file, const std::filesystem::path& open_scene, bool panoramas_light);
    // Adds a merged image of a plan to the strip, or replaces an older state of it there. One that the user has removed from the strip
    // does not come back.
    void show_merged(const std::filesystem::path& file);
    // Executes requests of panels.
    void handle_requests(Document& document, UiState& ui, EditorFiles& files);

    // Applies finished jobs. `opened`: the scene file has just been read.
    void poll(bool opened, Document& document, UiState& ui, EditorFiles& files, RenderSession& session);
    // Samples to resume from after a Restore, once; `size` is their resolution.
    struct Restored {
        FilmStatePtr film;
        RenderSettings settings;
    };
    std::optional<Restored> take_restored() { return std::exchange(restored_, std::nullopt); }

    std::optional<RunningJob> running() const;
    // Writes all pending files.
    void finish_all();

private:
    // Either a snapshot or an image from another program; not an environment.
    struct OpenAnswer {
        std::optional<OpenedSnapshot> snapshot = {};
        std::shared_ptr<ImageLayers> image = {};
    };
    void show_image(std::shared_ptr<ImageLayers> layers, UiState& ui);
    void finish_capture(UiState& ui, RenderSession& session);
    void finish_opening(Document& document, UiState& ui, EditorFiles& files);
    void finish_state(Document& document, UiState& ui);
    void finish_writing(UiState& ui);
    enum class Why { asked, renamed, room };
    void write(const SnapshotPtr& snapshot, const UiState& ui, Why why);
    bool will_be_written(uint64_t id) const;
    void free_memory(UiState& ui);
    void read_next(const std::filesystem::path& open_scene);
    void add_merged(OpenedSnapshot opened, UiState& ui);
    SnapshotPtr add_to_strip(OpenedSnapshot opened, UiState& ui);
    void restore(const SnapshotPtr& snapshot, Document& document, UiState& ui, EditorFiles& files);
    void continue_restore(Document& document, UiState& ui, const EditorFiles& files);
    void compute_state(const EditorFiles& files);
    void go_back(const Snapshot& snapshot, Document& document, UiState& ui);

    std::function<void()> wake_;
    std::filesystem::path assets_;
    std::function<void(std::function<void()>)> before_leaving_;
    SnapshotStore store_;
    std::optional<Shown> keeping_;
    std::optional<Restored> restored_;

    std::filesystem::path opening_file_;
    std::unique_ptr<BackgroundJob<Result<OpenAnswer>>> opening_;
    bool restores_opened_ = false, opens_merged_ = false;
    std::set<std::filesystem::path> merged_; // those that were in the strip
    struct ToRead {
        std::filesystem::path file;
        bool to_restore = false; // otherwise only add it to the strip
        bool panoramas_light = false;
        bool merged = false; // of a plan: replaces an older state of this file
    };
    std::deque<ToRead> to_read_;
    // Snapshots whose state is not computed yet.
    std::map<uint64_t, SnapshotMetadata> stateless_;
    SnapshotPtr waiting_; // its scene is being read, or its state computed
    std::unique_ptr<BackgroundJob<Result<SnapshotState>>> state_job_;

    struct Writing {
        uint64_t id = 0; // 0: a PNG
        bool film = false;
        std::function<Result<SavedSnapshot>()> write;
    };
    std::deque<Writing> to_write_;
    uint64_t writing_id_ = 0;
    bool writing_film_ = false;
    std::unique_ptr<BackgroundJob<Result<SavedSnapshot>>> writing_;
};

} // namespace blush
