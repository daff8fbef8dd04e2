// Snapshots: pictures that were kept with the state that made them, and how two of them, or one and the live image, are looked at together.
#pragma once

#include "render/film_state.h"
#include "render/showcase.h"
#include "scene/edit.h"

#include <cstdint>
#include <filesystem>
#include <memory>
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

    // The state. Without a scene file there is none to go back to, only the picture.
    Project project;
    RenderSettings settings; // that the picture was rendered with
    Scene imported;          // the scene as its file has it
    std::filesystem::path scene_file;
    std::string no_state; // why; empty: there is one

    std::filesystem::path file; // that it is saved in; empty: none
    std::string figures() const; // "64 spp, 1.2 %, 14:32"
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
    enum class What { restore, save };
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
    // Its id.
    uint64_t add(Snapshot snapshot);
    // Comparisons with it end.
    void remove(uint64_t id);
    // Switches a way of comparing on, or off if it was; nothing chosen, the newest is compared with the live image. False: there is nothing
    // to compare.
    bool toggle(Comparison::Mode mode);
    // Says which is A or B; B is the live image then, if it was not chosen.
    void choose(uint64_t& side, uint64_t id);

private:
    uint64_t last_id_ = 0;
};

} // namespace blush
