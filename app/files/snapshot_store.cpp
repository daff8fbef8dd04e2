#include "app/files/snapshot_store.h"

#include "app/common/catch_as_result.h"
#include "ui/snapshots/snapshot_memory.h"

#include <utility>

namespace blush {

bool SnapshotStore::has(const SnapshotPtr& snapshot) {
    if (snapshot->place != Snapshot::Place::file) return true;
    if (reading_) return false;
    read_for_ = snapshot;
    reading_ = std::make_unique<BackgroundJob<Result<OpenedSnapshot>>>(
        "Reading " + snapshot->file.filename().string(),
        [file = snapshot->file, scene = snapshot->scene_file](JobProgress&) {
            return catch_as_result<OpenedSnapshot>([&] { return open_snapshot(file, scene); });
        },
        wake_);
    return false;
}

void SnapshotStore::poll(UiState& ui) {
    if (!reading_) return;
    auto result = reading_->take();
    if (!result) return;
    reading_.reset();
    Snapshot& s = *std::exchange(read_for_, nullptr);
    if (!*result) {
        s.place = Snapshot::Place::lost;
        return ui.toasts.warn(s.name + " cannot be read and is rendered from the start", result->error().text());
    }
    Snapshot& read = (**result).snapshot;
    s.images = std::move(read.images);
    s.error = std::move(read.error);
    s.film = std::move(read.film);
    s.place = Snapshot::Place::memory;
    ui.snapshots.use(s);
}

std::vector<SnapshotPtr> SnapshotStore::free_memory(UiState& ui) {
    std::vector<SnapshotPtr> unwritten;
    for (const SnapshotPtr& s : snapshots_to_unload(ui.snapshots, size_t(ui.settings.snapshot_memory) << 20)) {
        if (s->file.empty())
            unwritten.push_back(s);
        else if (!s->film || s->film_in_file)
            s->unload();
        else
            s->film = nullptr;
    }
    return unwritten;
}

} // namespace blush
