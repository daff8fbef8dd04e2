// Unsaved edits kept in a file of the user's state folder, for the start after a crash.
#pragma once

#include "core/result.h"
#include "io/gltf_indices.h"
#include "io/sidecar_json.h"
#include "scene/document.h"
#include "ui/background_job.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// $XDG_STATE_HOME/blush/recovery, or the same under ~/.local/state; empty if neither variable is set.
std::filesystem::path recovery_folder();

// What a process that is gone has left.
struct Leftover {
    std::filesystem::path file;
    Sidecar sidecar;
    std::filesystem::file_time_type written;
};
// Newest first. Files of running processes and what cannot be read are passed over.
std::vector<Leftover> find_leftovers(const std::filesystem::path& folder);
// With its lock.
void remove_leftover(const std::filesystem::path& file);

class Autosave {
public:
    using Clock = std::chrono::steady_clock;

    // With an empty folder nothing is kept.
    Autosave(std::filesystem::path folder, std::chrono::duration<double> interval);
    // Leaves the sidecar, for an exception may be what ends the program.
    ~Autosave();
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    // Once per frame: writes the sidecar in the background when there are changes that it lacks and the interval is over, and
    // removes it when there is nothing left to save. `origin.file` is absolute. Returns the error of a write, once.
    std::optional<Error> poll(const Document& document, const Scene& imported, const GltfOrigin& origin);
    // Removes the sidecar: the edits are saved, or not wanted.
    void forget();
    // Takes over what a crash has left, now that its edits are in the document.
    void adopt(const std::filesystem::path& leftover);

private:
    bool claim_lock();

    std::filesystem::path folder_, file_, lock_;
    int lock_fd_ = -1;
    std::chrono::duration<double> interval_;
    Clock::time_point next_{};
    bool changed_ = false; // since the sidecar was written
    uint64_t seen_revision_ = 0;
    std::shared_ptr<const std::string> seen_origin_;
    std::unique_ptr<BackgroundJob<Result<void>>> job_;
};

} // namespace blush
