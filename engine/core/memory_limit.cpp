#include "core/memory_limit.h"

#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace blush {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view address_space = "by ulimit -v";

std::optional<uint64_t> number_in(const fs::path& file) {
    std::ifstream in(file);
    std::string text;
    uint64_t value = 0;
    if (!(in >> text) || !parse_number(text, value)) return {}; // "max" is no limit
    return value;
}

// Value of a key in lines "KEY VALUE" or "KEY: VALUE kB".
std::optional<uint64_t> value_of(const fs::path& file, std::string_view key) {
    std::ifstream in(file);
    std::string word;
    while (in >> word)
        if (word == key) {
            uint64_t value = 0;
            if (in >> value) return value;
            return {};
        }
    return {};
}

void tighten(MemoryLimit& room, uint64_t limit, uint64_t used, std::string_view limit_of) {
    room.left = std::min(room.left, limit - std::min(used, limit));
    if (limit >= room.limit) return;
    room.limit = limit;
    room.limit_of = limit_of;
}

struct GroupFiles {
    const char *limit, *used, *cache;
};
constexpr GroupFiles group_v1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles group_v2{"memory.max", "memory.current", "inactive_file"};

// A group and its ancestors. In a container the path of the group may be missing, but its root exists.
void tighten_by_groups(MemoryLimit& room, const fs::path& mount, const fs::path& group, const GroupFiles& files) {
    for (fs::path at = group.relative_path();; at = at.parent_path()) {
        const fs::path folder = mount / at;
        const auto limit = number_in(folder / files.limit), used = number_in(folder / files.used);
        const uint64_t cache = value_of(folder / "memory.stat", files.cache).value_or(0);
        if (limit && used) tighten(room, *limit, *used - std::min(cache, *used), "of its control group");
        if (at.empty()) return;
    }
}

// Lines "0::/path" of cgroup v2 and "N:memory:/path" of v1.
void tighten_by_groups(MemoryLimit& room, const fs::path& root) {
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        const size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == line.npos || second == line.npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const fs::path group = line.substr(second + 1);
        if (controllers == ",,")
            tighten_by_groups(room, root / "sys/fs/cgroup", group, group_v2);
        else if (controllers.find(",memory,") != controllers.npos)
            tighten_by_groups(room, root / "sys/fs/cgroup/memory", group, group_v1);
    }
}

} // namespace

bool MemoryLimit::is_of_address_space() const { return limit_of == address_space; }

std::string MemoryLimit::text() const {
    return fmt::format("{:.2g} GB are left, the limit is {:.2g} GB {}", double(left) / 1e9, double(limit) / 1e9, limit_of);
}

MemoryLimit memory_limit(const fs::path& root) {
    constexpr uint64_t unknown = std::numeric_limits<uint64_t>::max();
    MemoryLimit room{unknown, "of this machine", unknown};
    const fs::path memory = root / "proc/meminfo";
    if (const auto total = value_of(memory, "MemTotal:"))
        tighten(room, *total << 10, (*total - std::min(*total, value_of(memory, "MemAvailable:").value_or(*total))) << 10,
                "of this machine");
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        tighten(room, limit.rlim_cur, number_in(root / "proc/self/statm").value_or(0) * uint64_t(sysconf(_SC_PAGE_SIZE)), address_space);
    tighten_by_groups(room, root);
    return room;
}

} // namespace blush
