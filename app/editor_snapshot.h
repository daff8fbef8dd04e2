// A snapshot as a file.
#pragma once

#include "color/color_management.h"
#include "core/result.h"
#include "io/snapshot.h"
#include "ui/denoise_view.h"
#include "ui/snapshots_view.h"

#include <filesystem>
#include <optional>

namespace blush {

// Everything that is written; copies are cheap, so it may be written while the user goes on.
struct SnapshotJob {
    Snapshot snapshot;
    DenoiseView view; // how its pictures are looked at
    std::filesystem::path folder;
    std::filesystem::path file = {}; // that is written anew; empty: one of its own in the folder
    std::optional<SnapshotMetadata> metadata = {}; // as its file had them, while the snapshot has no state of its own
    bool half = false, film = true; // of an EXR: colours in 16 bits, samples to go on from
};

struct SavedSnapshot {
    std::filesystem::path file;
    int64_t beyond_half = 0; // values that 16 bits could not hold
};

// Of a picture that goes on beside the camera's frame, the frame alone is the picture: a PNG holds no more, an EXR has it as its display window if
// it holds samples to go on from, which are those of all pixels, and else holds no more either.
//
// The layered EXR of cli.md: the raw beauty always, the denoised picture as a layer beside it, and all that brings the state back. The file
// is named after the scene and numbered so that none is overwritten.
Result<SavedSnapshot> write_snapshot_exr(const SnapshotJob& job);
// The picture as it is looked at, through the display's view, as a PNG.
Result<SavedSnapshot> write_snapshot_png(const SnapshotJob& job, const ColorManagement& color);

} // namespace blush
