// Memory limits from files in the kernel's format.
#include "core/memory_limit.h"
#include "tests/support/process.h"

#include <fstream>
#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

namespace fs = std::filesystem;

class Root {
public:
    Root() {
        write("proc/meminfo", "MemTotal:       16000000 kB\nMemFree: 1 kB\nMemAvailable:    8000000 kB\n");
        write("proc/self/statm", "1000 1 1 1 0 1 0\n");
        write("proc/self/cgroup", "0::/\n");
    }
    void write(const std::string& name, const std::string& text) const {
        const fs::path file = fs::path(folder_ / "root") / name;
        fs::create_directories(file.parent_path());
        std::ofstream(file) << text;
    }
    MemoryLimit room() const { return memory_limit(folder_ / "root"); }

private:
    test::TemporaryFolder folder_;
};

TEST(MemoryLimit, UsesPhysicalMemory) {
    const MemoryLimit room = Root().room();
    EXPECT_EQ(room.limit, 16000000ull << 10);
    EXPECT_EQ(room.left, 8000000ull << 10);
    EXPECT_EQ(room.limit_of, "of this machine");
}

TEST(MemoryLimit, UsesAncestorControlGroups) {
    Root root;
    root.write("proc/self/cgroup", "0::/user/one\n");
    root.write("sys/fs/cgroup/user/one/memory.max", "max\n");
    root.write("sys/fs/cgroup/user/one/memory.current", "1000\n");
    EXPECT_EQ(root.room().limit_of, "of this machine") << "max is no limit";
    root.write("sys/fs/cgroup/user/memory.max", "3000000000\n");
    root.write("sys/fs/cgroup/user/memory.current", "2000000000\n");
    root.write("sys/fs/cgroup/user/memory.stat", "anon 5\ninactive_file 500000000\n");
    const MemoryLimit room = root.room();
    EXPECT_EQ(room.limit, 3000000000u);
    EXPECT_EQ(room.left, 1500000000u) << "page cache counts as free";
    EXPECT_EQ(room.limit_of, "of its control group");
    EXPECT_EQ(room.text(), "1.5 GB are left, the limit is 3 GB of its control group");
}

// In a container the path of the group is that of the host, and its files are at the root of the mount.
TEST(MemoryLimit, UsesControlGroupsV1InAContainer) {
    Root root;
    root.write("proc/self/cgroup", "12:cpuset:/docker/x\n5:cpu,memory:/docker/x\n");
    root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000000\n");
    root.write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1200000000\n");
    const MemoryLimit room = root.room();
    EXPECT_EQ(room.limit, 1000000000u);
    EXPECT_EQ(room.left, 0u);
}

TEST(MemoryLimit, IsKnownHere) {
    const MemoryLimit room = memory_limit();
    EXPECT_GT(room.limit, 1u << 20);
    EXPECT_LE(room.left, room.limit);
}

} // namespace
} // namespace blush::TEST_FILE
