// Saved UI settings: damaged files, recent files; folder listings.
#include "tests/support/process.h"
#include "ui/window/file_listing.h"
#include "ui/window/file_places.h"
#include "ui/window/window_settings.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <utility>

namespace blush::TEST_FILE {
namespace {

class Files : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        const auto file = folder / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text;
        return file;
    }
    test::TemporaryFolder temporary;
    std::filesystem::path folder = temporary.path();
};

TEST_F(Files, SettingsRoundTrip) {
    WindowSettings s;
    s.width = 1600;
    s.maximized = true;
    s.splitters = {11.5f, 33};
    s.dock = {{30, 20}, {{"scopes", DockSide::bottom, false}, {"history", DockSide::right, true}}, {"history", "scopes"}};
    s.text_size = 125;
    s.follow_viewport = false;
    s.recent = {"/a/b.gltf", "/c \"d\".glb"};
    s.snapshot_folder = "/somewhere";
    s.snapshot_memory = 77;
    s.panels = {{"scopes", 1}, {"denoise.blend", 0.25}};
    s.floating = "[Window][Scopes]\nPos=1,2\n";
    s.scenes = {
        {"/a/b.gltf", 3, 0.25, 0.75, {7, 4711}, 12, {5, 4294967295u}, "Key", {"/a/b-0001.exr"}, {"scopes"}, {{"/a/b-plan-0001", 64}}},
        {"/c.glb", 0, 0.5, 0.5, {}, 0, {}, "", {}, {}}};
    const auto file = folder / "deep" / "window.json";
    ASSERT_TRUE(write_window_settings(file, s));
    EXPECT_EQ(read_window_settings(file), s);
}

TEST_F(Files, DamagedSettingsGiveTheDefaults) {
    EXPECT_EQ(read_window_settings(folder / "none.json"), WindowSettings{});
    for (const char* text : {"", "{", "[1, 2]", "null", "{\"width\": }", "\xff\xfe\x00garbage"})
        EXPECT_EQ(read_window_settings(write("broken.json", text)), WindowSettings{}) << text;
}

TEST_F(Files, DamagedEntryGetsItsDefaultOthersAreKept) {
    const auto file =
        write("odd.json",
              R"({"width": "wide", "height": 1e300, "outliner": -5, "maximized": 1, "recent": [1, "ok.glb", null], "inspector": 30,
                  "panels": {"a": "b", "c": 1}, "text_size": 1000, "dock": {"right": -3, "tabs": [4, {"id": 7}, {"id": "a"}, {"id": "a", "floats": true}]},
                  "scenes": [3, {"file": "x", "zoom": -4, "selected": [-1, "2", 5], "plans": [3, {"folder": 4}, {"folder": "p", "in_strip": -1}]}]})");
    const WindowSettings s = read_window_settings(file), defaults;
    EXPECT_EQ(s.width, defaults.width);
    EXPECT_EQ(s.maximized, defaults.maximized);
    EXPECT_LE(s.height, 16384);
    EXPECT_GE(s.splitters.outliner, 1);
    EXPECT_EQ(s.text_size, max_text_size);
    EXPECT_GE(s.dock.sizes.right, 1);
    EXPECT_EQ(s.dock.tabs, (std::vector<DockTab>{{"a", DockSide::right, false}}));
    EXPECT_EQ(s.splitters.inspector, 30);
    EXPECT_EQ(s.recent, std::vector<std::string>{"ok.glb"});
    EXPECT_EQ(s.panels, (std::map<std::string, double>{{"c", 1}}));
    ASSERT_EQ(s.scenes.size(), 2u);
    EXPECT_EQ(s.scenes[1].zoom, 0);
    EXPECT_EQ(s.scenes[1].selected, std::vector<uint32_t>{5});
    EXPECT_EQ(s.scenes[1].plans, (std::vector<PlanMemory>{{"p", 0}}));
}

TEST_F(Files, WritingToAReadOnlyPlaceIsAnError) {
    write("file", "");
    const auto written = write_window_settings(folder / "file" / "window.json", {});
    ASSERT_FALSE(written);
    EXPECT_FALSE(written.error().text().empty());
}

TEST_F(Files, SettingsAreInTheConfigFolder) {
    setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
    EXPECT_EQ(window_settings_file(), folder / "blush" / "window.json");
    unsetenv("XDG_CONFIG_HOME");
    setenv("HOME", "/home/somebody", 1);
    EXPECT_EQ(window_settings_file(), "/home/somebody/.config/blush/window.json");
    unsetenv("HOME");
    EXPECT_TRUE(window_settings_file().empty());
}

TEST_F(Files, RecentFilesAreUniqueNewestFirstAndLimited) {
    std::vector<std::string> recent;
    for (int i = 0; i < 15; ++i) remember_recent(recent, std::to_string(i));
    remember_recent(recent, "10");
    EXPECT_EQ(recent.front(), "10");
    EXPECT_EQ(recent[1], "14");
    EXPECT_EQ(recent.size(), 10u);
    EXPECT_EQ(std::ranges::count(recent, "10"), 1);
}

