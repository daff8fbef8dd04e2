#include "app/commands/plan/task_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace blush {
namespace {

std::filesystem::path log_file(const std::filesystem::path& folder, size_t number) {
    return folder / "logs" / fmt::format("{:06}.log", number);
}

std::string host_name() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown machine";
}

// The last line of a text file that is not empty, at most a few hundred bytes of it.
std::string last_line_of(int file) {
    std::array<char, 512> end{};
    const off_t size = lseek(file, 0, SEEK_END);
    const off_t from = std::max<off_t>(0, size - off_t(end.size()));
    const ssize_t count = pread(file, end.data(), end.size(), from);
    std::string text(end.data(), size_t(std::max<ssize_t>(count, 0)));
    while (!text.empty() && text.back() == '\n') text.pop_back();
    if (const size_t line_end = text.rfind('\n'); line_end != text.npos) text.erase(0, line_end + 1);
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    return text;
}

} // namespace

TaskLog::TaskLog(const std::filesystem::path& folder, size_t number) {
    file_ = open(log_file(folder, number).c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0) return;
    // Shared: a second worker on this task may come at any time. Waits only for a reader that just looks.
    (void)flock(file_, LOCK_SH);
    line(fmt::format("begun on {}, process {}", host_name(), getpid()));
}

TaskLog::~TaskLog() {
    if (file_ >= 0) close(file_);
}

void TaskLog::line(const std::string& text) {
    const std::string whole = text + "\n";
    if (file_ >= 0) (void)!write(file_, whole.data(), whole.size()); // one call: lines of two workers do not mix
}

TaskState task_state(const std::filesystem::path& folder, size_t number) {
    TaskState state;
    const int file = open(log_file(folder, number).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) return state;
    state.begun = true;
    state.running = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    state.last_line = last_line_of(file);
    close(file); // and with it the lock
    return state;
}

} // namespace blush
