#include "core/files.h"
#include "io_gltf_builder.h"

#include <gtest/gtest.h>

namespace blush::test {
namespace {

std::string text_of(const std::filesystem::path& file) {
    const auto bytes = read_file(file, 1 << 20);
    return bytes ? std::string(bytes->begin(), bytes->end()) : bytes.error().text();
}

TEST(Files, WhatIsWrittenIsRead) {
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
    // The last is in a folder in which not even root may write.
    for (const std::filesystem::path& file :
         {folder / "none/a.txt", folder / "target", std::filesystem::path("/dev/null"), std::filesystem::path("/proc/a.txt")}) {
        const auto written = write_file(file, "text");
        ASSERT_FALSE(written) << file;
        EXPECT_EQ(written.error().file, file.string());
        EXPECT_NE(written.error().what.find("cannot write"), std::string::npos);
    }
    EXPECT_EQ(folder.entries(), 1u);
}

} // namespace
} // namespace blush::test
