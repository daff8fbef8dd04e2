// load(save(x)) == x for edits of every kind, in both formats, for repeated saves.
#include "io/gltf/read/ids.h"
#include "io/gltf/write/save.h"
#include "io/image/ies.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"
#include "scene/lights/ies_profile.h"
#include "tests/io/gltf/saving.h"
#include "tests/support/random_edits.h"
#include "tests/support/storable.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

// Compares every record and field; triangles and pixels by value.
void expect_same(const ImportedScene& loaded, const SavedGltf& saved, const Project& project, const std::string& what) {
    EXPECT_EQ(loaded.scene.view, project.scene.view) << what;
    Scene expected = saved.scene;
    expected.environment = loaded.scene.environment; // compared by its values below
    EXPECT_EQ(scene_hash(loaded.scene), scene_hash(expected)) << what << "\n" << edits_json(expected, loaded.scene);
    EXPECT_EQ(loaded.scene.nodes, expected.nodes) << what;
    EXPECT_EQ(loaded.scene.lights, expected.lights) << what;
    EXPECT_EQ(loaded.scene.cameras, expected.cameras) << what;
    EXPECT_EQ(loaded.scene.materials, expected.materials) << what;
    Environment environment = project.scene.environment;
    environment.file = loaded.scene.environment.file;
    environment.image = loaded.scene.environment.image;
    EXPECT_EQ(loaded.scene.environment, environment) << what;
    if (project.scene.environment.kind == Environment::Kind::image) {
        ASSERT_TRUE(loaded.scene.environment.image) << what;
        EXPECT_EQ(loaded.scene.environment.image->floats, project.scene.environment.image->floats) << what;
    }
    EXPECT_EQ(loaded.render.value_or(RenderSettings{}), project.render) << what;
    EXPECT_EQ(loaded.view.value_or(ViewSettings{}), project.view) << what;
}

class GltfSave : public testing::TestWithParam<const char*> {};

TEST_P(GltfSave, RandomEditsOfShippedScenesRoundTrip) {
    const TempFolder folder;
    Rng rng(5);
    int number = 0;
    for (const char* name : shipped_scenes) {
        const ImportedScene original = load(shipped(name));
        for (int sequence = 0; sequence < 12; ++sequence) {
            Project project{original.scene, {}, {}};
            for (int step = 0; step < 1 + 4 * sequence; ++step) { project = *blush::apply(project, random_edit(rng, project)); }
            project = storable(project);
            const std::string what = fmt::format("{} after {} edits", name, 1 + 4 * sequence);
            const auto file = folder / fmt::format("{}.{}", number++, GetParam());
            const auto saved = save_gltf(original.origin, project, file);
            ASSERT_TRUE(saved) << error_text(saved) << what;
            for (const Diagnostic& d : saved->diagnostics) ADD_FAILURE() << what << ": " << d.what;
            expect_same(load(file), *saved, project, what);
        }
    }
}

// Each save starts from the previous one, as in the window.
TEST_P(GltfSave, RepeatedSavesAreLossless) {
    const TempFolder folder;
    Rng rng(6);
    const ImportedScene original = load(shipped("card-and-mug"));
    GltfOrigin origin = original.origin;
    Project project{original.scene, {}, {}};
    for (int save = 0; save < 12; ++save) {
        for (int step = 0; step < 6; ++step) project = storable(*blush::apply(project, random_edit(rng, project)));
        const auto file = folder / (std::string("scene.") + GetParam());
        const auto saved = save_gltf(origin, project, file);
        ASSERT_TRUE(saved) << error_text(saved);
        for (const Diagnostic& d : saved->diagnostics) ADD_FAILURE() << save << ": " << d.what;
        const ImportedScene loaded = load(file);
        expect_same(loaded, *saved, project, fmt::format("save {}", save));
        // Every other time from the saved file, as after a restart.
        origin = saved->origin;
        if (save % 2 == 0) continue;
        origin = loaded.origin;
        project.scene = loaded.scene;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, GltfSave, testing::Values("gltf", "glb"),
                         [](const auto& instance) { return std::string(instance.param); });

// Changes each member of a record and checks that it is read back: detects fields that are not saved.
template <class T, class Round> void each_field_comes_back(const std::string& what, const Table<T>& table, const Round& set_and_load) {
    const auto [id, record] = *table.begin();
    size_t fields = 0;
    each_changed_field(record, [&](const std::string& name, const T& edited) {
        if (edited == record || !validate(edited)) return;
        ++fields;
        SCOPED_TRACE(what + "." + name);
        const Table<T> loaded = set_and_load(id, edited);
        const T* found = loaded.find(id);
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, edited);
    });
    EXPECT_GT(fields, 3u);
}

