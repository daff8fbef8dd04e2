// Writes a snapshot to a file.
#pragma once

#include "color/color_management.h"
#include "core/result.h"
#include "io/image/snapshot.h"
#include "ui/snapshots/snapshots_view.h"
#include "ui/views/denoise_view.h"

#include <filesystem>
#include <optional>

namespace blush {

// All data to write; cheap to copy, so it can be written while the user continues.
struct SnapshotJob {
    Snapshot snapshot;
    DenoiseView view; // its view mode
    std::filesystem::path folder;
    std::filesystem::path file = {};               // to overwrite; empty: a new file in the folder
    std::optional<SnapshotMetadata> metadata = {}; // from its file, for a snapshot without state
    bool half = false, film = true;                // EXR: colours in 16 bits; samples to resume rendering
};

struct SavedSnapshot {
    std::filesystem::path file;
    int64_t count_beyond_half = 0; // number of values outside the range of 16 bits
};

// If the image extends beyond the camera's frame, only the frame is saved. An EXR with samples contains all pixels, because the
// samples need them, and has the frame as its display window.
//
// The layered EXR of docs/reference/exr.md: always the raw beauty, the denoised image as a layer, and the state for Restore.
// The file name is the scene's plus a number, so that no file is overwritten.
Result<SavedSnapshot> write_snapshot_exr(const SnapshotJob& job);
// The displayed image, after the view transform, as a PNG.
Result<SavedSnapshot> write_snapshot_png(const SnapshotJob& job, const ColorManagement& color);

} // namespace blush