TEST_F(Files, ListsFoldersFirstThenMatchingFiles) {
    write("b.GLB", "12345");
    write("a.gltf", "");
    write("image.png", "");
    write(".hidden.glb", "");
    write("Zoo/x.glb", "");
    const auto list = list_folder(folder, scene_files);
    ASSERT_TRUE(list);
    ASSERT_EQ(list->entries.size(), 3u);
    EXPECT_EQ(list->entries[0], (FileEntry{"Zoo", true, 0}));
    EXPECT_EQ(list->entries[1], (FileEntry{"a.gltf", false, 0}));
    EXPECT_EQ(list->entries[2], (FileEntry{"b.GLB", false, 5}));
    const auto folders = list_folder(folder, {});
    ASSERT_TRUE(folders);
    EXPECT_EQ(folders->entries.size(), 1u);
    EXPECT_GT(folders->left_out, 0u);
    EXPECT_GT(folders->left_out, list->left_out) << "files of the kind do not count as left out";
}

TEST_F(Files, PathIsCompletedToTheCommonPrefix) {
    const std::filesystem::path place = folder / "complete";
    std::filesystem::create_directories(place / "scenes");
    for (const char* name : {"helmet.gltf", "helmet2.gltf", "notes.txt"}) std::ofstream(place / name) << "x";
    const std::string base = place.string() + "/";
    EXPECT_EQ(completed_path(base + "he", scene_files), base + "helmet");
    EXPECT_EQ(completed_path(base + "helmet2", scene_files), base + "helmet2.gltf");
    EXPECT_EQ(completed_path(base + "sc", scene_files), base + "scenes/");
    EXPECT_EQ(completed_path(base + "no", scene_files), base + "no") << "not of the kind";
    EXPECT_EQ(completed_path("nowhere/x", scene_files), "nowhere/x");
}

TEST_F(Files, TypedPathIsRelativeToTheShownFolderOrToHome) {
    setenv("HOME", "/home/somebody", 1);
    EXPECT_EQ(absolute_path("~/scenes/a.glb", "/work"), "/home/somebody/scenes/a.glb");
    EXPECT_EQ(absolute_path("~", "/work"), "/home/somebody/");
    EXPECT_EQ(absolute_path("~x", "/work"), "/work/~x");
    EXPECT_EQ(absolute_path("a.glb", "/work/scenes"), "/work/scenes/a.glb");
    EXPECT_EQ(absolute_path("../sky/", "/work/scenes"), "/work/sky/");
    EXPECT_EQ(absolute_path("/a.glb", "/work"), "/a.glb");
    EXPECT_EQ(absolute_path("", "/work"), "/work/");
    unsetenv("HOME");
    EXPECT_EQ(absolute_path("~/a", "/work"), "/work/~/a");
}

TEST_F(Files, PlacesHaveTheDesktopAndFoldersOfRecentFiles) {
    setenv("HOME", folder.c_str(), 1);
    setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
    unsetenv("XDG_DESKTOP_DIR");
    for (const char* name : {"Schreibtisch", "scene", "other", "kept"}) std::filesystem::create_directories(folder / name);
    write("config/user-dirs.dirs", "# by xdg-user-dirs\nXDG_MUSIC_DIR=\"$HOME/x\"\nXDG_DESKTOP_DIR=\"$HOME/Schreibtisch\"\n");
    WindowSettings settings;
    settings.recent = {(folder / "scene/a.glb").string(), (folder / "other/b.glb").string(), (folder / "gone/c.glb").string()};
    settings.bookmarks = {(folder / "kept").string()};
    std::vector<std::pair<std::string, std::filesystem::path>> places;
    for (const FilePlace& p : file_places(settings, folder / "scene")) places.emplace_back(p.name, p.folder);
    EXPECT_EQ(places, (std::vector<std::pair<std::string, std::filesystem::path>>{{"kept", folder / "kept"},
                                                                                  {"Home", folder},
                                                                                  {"Desktop", folder / "Schreibtisch"},
                                                                                  {"Scene", folder / "scene"},
                                                                                  {"other", folder / "other"}}));
    unsetenv("HOME");
    unsetenv("XDG_CONFIG_HOME");
}

TEST_F(Files, MissingFolderIsAnError) { EXPECT_FALSE(list_folder(folder / "none", scene_files)); }

TEST(BytesText, ThreeDigitsAtMost) {
    EXPECT_EQ(bytes_text(0), "0 B");
    EXPECT_EQ(bytes_text(999), "999 B");
    EXPECT_EQ(bytes_text(1500), "1.5 kB");
    EXPECT_EQ(bytes_text(12'345'678), "12 MB");
    EXPECT_EQ(bytes_text(999'900), "1.0 MB");
}

} // namespace
} // namespace blush::TEST_FILE
