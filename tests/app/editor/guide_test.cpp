// Help > Guide: addresses of pages, and the message when a page or xdg-open is missing.
#include "app/editor/guide.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace blush::TEST_FILE {
namespace {

using test::TemporaryFolder;

TEST(Guide, AddressesAreEncodedAndKeepTheirAnchor) {
    EXPECT_EQ(guide_address("/usr/share/blush/guide", "guide/lighting.html#kinds-of-lights"),
              "file:///usr/share/blush/guide/guide/lighting.html#kinds-of-lights");
    EXPECT_EQ(guide_address("/home/a b/100%/\xc3\xa4;`#", "README.html"), "file:///home/a%20b/100%25/%C3%A4;%60%23/README.html");
}

// A program of the given lines in PATH, in place of the desktop's.
class Path {
public:
    explicit Path(const std::filesystem::path& folder) : before_(std::getenv("PATH")) { setenv("PATH", folder.c_str(), 1); }
    ~Path() { setenv("PATH", before_.c_str(), 1); }

private:
    std::string before_;
};

TEST(Guide, OpensThePageWithXdgOpen) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "docs/guide");
    std::filesystem::create_directories(folder / "bin");
    std::ofstream(folder / "docs/guide/lighting.html") << "<p>";
    const std::filesystem::path opened = folder / "opened";
    std::ofstream(folder / "bin/xdg-open") << "#!/bin/sh\necho \"$1\" >" << opened << ".new\n/bin/mv " << opened << ".new " << opened
                                           << "\n";
    std::filesystem::permissions(folder / "bin/xdg-open", std::filesystem::perms::owner_all);
    const Path path(folder / "bin");
    ASSERT_TRUE(open_guide(folder / "docs", "guide/lighting.html#units"));
    for (int i = 0; i < 3000 && !std::filesystem::exists(opened); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::string address;
    std::getline(std::ifstream(opened), address);
    EXPECT_EQ(address, guide_address(folder / "docs", "guide/lighting.html#units"));

    const Result<void> missing = open_guide(folder / "docs", "guide/none.html");
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().text().find("none.html"), std::string::npos);
}

TEST(Guide, ReportsThatXdgOpenIsMissing) {
    const TemporaryFolder folder;
    std::ofstream(folder / "README.html") << "<p>";
    const Path path(folder.path());
    const Result<void> opened = open_guide(folder.path(), "README.html");
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().text().find("xdg-open is not installed"), std::string::npos);
}

} // namespace
} // namespace blush::TEST_FILE
