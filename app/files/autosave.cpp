#include "app/files/autosave.h"

#include "core/files.h"
#include "io/project/scene_edits_json.h"

#include <algorithm>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace blush {
namespace {

constexpr uint64_t max_bytes = uint64_t(1) << 28;

std::filesystem::path lock_of(std::filesystem::path file) { return file.replace_extension(".lock"); }

// A lock is released when its process ends, in any way.
bool is_locked(const std::filesystem::path& lock) {
    const int fd = ::open(lock.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0) return false;
    const bool locked = ::flock(fd, LOCK_EX | LOCK_NB) != 0;
    ::close(fd);
    return locked;
}

} // namespace

std::filesystem::path recovery_folder() {
    const auto folder = user_folder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? folder : folder / "blush" / "recovery";
}

std::vector<RecoveryFile> find_recovery_files(const std::filesystem::path& folder) {
    std::vector<RecoveryFile> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.path().extension() != ".json" || is_locked(lock_of(entry.path()))) continue;
        const auto text = read_file(entry.path(), max_bytes);
        if (!text) continue;
        Result<Sidecar> sidecar = parse_sidecar({reinterpret_cast<const char*>(text->data()), text->size()});
        if (sidecar) found.push_back({entry.path(), *std::move(sidecar), entry.last_write_time(error)});
    }
    std::ranges::sort(found, std::ranges::greater{}, &RecoveryFile::written);
    return found;
}

void remove_recovery_file(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    std::filesystem::remove(lock_of(file), ignored);
}

Autosave::Autosave(std::filesystem::path folder, std::chrono::duration<double> interval)
    : folder_(std::move(folder)), interval_(interval) {}

Autosave::~Autosave() {
    job_.reset();
    if (lock_fd_ >= 0) ::close(lock_fd_);
}

bool Autosave::claim_lock() {
    if (lock_fd_ >= 0) return true;
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    // The first name that no other process has locked; sidecars of a crash are not reused, because their edits may still be
    // needed.
    for (int number = 1; number < 1000; ++number) {
        file_ = folder_ / fmt::format("{}-{}.json", ::getpid(), number);
        if (std::filesystem::exists(file_, error)) continue;
        const int fd = ::open(lock_of(file_).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
        if (fd < 0) return false;
        if (::flock(fd, LOCK_EX | LOCK_NB) == 0) {
            lock_fd_ = fd;
            return true;
        }
        ::close(fd);
    }
    return false;
}

std::optional<Error> Autosave::poll(const Document& document, const Scene& imported, const GltfOrigin& origin) {
    if (folder_.empty() || !origin.json) return std::nullopt;
    std::optional<Error> failure;
    if (job_) {
        const auto result = job_->take();
        if (!result) return std::nullopt;
        job_.reset();
        if (!*result) failure = result->error();
    }
    // After an edit or a save, the sidecar is outdated.
    if (document.revision() != seen_revision_ || origin.json != seen_origin_) {
        seen_revision_ = document.revision();
        seen_origin_ = origin.json;
        if (!document.modified()) {
            forget();
            changed_ = false;
        } else if (!std::exchange(changed_, true)) {
            next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(interval_);
        }
    }
    if (!changed_ || Clock::now() < next_) return failure;
    if (!claim_lock()) return Error{folder_.string(), "cannot autosave: no lock file in the recovery folder", ""};
    changed_ = false;
    job_ = std::make_unique<BackgroundJob<Result<void>>>(
        "Autosaving",
        [file = file_, project = document.project(), imported, origin](JobProgress&) -> Result<void> {
            return write_file(file, sidecar_json(sidecar_of(origin.file, *origin.json, imported, project)));
        },
        [] {});
    return failure;
}

void Autosave::adopt(const std::filesystem::path& leftover) {
    forget();
    const int fd = ::open(lock_of(leftover).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (fd < 0) return; // keep it, to be offered again
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
        ::close(fd);
        return;
    }
    lock_fd_ = fd;
    file_ = leftover;
}

void Autosave::forget() {
    if (lock_fd_ < 0) return;
    job_.reset(); // cancel first: the job must not write the file again
    remove_recovery_file(file_);
    ::close(std::exchange(lock_fd_, -1));
    changed_ = false;
}

} // namespace blush
