#include "app/farm/plan_activity.h"

#include "app/common/run_program.h"
#include "core/files.h"

#include <cerrno>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

namespace blush {
namespace {

std::string last_line(const std::filesystem::path& file) {
    constexpr uint64_t max_bytes = 1 << 20;
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_bytes);
    if (!bytes) return {};
    std::string text(bytes->begin(), bytes->end());
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const size_t line = text.rfind('\n');
    return line == text.npos ? text : text.substr(line + 1);
}

} // namespace

// run-local.sh and its tasks hold this lock.
bool runs_here(const std::filesystem::path& folder) {
    const int file = open((folder / "local.lock").c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool locked = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(file);
    return locked;
}

bool runs_in_slurm(const std::filesystem::path& folder) {
    std::error_code code;
    return std::filesystem::exists(folder / "slurm", code) &&
           run_program({"/bin/sh", "-c", "squeue --noheader --format=%Z 2>/dev/null | grep -qxF -- \"$1\"", "sh", folder.string()}) == 0;
}

std::string last_words(const std::filesystem::path& log) {
    const std::string line = last_line(log);
    for (const char* speaker : {"blush: error: ", "run-local.sh: ", "sbatch: error: ", "submit-slurm.sh: "})
        if (line.starts_with(speaker)) return line.substr(std::string_view(speaker).size());
    return {};
}

} // namespace blush
