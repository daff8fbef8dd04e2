// A snapshot from its file: the picture at once, the state when its scene is there. Any file may be hostile.
#pragma once

#include "core/result.h"
#include "io/snapshot.h"
#include "ui/snapshots_view.h"

#include <filesystem>
#include <string>

namespace blush {

struct OpenedSnapshot {
    Snapshot snapshot;         // without project, imported scene and thumbnail
    SnapshotMetadata metadata; // what they are made of
};
// Pictures, samples, name and note; snapshot.scene_file is where the scene is, if it is where the picture says or beside it.
// `open_scene`: the file that is open, taken if it is called the same and no other is found.
// Errors: unreadable, not one of ours, damaged in what a picture needs. Samples that make no sense are left out: snapshot.film is null.
Result<OpenedSnapshot> open_snapshot(const std::filesystem::path& file, const std::filesystem::path& open_scene);

// What a picture was rendered from, as far as the scene file still is what it was.
struct SnapshotState {
    Project project;
    std::string warning; // what differs from when it was kept, in a sentence; empty: nothing
};
// `imported`: the scene as its file has it now. Errors: the edits do not fit it.
Result<SnapshotState> state_of(const SnapshotMetadata& metadata, const Scene& imported, const std::filesystem::path& scene_file);

} // namespace blush