TEST(GltfSaveFields, EachFieldRoundTrips) {
    const TempFolder folder;
    const ImportedScene original = load(rich_gltf(folder));
    const auto round_trip = [&](const Scene& scene) {
        const auto saved = save_gltf(original.origin, {scene, {}, {}}, folder / "saved.gltf");
        EXPECT_TRUE(saved) << error_text(saved);
        return load(folder / "saved.gltf").scene;
    };
    const auto with = [&](auto Scene::*table) {
        return [&, table](auto id, const auto& record) {
            Scene scene = original.scene;
            (scene.*table).set(id, record);
            return round_trip(scene).*table;
        };
    };
    each_field_comes_back("light", original.scene.lights, with(&Scene::lights));
    each_field_comes_back("material", original.scene.materials, with(&Scene::materials));
    each_field_comes_back("camera", original.scene.cameras, with(&Scene::cameras));
    each_field_comes_back("node", original.scene.nodes, with(&Scene::nodes));

    const auto comes_back = [&](auto Scene::*member, const std::string& name, const auto& edited) {
        Scene scene = original.scene;
        scene.*member = edited;
        EXPECT_EQ(round_trip(scene).*member, edited) << name;
    };
    each_changed_field(original.scene.environment, [&](const std::string& name, const Environment& edited) {
        if (validate(edited)) comes_back(&Scene::environment, name, edited);
    });
    each_changed_field(original.scene.view, [&](const std::string& name, const View& edited) {
        if (validate(edited.lens)) comes_back(&Scene::view, name, edited);
    });
    each_changed_field(MixChannel{}, [&](const std::string& name, const MixChannel& edited) {
        comes_back(&Scene::mix, name, LightMix{LightMix::Grouping::by_hand, {MixChannel{}, edited}});
    });
}

TEST(GltfSaveDocument, NoEditsLeaveTheDocumentUnchanged) {
    const TempFolder folder;
    for (const char* name : shipped_scenes) {
        const ImportedScene original = load(shipped(name));
        const auto saved = save_gltf(original.origin, {original.scene, {}, {}}, folder / (std::string(name) + ".gltf"));
        ASSERT_TRUE(saved) << error_text(saved);
        EXPECT_EQ(OrderedJson::parse(*saved->origin.json), OrderedJson::parse(*original.origin.json)) << name;
    }
}

TEST(GltfSaveDocument, DefaultDisplaySettingsAreStoredOnRequest) {
    const TempFolder folder;
    const ImportedScene original = load(shipped("cornell"));
    const Project project{original.scene, {}, {}};
    const std::filesystem::path file = folder / "saved.gltf";
    ASSERT_TRUE(save_gltf(original.origin, project, file));
    EXPECT_FALSE(load(file).view);
    const auto stored = save_gltf(original.origin, project, file, true);
    ASSERT_TRUE(stored) << error_text(stored);
    EXPECT_EQ(load(file).view, ViewSettings{});
    ASSERT_TRUE(save_gltf(stored->origin, project, file));
    EXPECT_EQ(load(file).view, ViewSettings{}) << "the next save keeps them";
}

TEST(GltfSaveDocument, UnknownThingsAndTheirOrderAreKept) {
    const TempFolder folder;
    const ImportedScene original = load(rich_gltf(folder));
    Scene scene = original.scene;
    const auto [lamp_id, lamp] = *scene.lights.begin();
    Light brighter = lamp;
    brighter.intensity = 321;
    brighter.radius = 0.25f;
    scene.lights.set(lamp_id, brighter);
    const auto saved = save_gltf(original.origin, {scene, {}, {}}, folder / "saved.gltf");
    ASSERT_TRUE(saved) << error_text(saved);
    // The same text except for the two numbers.
    OrderedJson expected = OrderedJson::parse(*original.origin.json);
    OrderedJson& light = expected["extensions"]["KHR_lights_punctual"]["lights"][0];
    light["intensity"] = 321.0;
    light["extras"]["blush"] = {{"fields", {{"radius", 0.25}}}};
    EXPECT_EQ(OrderedJson::parse(*saved->origin.json).dump(1), expected.dump(1));
}

