// Snapshots: pictures that were kept with the state that made them, and how two of them, or one and the live image, are looked at together.
#pragma once

#include "render/film_state.h"
#include "render/showcase.h"
#include "scene/edit.h"
#include "ui/picture_layers.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// Small scene-linear picture, 4 values a pixel.
struct Thumbnail {
    static constexpr int width = 160, height = 100; // pixels, borders included
    std::vector<float> rgba;
};
// The picture within the thumbnail's size, as large as it fits.
Thumbnail thumbnail_of(const Frame& frame);

struct Snapshot {
    uint64_t id = 0; // never 0, which is the live image
    std::string name, note, time;
    Pictures pictures;       // of full resolution; the denoised one may be null
    std::vector<Vec3> error; // standard error of each pixel's mean, RGB; may be empty
    FilmStatePtr film;       // what rendering goes on from; null: it begins anew
    Thumbnail thumbnail;
    std::optional<PixelRect> frame; // of the camera, in a picture that goes on beside it: what is kept to be seen

    // The state. Without a scene file there is none to go back to, only the picture.
    Project project;
    RenderSettings settings; // that the picture was rendered with
    Scene imported;          // the scene as its file has it
    std::filesystem::path scene_file;
    std::string no_state; // why; empty: there is one

    std::filesystem::path file; // that it is saved in; empty: none
    bool film_in_file = false;  // its samples too

    std::shared_ptr<PictureLayers> layers; // of a picture that another program made, which has neither state nor samples nor a file of ours; null

    // In memory (snapshot_memory.h).
    bool pinned = false;                          // stays there
    uint64_t last_used = 0;
    enum class Place { memory, file, lost } place = Place::memory; // of pictures and samples; lost: the file is gone or broken

    // Shows another of its layers; it must have some.
    void choose_layer(size_t index);
    std::string figures() const; // "64 spp, 1.2 %, 14:32"
    // From now on its pictures and samples are those of its file.
    void let_go();

private:
    std::string last_figures_; // while there are no pictures to tell them
};
using SnapshotPtr = std::shared_ptr<Snapshot>;

constexpr uint64_t live_image = 0; // in place of a snapshot's id

enum class DifferenceKind { absolute, relative, flip };

struct Comparison {
    enum class Mode { off, wipe, flicker, difference };
    Mode mode = Mode::off;
    uint64_t a = live_image, b = live_image; // the same: not chosen yet
    float wipe = 0.5f;                       // share of the picture that shows A, from the left
    bool shows_b = false;                    // flicker
    DifferenceKind kind = DifferenceKind::absolute;
};

// What the editor does with one of them after the panels are drawn.
struct SnapshotRequest {
    enum class What { restore, save, renamed };
    What what = What::restore;
    uint64_t id = 0;
};

struct SnapshotsView {
    std::vector<SnapshotPtr> list; // oldest first
    bool open = true;              // the strip; without snapshots there is none
    uint64_t details = 0;          // whose panel is open
    Comparison compare;
    std::vector<SnapshotRequest> requests;

    SnapshotPtr find(uint64_t id) const;
    // It is one of the two that are compared.
    bool compares(uint64_t id) const { return compare.mode != Comparison::Mode::off && (compare.a == id || compare.b == id); }
    // Of all, it is the one used last.
    void use(Snapshot& snapshot) { snapshot.last_used = ++last_use_; }
    // Its id.
    uint64_t add(Snapshot snapshot);
    // Comparisons with it end. The one removed last can be put back.
    void remove(uint64_t id);
    void put_back();
    bool can_put_back() const { return removed_ != nullptr; }
    // Switches a way of comparing on, or off if it was; nothing chosen, the newest is compared with the live image. False: there is nothing
    // to compare.
    bool toggle(Comparison::Mode mode);
    // Says which is A or B; B is the live image then, if it was not chosen.
    void choose(uint64_t& side, uint64_t id);

private:
    uint64_t last_id_ = 0, last_use_ = 0;
    SnapshotPtr removed_;
};

} // namespace blush
