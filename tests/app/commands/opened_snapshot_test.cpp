// Opening snapshot files: all stored state is restored, and hostile files are rejected.
#include "app/commands/opened_snapshot.h"
#include "app/commands/render/film_json.h"
#include "io/gltf/read/import.h"
#include "io/image/lossless_channels.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <fstream>

namespace blush::TEST_FILE {
namespace {

using test::TemporaryFolder;

// An image of the Cornell box with its film state, as the window stores it.
LayeredImage stored_image(const TemporaryFolder& folder) {
    const auto finished = test::blush({"render", test::scene_file("cornell"), "-o", folder / "p.exr", "--size", "16x12", "--spp", "4",
                                       "--quiet", "--layers", "albedo,normal,depth,id,film"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    const auto read = read_layers(folder / "p.exr");
    EXPECT_TRUE(read);
    return *read;
}

Scene cornell() { return import_gltf(test::scene_file("cornell"), {})->scene; }

TEST(OpenedSnapshot, RestoresImageSamplesAndState) {
    const TemporaryFolder folder;
    LayeredImage image = stored_image(folder);
    const Scene imported = cornell();
    Scene edited = imported;
    edited.environment.intensity = 3;
    image.metadata["blush:edits"] = edits_json(imported, edited);
    image.metadata["blush:view"] = R"({"exposure": 1.5})";
    image.metadata["blush:name"] = "Key only";
    image.metadata["blush:scene_file"] = std::filesystem::relative(test::scene_file("cornell"), folder.path()).string();
    ASSERT_TRUE(write_exr(folder / "s.exr", image));
    const auto opened = open_snapshot(folder / "s.exr", {});
    ASSERT_TRUE(opened) << opened.error().text();
    const Snapshot& s = opened->snapshot;
    EXPECT_EQ(s.name, "Key only");
    EXPECT_EQ(s.no_state, "");
    EXPECT_TRUE(std::filesystem::equivalent(s.scene_file, test::scene_file("cornell")));
    ASSERT_TRUE(s.film);
    EXPECT_EQ(s.film->samples, 4);
    for (size_t i = 0; i < 16 * 12; ++i) {
        EXPECT_EQ(s.images.frame->rgba[4 * i], image.find("R")->values[i]);
        EXPECT_EQ(s.images.frame->material_id[i], image.find("id.material")->words[i]);
        EXPECT_EQ(s.images.frame->object_id[i], image.find("id.object")->words[i]);
    }
    const auto state = state_of(opened->metadata, imported, s.scene_file);
    ASSERT_TRUE(state) << state.error().text();
    EXPECT_EQ(state->warning, "");
    EXPECT_TRUE(state->project.scene == edited);
    EXPECT_EQ(state->project.view.exposure_ev, 1.5f);
}

TEST(OpenedSnapshot, ReportsWhatCannotBeRestored) {
    const TemporaryFolder folder;
    LayeredImage image = stored_image(folder);
    image.metadata["blush:scene"] = "gone.gltf";
    ASSERT_TRUE(write_exr(folder / "s.exr", image));
    const auto opened = open_snapshot(folder / "s.exr", test::scene_file("cornell"));
    ASSERT_TRUE(opened);
    EXPECT_NE(opened->snapshot.no_state.find("gone.gltf"), std::string::npos);
    EXPECT_TRUE(opened->snapshot.images.frame) << "the image is still available";

    SnapshotMetadata m = opened->metadata;
    m.scene_hash = "0123456789abcdef";
    const auto changed = state_of(m, cornell(), test::scene_file("cornell"));
    ASSERT_TRUE(changed);
    EXPECT_NE(changed->warning.find("cornell.gltf has changed"), std::string::npos);
    m.edits = R"({"format": 1, "lights": {"removed": [77]}})";
    EXPECT_FALSE(state_of(m, cornell(), test::scene_file("cornell"))) << "edits of a missing record";
}

TEST(OpenedSnapshot, HostileMetadataDoNoHarm) {
    const TemporaryFolder folder;
    const LayeredImage image = stored_image(folder);
    const std::string film = image.metadata.at("blush:film");
    // Each leaves the image readable; only what it damages is missing.
    const std::pair<const char*, std::string> hostile[] = {
        {"blush:film", "{"},
        {"blush:film",
         R"({"first_sample":0,"samples":9223372036854775807,"seconds":1,"rays":[0,0,0],"truncated":0,"paths":[],"health":{}})"},
        {"blush:film", R"({"first_sample":-5,"samples":4})"},
        {"blush:film", film.substr(0, film.size() / 2)},
        {"blush:scene_file", "../../../../../../dev/zero"},
        {"blush:scene_file", std::string(100000, '/')},
        {"blush:scene", std::string("\0\x01../..", 8)},
        {"blush:edits", std::string(100000, '[')},
        {"blush:name", std::string(1000000, 'x')},
    };
    for (const auto& [key, text] : hostile) {
        LayeredImage broken = image;
        broken.metadata[key] = text;
        ASSERT_TRUE(write_exr(folder / "h.exr", broken));
        const auto opened = open_snapshot(folder / "h.exr", {});
        const std::string damaged = key, which = damaged + ": " + text.substr(0, 80);
        ASSERT_TRUE(opened) << which << ": " << opened.error().text();
        EXPECT_TRUE(opened->snapshot.images.frame) << which;
        EXPECT_EQ(opened->snapshot.film != nullptr, damaged != "blush:film") << which;
        EXPECT_EQ(opened->snapshot.scene_file, "") << which;
        EXPECT_EQ(bool(state_of(opened->metadata, cornell(), test::scene_file("cornell"))), damaged != "blush:edits") << which;
    }
    for (const auto& [key, text] : {std::pair("blush:settings", R"({"size":"9999999x1"})"), std::pair("blush:spp", "many")}) {
        LayeredImage broken = image;
        broken.metadata[key] = text;
        ASSERT_TRUE(write_exr(folder / "h.exr", broken));
        EXPECT_FALSE(open_snapshot(folder / "h.exr", {})) << key;
    }
    // Settings of another size and missing planes: the film state is not usable.
    LayeredImage fewer = image;
    std::erase_if(fewer.channels, [](const LayeredImage::Channel& c) { return c.name == "film.odd.R.low"; });
    ASSERT_TRUE(write_exr(folder / "h.exr", fewer));
    const auto opened = open_snapshot(folder / "h.exr", {});
    ASSERT_TRUE(opened);
    EXPECT_FALSE(opened->snapshot.film);
    // A truncated file.
    std::ifstream in(folder / "p.exr", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::ofstream(folder / "cut.exr", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    EXPECT_FALSE(open_snapshot(folder / "cut.exr", {}));
}

// A film of one pixel with light paths, in a file whose state says `passes`; null: nothing.
Result<FilmState> read_with_passes(const nlohmann::json& passes, bool light_paths = true) {
    Film film;
    film.reset({.width = 1, .height = 1, .light_paths = light_paths});
    FilmState state = save_film(film);
    state.samples = 5;
    state.passes = {3, 2};
    nlohmann::json json = nlohmann::json::parse(film_json(state));
    EXPECT_EQ(json.value("passes", nlohmann::json()), light_paths ? nlohmann::json::array({3, 2}) : nlohmann::json());
    json.erase("passes");
    json.erase("checksum"); // of the right passes
    if (!passes.is_null()) json["passes"] = passes;
    LayeredImage image;
    image.width = image.height = 1;
    for (const LosslessPlane& plane : planes_in_file(state)) add_lossless_plane(image, "film", plane);
    SnapshotMetadata metadata;
    metadata.film = json.dump();
    return film_in_file(image, metadata);
}

// Older versions saved it only as rendered before the pilots.
TEST(FilmInFile, SaysWhetherALoneFirstSampleIsComplete) {
    Film film;
    film.reset({.width = 1, .height = 1});
    FilmState state = save_film(film);
    state.samples = 1;
    const auto is_rough = [&](bool saved, bool old) {
        state.first_is_rough = saved;
        nlohmann::json json = nlohmann::json::parse(film_json(state));
        if (old) json.erase("first");
        LayeredImage image;
        image.width = image.height = 1;
        for (const LosslessPlane& plane : planes_in_file(state)) add_lossless_plane(image, "film", plane);
        SnapshotMetadata metadata;
        metadata.film = json.dump();
        return film_in_file(image, metadata)->first_is_rough;
    };
    EXPECT_TRUE(is_rough(true, false));
    EXPECT_FALSE(is_rough(false, false));
    EXPECT_TRUE(is_rough(false, true));
}

TEST(FilmInFile, KeepsPassesOfLightPathsAndRefusesImpossibleOnes) {
    const Result<FilmState> film = read_with_passes({3, 2});
    ASSERT_TRUE(film) << film.error().text();
    EXPECT_EQ(film->passes, (std::array<int64_t, 2>{3, 2}));
    EXPECT_TRUE(film_size(*film).light_paths);
    EXPECT_TRUE(read_with_passes({1, 0}));
    EXPECT_TRUE(read_with_passes(nullptr, false));
    const nlohmann::json wrong[] = {nullptr, {-1, 2}, {0, 0}, {3, int64_t(1) << 41}, {1e300, 2}, {3}, {3, 2, 1}, {"3", 2}, "3"};
    for (const nlohmann::json& passes : wrong) {
        const Result<FilmState> refused = read_with_passes(passes);
        ASSERT_FALSE(refused) << passes;
        EXPECT_NE(refused.error().text().find("blush:film passes"), std::string::npos) << refused.error().text();
    }
    EXPECT_FALSE(read_with_passes({3, 2}, false)) << "without splats";
}

} // namespace
} // namespace blush::TEST_FILE