TEST(GltfSaveDocument, UnusedObjectsArePrunedUnlessAnUnknownExtensionMayReferToThem) {
    const TempFolder folder;
    const ImportedScene original = load(shipped("card-and-mug"));
    Project project{original.scene, {}, {}};
    const auto mug =
        std::find_if(project.scene.nodes.begin(), project.scene.nodes.end(), [](const auto& n) { return n.value.name == "mug"; });
    project = *blush::apply(project, RemoveNode{mug->id});
    const auto saved = save_gltf(original.origin, project, folder / "without.gltf");
    ASSERT_TRUE(saved) << error_text(saved);
    const OrderedJson json = OrderedJson::parse(*saved->origin.json);
    EXPECT_EQ(json["nodes"].size(), 6u);
    EXPECT_EQ(json["meshes"].size(), 2u);
    EXPECT_EQ(json["accessors"].size(), 6u);
    EXPECT_TRUE(saved->diagnostics.empty());

    OrderedJson strange = OrderedJson::parse(*original.origin.json);
    strange["extensionsUsed"].push_back("ACME_nodes_by_number");
    strange["extensions"]["ACME_nodes_by_number"] = {{"favourite", 2}};
    GltfOrigin origin = original.origin;
    origin.json = std::make_shared<const std::string>(strange.dump());
    const auto kept = save_gltf(origin, project, folder / "with.gltf");
    ASSERT_TRUE(kept) << error_text(kept);
    EXPECT_EQ(OrderedJson::parse(*kept->origin.json)["nodes"].size(), 9u);
    ASSERT_EQ(kept->diagnostics.size(), 1u) << (kept->diagnostics.empty() ? "" : kept->diagnostics.back().what);
    EXPECT_EQ(load(folder / "with.gltf").scene.nodes, saved->scene.nodes);
}

TEST(GltfExtras, InvalidFieldsAreIgnoredAndTheRestRead) {
    GltfBuilder b;
    const auto node = [&](Json blush) { return b.add("nodes", {{"extras", {{"blush", std::move(blush)}}}}); };
    node({{"id", 7}});
    node({{"id", 7}}); // taken
    node({{"id", max_id_in_file + 1u}});
    node({{"id", -1}, {"fields", 5}});
    node({{"id", 8}, {"fields", {{"local", {{"translation", {1, 2}}}}, {"visible", false}}}});
    node({{"fields", {{"parent", 7}, {"mesh", 3}, {"future", Json::array({1, 2, 3})}}}});
    node({{"fallback", true}});
    node({{"fields", {{"local", {{"scale", {1e39, 1, 1}}}}}}}); // beyond a float
    for (const Json& fields : {Json{{"kind", "laser"}}, Json{{"intensity", -1}}, Json{{"kind", "disk"}, {"radius", 0}},
                               Json{{"lit_objects", {{"nodes", {"a"}}}}}, Json{{"color", {1, 2}}}, Json(std::vector<int>(20000, 1))})
        b.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(
            {{"type", "directional"}, {"extras", {{"blush", {{"fields", fields}}}}}});
    b.json["scenes"] = {{{"nodes", {0, 1, 2, 3, 4, 5, 6, 7}},
                         {"extras",
                          {{"blush",
                            {{"view", {{"lens", {{"yfov_radians", 9}}}}},
                             {"mix", {{"channels", {{{"kelvin", 1}}}}}},
                             {"render", {{"spp", -5}}},
                             {"display", 3},
                             {"environment", {{"kind", "sky"}, {"sky", 1}}}}}}}}};
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    std::vector<uint32_t> ids;
    for (const auto& [id, record] : imported->scene.nodes) ids.push_back(id.value);
    EXPECT_EQ(ids, (std::vector<uint32_t>{7, 8, 9, 10, 11, 12, 13}));
    EXPECT_FALSE(imported->scene.nodes.find(Id<Node>{8})->visible);
    for (const auto& [id, record] : imported->scene.nodes) EXPECT_FALSE(record.parent || record.mesh);
    Light plain;
    plain.kind = Light::Kind::sun;
    for (const auto& [id, light] : imported->scene.lights) {
        plain.name = light.name;
        EXPECT_EQ(light, plain);
    }
    EXPECT_EQ(imported->scene.mix, LightMix{});
    EXPECT_FALSE(imported->has_view || imported->render || imported->view);
    EXPECT_TRUE(validate(imported->scene));
    EXPECT_GE(imported->report.diagnostics.size(), 10u);
}

