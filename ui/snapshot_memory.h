// What kept snapshots cost in memory, and which of them go when that is too much. Pure.
#pragma once

#include "ui/snapshots_view.h"

#include <cstddef>
#include <vector>

namespace blush {

// Bytes of its pictures, planes and samples; payloads that the scene shares with others are not counted.
size_t bytes_of(const Snapshot& snapshot);
size_t bytes_of(const std::vector<SnapshotPtr>& list);

// Those that have to let go of their pictures so that the rest takes no more than `limit` bytes: the ones whose use is longest ago, but none
// that is pinned or compared, and never the last one used.
std::vector<SnapshotPtr> beyond_memory(const SnapshotsView& view, size_t limit);

} // namespace blush
