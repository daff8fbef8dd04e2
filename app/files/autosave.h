// Autosave: unsaved edits in a sidecar file of the user's state folder, for recovery after a crash.
#pragma once

#include "core/result.h"
#include "io/gltf/read/geometry/indices.h"
#include "io/project/sidecar_json.h"
#include "scene/document/document.h"
#include "ui/jobs/background_job.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// $XDG_STATE_HOME/blush/recovery, or ~/.local/state/blush/recovery; empty if neither variable is set.
std::filesystem::path recovery_folder();

// A sidecar left by a process that has ended.
struct RecoveryFile {
    std::filesystem::path file;
    Sidecar sidecar;
    std::filesystem::file_time_type written;
};
// Newest first. Skips files of running processes and unreadable files.
std::vector<RecoveryFile> find_recovery_files(const std::filesystem::path& folder);
// Removes the sidecar and its lock file.
void remove_recovery_file(const std::filesystem::path& file);

class Autosave {
public:
    using Clock = std::chrono::steady_clock;

    // With an empty folder, autosave is off.
    Autosave(std::filesystem::path folder, std::chrono::duration<double> interval);
    // Keeps the sidecar, because an exception may be ending the program.
    ~Autosave();
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    // Call once per frame: writes the sidecar in the background if it is outdated and the interval has passed; removes it if
    // there are no unsaved edits. `origin.file` is absolute. Returns the error of a write, once.
    std::optional<Error> poll(const Document& document, const Scene& imported, const GltfOrigin& origin);
    // Removes the sidecar: the edits were saved or discarded.
    void forget();
    // Adopts the sidecar of a crash, after its edits were loaded into the document.
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
