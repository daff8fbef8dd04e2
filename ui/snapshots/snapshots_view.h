// Snapshots: saved images with the state that made them, and the comparison of two of them, or of one with the live image.
#pragma once

#include "render/film/film_state.h"
#include "render/session/published_frames.h"
#include "scene/document/edit.h"
#include "ui/snapshots/image_layers.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// Small scene-linear image, 4 values per pixel.
struct Thumbnail {
    static constexpr int width = 160, height = 100; // pixels, including borders
    std::vector<float> rgba;
};
// The image scaled to fit into the thumbnail.
Thumbnail thumbnail_of(const Frame& frame);

struct Snapshot {
    uint64_t id = 0; // never 0, which is the live image
    std::string name, note, time;
    Images images;           // full resolution; the denoised one may be null
    std::vector<Vec3> error; // standard error of each pixel, RGB; may be empty
    FilmStatePtr film;       // samples to resume rendering from; null: rendering restarts
    Thumbnail thumbnail;
    std::optional<PixelRect> frame; // the camera's frame, if the image extends beyond it; the rest is not saved

    // The state. Without a scene file there is no state, only the image.
    Project project;
    RenderSettings settings; // settings of the render
    Scene imported;          // the scene as in its file
    std::filesystem::path scene_file;
    std::string no_state; // why there is no state; empty: there is one

    std::filesystem::path file; // file that it is saved in; empty: none
    bool film_in_file = false;  // the file also has its samples

    std::shared_ptr<ImageLayers> layers; // image from another program; such a snapshot has no state, samples or own file; else null

    // Memory management (snapshot_memory.h).
    bool pinned = false; // never unloaded
    uint64_t last_used = 0;
    enum class Place { memory, file, lost } place = Place::memory; // of images and samples; lost: the file is missing or invalid

    // Shows another layer; requires `layers`.
    void choose_layer(size_t index);
    std::string figures() const; // "64 spp, 1.2 %, 14:32"
    // Replaces images and samples by those of its file.
    void unload();

private:
    std::string last_figures_; // used while the images are unloaded
};
using SnapshotPtr = std::shared_ptr<Snapshot>;

constexpr uint64_t live_image = 0; // used in place of a snapshot's id

enum class DifferenceKind { absolute, relative, flip };

struct Comparison {
    enum class Mode { off, wipe, flicker, difference };
    Mode mode = Mode::off;
    uint64_t a = live_image, b = live_image; // equal: nothing chosen yet
    float wipe = 0.5f;                       // fraction of the image that shows A, from the left
    bool shows_b = false;                    // flicker: B is shown
    DifferenceKind kind = DifferenceKind::absolute;
};

// Requests that the editor executes after the panels are drawn.
struct SnapshotRequest {
    enum class What { restore, save, renamed };
    What what = What::restore;
    uint64_t id = 0;
};

struct SnapshotsView {
    std::vector<SnapshotPtr> list; // oldest first
    bool open = true;              // the strip is open; without snapshots it is hidden
    uint64_t details = 0;          // id of the snapshot whose panel is open
    Comparison compare;
    std::vector<SnapshotRequest> requests;

    SnapshotPtr find(uint64_t id) const;
    // True if it is one of the two compared snapshots.
    bool compares(uint64_t id) const { return compare.mode != Comparison::Mode::off && (compare.a == id || compare.b == id); }
    // Marks it as the most recently used.
    void use(Snapshot& snapshot) { snapshot.last_used = ++last_use_; }
    // Adds it and returns its id.
    uint64_t add(Snapshot snapshot);
    // Removes it; ends a comparison with it. The last removed one can be restored.
    void remove(uint64_t id);
    // The newer snapshot takes the place of the older one, which is dropped; comparison and panel follow.
    void replace(uint64_t older, uint64_t newer);
    void put_back();
    bool can_put_back() const { return removed_ != nullptr; }
    // Toggles a comparison mode; if nothing is chosen, the newest snapshot is compared with the live image. False: there is
    // nothing to compare.
    bool toggle(Comparison::Mode mode);
    // Sets A or B; if B was not chosen, it becomes the live image.
    void choose(uint64_t& side, uint64_t id);

private:
    uint64_t last_id_ = 0, last_use_ = 0;
    SnapshotPtr removed_;
};

} // namespace blush
