#include "core/files.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace blush {
namespace {

// A file descriptor that closes itself.
struct Descriptor {
    int fd = -1;
    explicit Descriptor(int value) : fd(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
    // Some file systems report a full disk only here.
    bool close() { return ::close(std::exchange(fd, -1)) == 0; }
};

Error system_error(const std::filesystem::path& file, const char* doing) {
    return {file.string(), fmt::format("cannot {}: {}", doing, std::strerror(errno)), ""};
}

// Beside the target, so that the rename stays within one file system; unique in this process and among processes.
std::filesystem::path temporary_beside(const std::filesystem::path& file) {
    static std::atomic<unsigned> counter = 0;
    return file.parent_path() / fmt::format(".{}.{}-{}.tmp", file.filename().string(), ::getpid(), counter++);
}

bool write_all(int fd, std::span<const uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes = bytes.subspan(size_t(written));
    }
    return true;
}

} // namespace

Result<std::vector<uint8_t>> read_file(const std::filesystem::path& file, uint64_t max_bytes) {
    // Non-blocking: opening a pipe that nobody writes to must not wait for ever.
    Descriptor source(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (source.fd < 0 || ::fstat(source.fd, &status) != 0) return system_error(file, "read");
    if (!S_ISREG(status.st_mode)) return Error{file.string(), "cannot read: not a regular file", ""};
    if (uint64_t(status.st_size) > max_bytes)
        return Error{file.string(), fmt::format("larger than {} MB", max_bytes >> 20), fmt::format("{} bytes", status.st_size)};
    std::vector<uint8_t> bytes(size_t(status.st_size));
    size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t count = ::read(source.fd, bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return system_error(file, "read");
        if (count == 0) break; // shrank while we read: what follows sees a truncated file
        filled += size_t(count);
    }
    bytes.resize(filled);
    return bytes;
}

Result<void> write_file(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
    struct stat status {};
    if (::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return Error{file.string(), "cannot write: not a regular file", ""};
    const std::filesystem::path temporary = temporary_beside(file);
    Descriptor sink(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (sink.fd < 0) return system_error(file, "write");
    if (write_all(sink.fd, bytes) && ::fsync(sink.fd) == 0 && sink.close() && ::rename(temporary.c_str(), file.c_str()) == 0) return {};
    const Error error = system_error(file, "write");
    ::unlink(temporary.c_str());
    return error;
}

Result<void> write_file(const std::filesystem::path& file, std::string_view text) {
    return write_file(file, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

std::filesystem::path user_folder(const char* variable, const char* below_home) {
    const auto folder = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value ? value : "");
    };
    if (const auto named = folder(variable); named.is_absolute()) return named;
    if (const auto home = folder("HOME"); !home.empty()) return home / below_home;
    return {};
}

} // namespace blush
