// Memory use of snapshots, and which of them are unloaded above the limit. Pure.
#pragma once

#include "ui/snapshots/snapshots_view.h"

#include <cstddef>
#include <vector>

namespace blush {

// Bytes of its images, planes and samples; without payloads shared with the scene.
size_t bytes_of(const Snapshot& snapshot);
size_t bytes_of(const std::vector<SnapshotPtr>& list);

// The snapshots to unload so that the rest uses at most `limit` bytes: least recently used first; never pinned, compared or the
// most recently used ones.
std::vector<SnapshotPtr> snapshots_to_unload(const SnapshotsView& view, size_t limit);

} // namespace blush
