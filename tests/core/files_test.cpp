#include "core/files.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace blush::test::TEST_FILE {
namespace {

std::string text_of(const std::filesystem::path& file) {
    const auto bytes = read_file(file, 1 << 20);
    return bytes ? std::string(bytes->begin(), bytes->end()) : bytes.error().text();
}

TEST(Files, RoundTrip) {
    const TempFolder folder;
    ASSERT_TRUE(write_file(folder / "a.txt", "one"));
    ASSERT_TRUE(write_file(folder / "a.txt", "two"));
    EXPECT_EQ(text_of(folder / "a.txt"), "two");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(Files, TooLargeMissingOrNotAFile) {
    const TempFolder folder;
    write_bytes(folder / "four", "1234");
    EXPECT_TRUE(read_file(folder / "four", 4));
    EXPECT_FALSE(read_file(folder / "four", 3));
    EXPECT_NE(error_text(read_file(folder / "none", 4)).find("No such file"), std::string::npos);
    EXPECT_NE(error_text(read_file(folder.path(), 4)).find("not a regular file"), std::string::npos);
    EXPECT_NE(error_text(read_file("/dev/zero", 4)).find("not a regular file"), std::string::npos);
}

TEST(Files, FailedWritesNameTheFileAndLeaveNothing) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "target");
    write_bytes(folder / "target/inside", "kept");
    // The last folder is not writable even for root.
    for (const std::filesystem::path& file :
         {folder / "none/a.txt", folder / "target", std::filesystem::path("/dev/null"), std::filesystem::path("/proc/a.txt")}) {
        const auto written = write_file(file, "text");
        ASSERT_FALSE(written) << file;
        EXPECT_EQ(written.error().file, file.string());
        EXPECT_NE(written.error().what.find("cannot write"), std::string::npos);
    }
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(Files, ThroughALinkTheTargetIsWritten) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "deep");
    write_bytes(folder / "deep/target", "old");
    std::filesystem::create_symlink("deep/target", folder / "link");
    std::filesystem::create_symlink(folder / "link", folder / "second");
    for (const char* name : {"link", "second"}) {
        ASSERT_TRUE(write_file(folder / name, name));
        EXPECT_TRUE(std::filesystem::is_symlink(folder / name)) << "it stays a link";
        EXPECT_EQ(text_of(folder / "deep/target"), name);
    }
    std::filesystem::create_symlink("deep/new", folder / "dangling");
    ASSERT_TRUE(write_file(folder / "dangling", "made"));
    EXPECT_EQ(text_of(folder / "deep/new"), "made");
    std::filesystem::create_symlink("loop", folder / "loop");
    EXPECT_FALSE(write_file(folder / "loop", "text"));
}

// The temporary file of a killed process is removed by the next write to the same target; other files are kept.
TEST(Files, TemporaryFilesOfKilledProcessesAreRemoved) {
    const TempFolder folder;
    const pid_t dead = fork();
    if (dead == 0) _exit(0);
    ASSERT_EQ(waitpid(dead, nullptr, 0), dead);
    const std::string stale = "." + std::string("a.exr.") + std::to_string(dead) + "-3.tmp";
    const std::vector<std::string> kept{".a.exr.1-0.tmp", ".a.exr." + std::to_string(getpid()) + "-99999.tmp", ".a.exr.x-1.tmp",
                                        ".a.exr.tmp", ".b.exr." + std::to_string(dead) + "-3.tmp"};
    write_bytes(folder / stale, "part");
    for (const std::string& name : kept) write_bytes(folder / name, "part");
    ASSERT_TRUE(write_file(folder / "a.exr", "whole"));
    EXPECT_FALSE(std::filesystem::exists(folder / stale));
    for (const std::string& name : kept) EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

} // namespace
} // namespace blush::test::TEST_FILE
