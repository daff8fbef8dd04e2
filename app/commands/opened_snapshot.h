// Loads a snapshot from its file: the image first, the state when its scene is loaded. The file is untrusted.
#pragma once

#include "core/result.h"
#include "io/image/snapshot.h"
#include "ui/snapshots/snapshots_view.h"

#include <filesystem>
#include <string>

namespace blush {

struct OpenedSnapshot {
    Snapshot snapshot;         // without project, imported scene and thumbnail
    SnapshotMetadata metadata; // from which these are made
};
// Reads images, samples, name and note. snapshot.scene_file is the scene's path, if the file exists there or beside the
// image; else `open_scene`, the open file, if it has the same name. Errors: unreadable, not written by Blush, damaged image
// data. Invalid samples are dropped: snapshot.film is null.
Result<OpenedSnapshot> open_snapshot(const std::filesystem::path& file, const std::filesystem::path& open_scene);

// The state of an image, as far as the scene file is unchanged.
struct SnapshotState {
    Project project;
    std::string warning; // differences from the saved state, as a sentence; empty: none
};
// `imported`: the scene in its current file. Errors: the edits do not fit it.
Result<SnapshotState> state_of(const SnapshotMetadata& metadata, const Scene& imported, const std::filesystem::path& scene_file);

} // namespace blush
