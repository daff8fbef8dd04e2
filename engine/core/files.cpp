#include "core/files.h"

#include "core/text.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace blush {
namespace {

// RAII file descriptor.
struct Descriptor {
    int fd = -1;
    explicit Descriptor(int value) : fd(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
    // Some file systems report a full disk only on close.
    bool close() { return ::close(std::exchange(fd, -1)) == 0; }
};

Error system_error(const std::filesystem::path& file, const char* doing) {
    return {file.string(), fmt::format("cannot {}: {}", doing, std::strerror(errno)), ""};
}

// In the target's folder, so that the rename stays within one file system; unique within and across processes.
std::filesystem::path temporary_beside(const std::filesystem::path& file) {
    static std::atomic<unsigned> counter = 0;
    return file.parent_path() / fmt::format(".{}.{}-{}.tmp", file.filename().string(), ::getpid(), counter++);
}

// Resolves symbolic links; the target need not exist. Returns one of the links for a cycle.
std::filesystem::path behind_links(std::filesystem::path file) {
    constexpr int max_links = 40; // same limit as the kernel
    std::error_code code;
    for (int i = 0; i < max_links && std::filesystem::is_symlink(file, code); ++i) {
        const std::filesystem::path target = std::filesystem::read_symlink(file, code);
        if (code) return file;
        file = target.is_absolute() ? target : file.parent_path() / target;
    }
    return file;
}

bool is_running(pid_t pid) { return ::kill(pid, 0) == 0 || errno != ESRCH; }

// Process id in the name ".NAME.PID-NUMBER.tmp" of a temporary file of write_file(); 0 for other files.
pid_t writer_of(const std::string& name, const std::string& target) {
    const std::string begin = "." + target + ".", end = ".tmp";
    if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end)) return 0;
    const std::vector<std::string_view> parts =
        split(std::string_view(name).substr(begin.size(), name.size() - begin.size() - end.size()), '-');
    pid_t pid = 0;
    unsigned number = 0;
    return parts.size() == 2 && parse_number(parts[0], pid) && parse_number(parts[1], number) && pid > 0 ? pid : 0;
}

// Removes temporary files of earlier writes whose process was killed.
void sweep_temporaries(const std::filesystem::path& file) {
    std::error_code code;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    const std::string target = file.filename().string();
    for (std::filesystem::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        const pid_t pid = writer_of(at->path().filename().string(), target);
        std::error_code ignored;
        if (pid == 0 || pid == ::getpid() || is_running(pid) || !at->is_regular_file(ignored)) continue;
        std::filesystem::remove(at->path(), ignored);
    }
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
    // Non-blocking: opening a pipe without a writer would block.
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
        if (count == 0) break; // the file shrank during the read: treated as truncated
        filled += size_t(count);
    }
    bytes.resize(filled);
    return bytes;
}

Result<void> write_file(const std::filesystem::path& name, std::span<const uint8_t> bytes) {
    const std::filesystem::path file = behind_links(name);
    if (std::error_code code; std::filesystem::is_symlink(file, code)) {
        errno = ELOOP;
        return system_error(name, "write");
    }
    struct stat status {};
    if (::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return Error{file.string(), "cannot write: not a regular file", ""};
    sweep_temporaries(file);
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

std::filesystem::path named_user_folder(const std::string& variable, const char* below_home) {
    const char* const given = std::getenv(variable.c_str());
    if (given && std::filesystem::path(given).is_absolute()) return given;
    // A shell file of lines such as XDG_DESKTOP_DIR="$HOME/Desktop"; the value is relative to $HOME or absolute.
    std::ifstream dirs(user_folder("XDG_CONFIG_HOME", ".config") / "user-dirs.dirs");
    const std::string begin = variable + "=\"", home = "$HOME/";
    for (std::string line; std::getline(dirs, line);) {
        const size_t end = line.rfind('"');
        if (!line.starts_with(begin) || end < begin.size()) continue;
        std::string value;
        for (size_t i = begin.size(); i < end; ++i) {
            if (line[i] == '\\' && i + 1 < end) ++i;
            value += line[i];
        }
        if (value.starts_with(home)) return user_folder("HOME", "") / value.substr(home.size());
        if (std::filesystem::path(value).is_absolute()) return value;
    }
    return user_folder(variable.c_str(), below_home);
}

} // namespace blush
