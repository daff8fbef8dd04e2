// Where the strip's snapshots have their pictures and samples: in memory as far as the user allows, the others in their files.
#pragma once

#include "app/opened_snapshot.h"
#include "ui/background_job.h"
#include "ui/ui_state.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

class SnapshotStore {
public:
    explicit SnapshotStore(std::function<void()> wake) : wake_(std::move(wake)) {}

    // Has its pictures and samples in memory, or never will again. If not, they are being read from its file.
    bool has(const SnapshotPtr& snapshot);
    // Lets those go that are beyond the limit and whole in their files, and returns those that have to be written first. Samples that the user
    // has not wanted in the file go with a word.
    std::vector<SnapshotPtr> make_room(UiState& ui);
    // Takes what has been read.
    void poll(UiState& ui);
    // What is being read; null: nothing.
    const BackgroundJob<Result<OpenedSnapshot>>* reading() const { return reading_.get(); }

private:
    std::function<void()> wake_;
    SnapshotPtr read_for_;
    std::unique_ptr<BackgroundJob<Result<OpenedSnapshot>>> reading_;
};

} // namespace blush