TEST(GltfSaveFiles, AFailedSaveChangesNothing) {
    const TempFolder folder;
    const ImportedScene original = load(shipped("cornell"));
    // A folder has the name of the document, which is detected after everything else is written.
    std::filesystem::create_directory(folder / "scene.gltf");
    write_bytes(folder / "scene.gltf/inside", "kept");
    EXPECT_FALSE(save_gltf(original.origin, {original.scene, {}, {}}, folder / "scene.gltf"));
    EXPECT_EQ(folder.entries(), 1u);
    EXPECT_FALSE(save_gltf(original.origin, {original.scene, {}, {}}, "/proc/scene.gltf"));
    EXPECT_FALSE(save_gltf(original.origin, {original.scene, {}, {}}, folder / "scene.obj"));
    EXPECT_EQ(folder.entries(), 1u);

    GltfOrigin lost = original.origin;
    lost.file = folder / "elsewhere/cornell.gltf";
    write_bytes(folder / "old.gltf", "the old one");
    EXPECT_FALSE(save_gltf(lost, {original.scene, {}, {}}, folder / "old.gltf"));
    EXPECT_EQ(text_of(folder / "old.gltf"), "the old one");
}

TEST(GltfSaveFiles, OtherFilesAreNotOverwritten) {
    const TempFolder folder;
    write_bytes(folder / "cornell.bin", "somebody else's");
    const ImportedScene original = load(shipped("cornell"));
    const auto saved = save_gltf(original.origin, {original.scene, {}, {}}, folder / "cornell.gltf");
    ASSERT_TRUE(saved) << error_text(saved);
    EXPECT_EQ(text_of(folder / "cornell.bin"), "somebody else's");
    EXPECT_TRUE(std::filesystem::exists(folder / "cornell-2.bin"));
    EXPECT_EQ(scene_hash(load(folder / "cornell.gltf").scene), scene_hash(original.scene));
}

TEST(GltfSaveFiles, AGlbIsSelfContained) {
    const TempFolder folder, elsewhere;
    const ImportedScene original = load(rich_gltf(folder));
    const auto saved = save_gltf(original.origin, {original.scene, {}, {}}, elsewhere / "scene.glb");
    ASSERT_TRUE(saved) << error_text(saved);
    EXPECT_EQ(elsewhere.entries(), 1u);
    const ImportedScene loaded = load(elsewhere / "scene.glb");
    EXPECT_EQ(scene_hash(loaded.scene), scene_hash(original.scene));
    EXPECT_EQ(loaded.scene.textures.begin()->value.image->bytes, original.scene.textures.begin()->value.image->bytes);
    // And back into files.
    const TempFolder back;
    ASSERT_TRUE(save_gltf(loaded.origin, {loaded.scene, {}, {}}, back / "scene.gltf"));
    EXPECT_EQ(scene_hash(load(back / "scene.gltf").scene), scene_hash(original.scene));
}

TEST(GltfSaveFiles, CopiesReferencedFiles) {
    const TempFolder folder, elsewhere;
    const ImportedScene original = load(rich_gltf(folder));
    const auto saved = save_gltf(original.origin, {original.scene, {}, {}}, elsewhere / "scene.gltf");
    ASSERT_TRUE(saved) << error_text(saved);
    EXPECT_TRUE(std::filesystem::exists(elsewhere / "images/two by two.png"));
    EXPECT_EQ(scene_hash(load(elsewhere / "scene.gltf").scene), scene_hash(original.scene));
    EXPECT_EQ(OrderedJson::parse(*saved->origin.json), OrderedJson::parse(*original.origin.json));
}

TEST(GltfSaveFiles, CopiesIesProfiles) {
    const TempFolder folder;
    const ImportedScene original = load(rich_gltf(folder));
    const std::filesystem::path profile = std::filesystem::path(BLUSH_ASSETS) / "ies" / "downlight.ies";
    Project project{original.scene, {}, {}};
    const auto [id, lamp] = *project.scene.lights.begin();
    Light measured = lamp;
    measured.ies = *read_ies(profile);
    measured.ies_file = profile.string();
    project.scene.lights.set(id, measured);
    const auto saved = save_gltf(original.origin, project, folder / "saved.gltf");
    ASSERT_TRUE(saved) << error_text(saved);
    EXPECT_TRUE(saved->diagnostics.empty());
    const ImportedScene loaded = load(folder / "saved.gltf");
    const Light& light = *loaded.scene.lights.find(id);
    EXPECT_EQ(light.ies_file, "downlight.ies");
    ASSERT_TRUE(light.ies);
    EXPECT_EQ(light.ies->candela, measured.ies->candela);
    EXPECT_EQ(text_of(folder / "downlight.ies"), text_of(profile));
}

} // namespace
} // namespace blush::test::TEST_FILE
