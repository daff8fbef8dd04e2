// Memory management of the strip's snapshots: which are in memory, and which only in their files.
#pragma once

#include "app/commands/opened_snapshot.h"
#include "ui/jobs/background_job.h"
#include "ui/window/ui_state.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

class SnapshotStore {
public:
    explicit SnapshotStore(std::function<void()> wake) : wake_(std::move(wake)) {}

    // True if images and samples are in memory, or lost. Otherwise starts reading them from the file.
    bool has(const SnapshotPtr& snapshot);
    // Unloads snapshots above the memory limit that are saved, and returns those that must be saved first. If the user has
    // disabled samples in files, they are dropped with a message.
    std::vector<SnapshotPtr> free_memory(UiState& ui);
    // Applies finished reads.
    void poll(UiState& ui);
    // The file being read; null: none.
    const BackgroundJob<Result<OpenedSnapshot>>* reading() const { return reading_.get(); }

private:
    std::function<void()> wake_;
    SnapshotPtr read_for_;
    std::unique_ptr<BackgroundJob<Result<OpenedSnapshot>>> reading_;
};

} // namespace blush
