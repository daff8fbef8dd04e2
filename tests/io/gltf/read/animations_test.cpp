// Animations, skins and morph targets: valid and broken files, and round trip through a save.
#include "io/gltf/write/save.h"
#include "io/project/scene_hash.h"
#include "scene/animation/keyframes.h"
#include "scene/animation/pose.h"
#include "scene/document/scene_selection.h"
#include "tests/io/gltf/saving.h"

#include <gtest/gtest.h>

#include <limits>

namespace blush::test::TEST_FILE {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// A node with a triangle, and an animation that has one channel.
struct Animated {
    GltfBuilder builder;
    int node = 0;

    Animated() { node = builder.show({{"attributes", {{"POSITION", builder.triangle_positions()}}}}); }
    void animate(const char* path, int input, int output, const char* interpolation = "LINEAR") {
        builder.add("animations", {{"name", "Move"},
                                   {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                                   {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}});
    }
    void animate(const char* path, const std::vector<float>& times, const std::vector<float>& values,
                 const char* interpolation = "LINEAR") {
        const std::string type = path == std::string("weights") ? "SCALAR" : path == std::string("rotation") ? "VEC4" : "VEC3";
        const int input = builder.accessor(times, "SCALAR");
        animate(path, input, builder.accessor(values, type), interpolation);
    }
};

ImportedScene imported(const GltfBuilder& builder) {
    Result<ImportedScene> result = import_built(builder);
    EXPECT_TRUE(result) << error_text(result);
    return result ? *std::move(result) : ImportedScene{};
}

const Clip& only_clip(const ImportedScene& s) { return s.scene.clips.begin()->value; }

// Transform of the first node at a time of the only clip.
Transform at(const ImportedScene& s, float seconds) {
    const Scene scene = with_scene_selection(s.scene, {.clip = s.scene.clips.begin()->id, .seconds = seconds});
    return posed_transform(scene, scene.nodes.begin()->id, scene.nodes.begin()->value);
}

TEST(GltfAnimations, AnimateNodes) {
    Animated a;
    a.animate("translation", {0, 2}, {0, 0, 0, 4, 6, 8});
    const ImportedScene s = imported(a.builder);
    ASSERT_EQ(s.scene.clips.size(), 1u);
    EXPECT_EQ(only_clip(s).name, "Move");
    EXPECT_EQ(only_clip(s).seconds, 2);
    EXPECT_FALSE(s.scene.scene_selection.clip) << "rest pose until a clip is chosen";
    EXPECT_EQ(at(s, 0.5f).translation, (Vec3{1, 1.5f, 2}));
    EXPECT_EQ(s.scene.nodes.begin()->value.local.translation, (Vec3{0, 0, 0}));
}

TEST(GltfAnimations, AllInterpolationsAreRead) {
    Animated step, spline;
    step.animate("scale", {0, 1}, {1, 1, 1, 5, 5, 5}, "STEP");
    EXPECT_EQ(at(imported(step.builder), 0.9f).scale, (Vec3{1, 1, 1}));
    // From 0 to 1 with no speed at either end: 3 t^2 - 2 t^3.
    spline.animate("scale", {0, 1}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0}, "CUBICSPLINE");
    EXPECT_FLOAT_EQ(at(imported(spline.builder), 0.25f).scale.x, 3.f / 16 - 2.f / 64);
}

TEST(GltfAnimations, NormalisedIntegersAreUnitQuaternions) {
    Animated a;
    const int input = a.builder.accessor<float>({0, 1}, "SCALAR");
    a.animate("rotation", input, a.builder.accessor<int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", true));
    const Quat q = at(imported(a.builder), 0.5f).rotation; // half of half a turn about Z
    EXPECT_NEAR(q.z, 0.70710678f, 1e-6f);
    EXPECT_NEAR(q.w, 0.70710678f, 1e-6f);
}

TEST(GltfAnimations, SparseKeyframesAreRead) {
    Animated a;
    const int input = a.builder.accessor<float>({0, 1, 2}, "SCALAR"), view = a.builder.buffer_view(std::string(1, '\1'));
    const std::vector<float> value{3, 0, 0};
    const int values = a.builder.buffer_view({reinterpret_cast<const char*>(value.data()), 12});
    const int output = a.builder.add(
        "accessors",
        {{"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"sparse", {{"count", 1}, {"indices", {{"bufferView", view}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}}}});
    a.animate("translation", input, output);
    EXPECT_EQ(at(imported(a.builder), 1).translation, (Vec3{3, 0, 0}));
    EXPECT_EQ(at(imported(a.builder), 2).translation, (Vec3{0, 0, 0}));
}

// Invalid parts are skipped with a warning; the scene opens.
TEST(GltfAnimations, BrokenChannelsAreSkipped) {
    const auto refused = [](Animated a, const char* why) {
        const ImportedScene s = imported(a.builder);
        EXPECT_TRUE(reports(s.report, why)) << why;
        ASSERT_EQ(s.scene.clips.size(), 1u) << why;
        EXPECT_TRUE(only_clip(s).channels.empty()) << why;
        EXPECT_EQ(s.scene.nodes.size(), 1u);
    };
    const auto with = [](std::vector<float> times, std::vector<float> values) {
        Animated a;
        a.animate("translation", times, values);
        return a;
    };
    refused(with({0, nan}, {0, 0, 0, 1, 1, 1}), "not finite");
    refused(with({0, 1}, {0, 0, 0, 1, nan, 1}), "not finite");
    refused(with({1, 0}, {0, 0, 0, 1, 1, 1}), "not in order");
    refused(with({-1, 0}, {0, 0, 0, 1, 1, 1}), "negative");
    refused(with({0, 1, 2}, {0, 0, 0, 1, 1, 1}), "6 numbers for 3 keyframes");
    const auto changed = [&](const char* path, Json value) {
        Animated a = with({0, 1}, {0, 0, 0, 1, 1, 1});
        a.builder.json["animations"][0][Json::json_pointer(path)] = std::move(value);
        return a;
    };
    refused(changed("/channels/0/target/node", 99), "node 99 does not exist");
    refused(changed("/channels/0/target/path", "colour"), "\"colour\"");
    refused(changed("/channels/0/sampler", 3), "sampler 3 does not exist");
    refused(changed("/samplers/0/interpolation", "WOBBLY"), "WOBBLY");
    refused(changed("/samplers/0/input", 1000), "accessor 1000");
    refused(changed("/samplers/0/output", -5), "accessor");
    refused(changed("/channels/0/target/path", "rotation"), "components");
    refused(changed("/channels/0/target/path", "weights"), "components");
}

TEST(GltfAnimations, MemoryIsLimited) {
    Animated a;
    // Keyframes that need no bytes in the file, referenced many times.
    const int input = a.builder.add("accessors", {{"componentType", 5126}, {"count", 1 << 21}, {"type", "SCALAR"}});
    const int output = a.builder.add("accessors", {{"componentType", 5126}, {"count", 1 << 21}, {"type", "VEC4"}});
    Json samplers = Json::array(), channels = Json::array();
    for (int i = 0; i < 20; ++i) {
        samplers.push_back({{"input", input}, {"output", output}});
        channels.push_back({{"sampler", i}, {"target", {{"node", a.node}, {"path", "rotation"}}}});
    }
    a.builder.add("animations", {{"samplers", samplers}, {"channels", channels}});
    EXPECT_NE(error_text(import_built(a.builder)).find("when decoded"), std::string::npos);
}

TEST(GltfAnimations, OneChannelAnimatesAProperty) {
    Animated a;
    a.animate("translation", {0, 2}, {0, 0, 0, 4, 6, 8});
    Json& channels = a.builder.json["animations"][0]["channels"];
    channels.push_back(channels[0]);
    const ImportedScene s = imported(a.builder);
    EXPECT_EQ(only_clip(s).channels.size(), 1u);
    EXPECT_TRUE(reports(s.report, "1 channels whose property another channel animates"));
}

// Two joints, one 1 m above the other, and a strip between them.
struct Skinned {
    GltfBuilder builder;
    int lower = 0, upper = 0, body = 0;

    explicit Skinned(std::vector<float> weights = {1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0},
                     std::vector<uint8_t> joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}) {
        const int positions = builder.triangle_positions();
        const int j = builder.accessor(joints, "VEC4"), w = builder.accessor(weights, "VEC4");
        std::vector<float> matrices(32);
        for (size_t m = 0; m < 2; ++m)
            for (size_t i = 0; i < 4; ++i) matrices[16 * m + 5 * i] = 1;
        matrices[16 + 13] = -1;
        const int view = builder.buffer_view({reinterpret_cast<const char*>(matrices.data()), matrices.size() * sizeof(float)});
        const int inverse = builder.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 2}, {"type", "MAT4"}});
        lower = builder.add("nodes", {{"name", "lower"}, {"children", {1}}});
        upper = builder.add("nodes", {{"name", "upper"}, {"translation", {0, 1, 0}}});
        body = builder.show({{"attributes", {{"POSITION", positions}, {"JOINTS_0", j}, {"WEIGHTS_0", w}}}});
        builder.json["nodes"][size_t(body)]["skin"] = builder.add("skins", {{"joints", {lower, upper}}, {"inverseBindMatrices", inverse}});
        builder.add("scenes", {{"nodes", {lower, body}}});
    }
    const Node& node(const ImportedScene& s, int index) const {
        return *s.scene.nodes.find(ids_by_index(s.origin.indices.nodes, 3)[size_t(index)]);
    }
};

TEST(GltfSkins, AreRead) {
    const Skinned made;
    const ImportedScene s = imported(made.builder);
    const Skin* skin = s.scene.skins.find(made.node(s, made.body).skin);
    ASSERT_TRUE(skin);
    ASSERT_EQ(skin->joints.size(), 2u);
    EXPECT_EQ(s.scene.nodes.find(skin->joints[1])->name, "upper");
    EXPECT_EQ(skin->joint_from_mesh[1].t, (Vec3{0, -1, 0}));
    const Geometry& g = *s.scene.meshes.begin()->value.parts[0].geometry;
    ASSERT_EQ(g.influences.size(), 12u);
    EXPECT_EQ(g.influences[5].joint, 1);
    EXPECT_EQ(g.influences[5].weight, 1);
    EXPECT_FALSE(reports(s.report, "normalised"));
    EXPECT_FALSE(reports(s.report, "ignored"));
}

TEST(GltfSkins, WeightsAreNormalised) {
    const ImportedScene s = imported(Skinned({2, 2, 0, 0, 0, 0, 0, 0, nan, 1, -3, 0}).builder);
    EXPECT_TRUE(reports(s.report, "the skinning weights of 2 vertices do not sum to 1"));
    EXPECT_TRUE(reports(s.report, "2 invalid joints or weights"));
    const auto& by = s.scene.meshes.begin()->value.parts[0].geometry->influences;
    EXPECT_EQ(by[0].weight, 0.5f);
    EXPECT_EQ(by[1].weight, 0.5f);
    EXPECT_EQ(by[4].weight, 1) << "without any, the first joint's";
    EXPECT_EQ(by[9].weight, 1);
}

TEST(GltfSkins, BrokenSkinsAreReported) {
    const ImportedScene stray = imported(Skinned({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {0, 0, 0, 0, 200, 0, 0, 0, 0, 0, 0, 0}).builder);
    EXPECT_TRUE(reports(stray.report, "joints beyond the 2 of skin"));
    Skinned no_joint;
    no_joint.builder.json["skins"][0]["joints"][1] = 77;
    EXPECT_NE(error_text(import_built(no_joint.builder)).find("joint 77 does not exist"), std::string::npos);
    Skinned no_skin;
    no_skin.builder.json["nodes"][size_t(no_skin.body)]["skin"] = 5;
    EXPECT_NE(error_text(import_built(no_skin.builder)).find("skin 5 does not exist"), std::string::npos);
    Skinned elsewhere;
    elsewhere.builder.json["scenes"][0]["nodes"] = {elsewhere.body};
    EXPECT_TRUE(reports(imported(elsewhere.builder).report, "2 joints are in no scene"));
    Skinned few;
    few.builder.json["accessors"].back()["count"] = 1;
    EXPECT_TRUE(reports(imported(few.builder).report, "1 inverse bind matrices for 2 joints"));
}

Json morphing(GltfBuilder& builder) {
    const int positions = builder.triangle_positions();
    const int offsets = builder.accessor<float>({0, 0, 0, 0, 0, 2, 0, 0, 0}, "VEC3");
    return {{"attributes", {{"POSITION", positions}}}, {"targets", {{{"POSITION", offsets}}, {{"POSITION", offsets}}}}};
}

// A large mesh on many nodes: memory and time are limited.
TEST(GltfSkins, DeformedVerticesAreLimited) {
    GltfBuilder b;
    constexpr int vertices = 3 << 16, nodes = 200;
    const auto zeros = [&](const char* type) { return b.add("accessors", {{"componentType", 5126}, {"count", vertices}, {"type", type}}); };
    const int mesh =
        b.add("meshes",
              {{"primitives",
                {{{"attributes", {{"POSITION", zeros("VEC3")}, {"NORMAL", zeros("VEC3")}}}, {"targets", {{{"POSITION", zeros("VEC3")}}}}}}},
               {"weights", {0}}});
    for (int i = 0; i < nodes; ++i) b.add("nodes", {{"mesh", mesh}});
    const ImportedScene s = imported(b);
    EXPECT_TRUE(reports(s.report, "deformed vertices"));
    const auto deformed = std::ranges::count_if(s.scene.nodes, [](const auto& n) { return !n.value.morph_weights.empty(); });
    EXPECT_EQ(deformed, (1 << 24) / vertices);
}

TEST(GltfMorphTargets, AreReadWithNamesAndWeights) {
    GltfBuilder builder;
    builder.show(morphing(builder));
    builder.json["meshes"][0]["weights"] = {0.25, 0};
    builder.json["meshes"][0]["extras"]["targetNames"] = {"Smile", "Frown"};
    ImportedScene s = imported(builder);
    const Mesh& mesh = s.scene.meshes.begin()->value;
    EXPECT_EQ(mesh.target_names, (std::vector<std::string>{"Smile", "Frown"}));
    ASSERT_EQ(mesh.parts[0].geometry->targets.size(), 2u);
    EXPECT_EQ(mesh.parts[0].geometry->targets[1]->positions[1], (Vec3{0, 0, 2}));
    EXPECT_TRUE(mesh.parts[0].geometry->flat);
    EXPECT_EQ(s.scene.nodes.begin()->value.morph_weights, (std::vector<float>{0.25f, 0}));
    EXPECT_EQ(world_bounds(s.scene).high.z, 0.5) << "a quarter of 2";
    builder.json["nodes"][0]["weights"] = {1, 0.5};
    s = imported(builder);
    EXPECT_EQ(s.scene.nodes.begin()->value.morph_weights, (std::vector<float>{1, 0.5f}))
        << "weights of the node take precedence over those of the mesh";
    EXPECT_EQ(world_bounds(s.scene).high.z, 3);
}

TEST(GltfMorphTargets, BrokenTargetsAreReported) {
    GltfBuilder builder;
    builder.show(morphing(builder));
    builder.json["nodes"][0]["weights"] = {1, 2, 3};
    EXPECT_TRUE(reports(imported(builder).report, "3 weights for 2 morph targets"));
    const int few = builder.accessor<float>({0, 0, 0}, "VEC3"), mad = builder.accessor<float>({0, nan, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
    builder.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = mad;
    EXPECT_TRUE(reports(imported(builder).report, "1 non-finite offsets"));
    builder.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = few;
    EXPECT_NE(error_text(import_built(builder)).find("1 elements for 3 positions"), std::string::npos);
    builder.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = 99;
    EXPECT_NE(error_text(import_built(builder)).find("accessor 99"), std::string::npos);
}

// All kinds of animation in one file.
GltfBuilder moving() {
    Skinned made;
    GltfBuilder& b = made.builder;
    Json primitive = morphing(b);
    const int blob = b.show(primitive);
    b.json["nodes"][size_t(blob)]["weights"] = {0.25, 0.5};
    b.json["scenes"][0]["nodes"].push_back(blob);
    const int times = b.accessor<float>({0, 1}, "SCALAR"), turn = b.accessor<float>({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    const int weights = b.accessor<float>({0, 0, 1, 0.5f}, "SCALAR");
    b.add("animations", {{"name", "Wave"},
                         {"samplers", {{{"input", times}, {"output", turn}}, {{"input", times}, {"output", weights}}}},
                         {"channels",
                          {{{"sampler", 0}, {"target", {{"node", made.upper}, {"path", "rotation"}}}},
                           {{"sampler", 1}, {"target", {{"node", blob}, {"path", "weights"}}}}}}});
    return b;
}

// Saved and loaded by index.
void expect_comes_back(const ImportedScene& original, const Scene& edited, const char* what) {
    const TempFolder folder;
    for (const char* name : {"saved.gltf", "saved.glb"}) {
        const auto saved = save_gltf(original.origin, {edited, {}, {}}, folder / name);
        ASSERT_TRUE(saved) << error_text(saved) << what;
        for (const Diagnostic& d : saved->diagnostics) ADD_FAILURE() << what << ": " << d.what;
        const ImportedScene loaded = load(folder / name);
        EXPECT_EQ(scene_hash(loaded.scene), scene_hash(saved->scene)) << what;
        EXPECT_EQ(loaded.scene.nodes, saved->scene.nodes) << what;
        EXPECT_EQ(loaded.scene.skins, saved->scene.skins) << what;
        EXPECT_EQ(loaded.scene.scene_selection, saved->scene.scene_selection) << what;
        EXPECT_EQ(loaded.scene.view, edited.view) << what;
        EXPECT_EQ(loaded.scene.clips.size(), edited.clips.size()) << what;
        EXPECT_EQ(world_bounds(loaded.scene).low, world_bounds(edited).low) << what;
        EXPECT_EQ(world_bounds(loaded.scene).high, world_bounds(edited).high) << what;
    }
}

TEST(GltfMotion, SurvivesASave) {
    const TempFolder folder;
    write_bytes(folder / "moving.gltf", moving().gltf());
    const ImportedScene original = load(folder / "moving.gltf");
    expect_comes_back(original, original.scene, "as it was");
    const Scene posed = with_scene_selection(original.scene, {.clip = original.scene.clips.begin()->id, .seconds = 0.375f});
    EXPECT_NE(world_bounds(posed).high, world_bounds(original.scene).high);
    expect_comes_back(original, posed, "posed");

    Scene edited = posed;
    for (const auto& [id, node] : posed.nodes) {
        Node moved = node;
        for (float& weight : moved.morph_weights) weight += 0.5f;
        moved.local.translation.x += 1;
        edited.nodes.set(id, moved);
    }
    expect_comes_back(original, edited, "moved");
}

// Duplicates and imports include skin, weights and animation.
TEST(GltfMotion, DuplicatesAreAnimated) {
    const TempFolder folder;
    write_bytes(folder / "moving.gltf", moving().gltf());
    const ImportedScene original = load(folder / "moving.gltf");
    Project project{original.scene, {}, {}};
    const Skinned names;
    for (const auto& [id, node] : original.scene.nodes)
        if (!node.parent) project = *blush::apply(project, DuplicateNode{id});
    project.scene = with_scene_selection(project.scene, {.clip = original.scene.clips.begin()->id, .seconds = 0.375f});
    EXPECT_EQ(project.scene.clips.begin()->value.channels.size(), 4u);
    expect_comes_back(original, project.scene, "copied");

    const Project imported_twice = *blush::apply({original.scene, {}, {}}, Import{original.scene, "again"});
    EXPECT_EQ(imported_twice.scene.clips.size(), 2u);
    EXPECT_EQ(imported_twice.scene.skins.size(), 2u);
    const Id<Clip> second{imported_twice.scene.clips.entries()[1].id};
    expect_comes_back(original, with_scene_selection(imported_twice.scene, {.clip = second, .seconds = 0.5f}), "imported");
}

} // namespace
} // namespace blush::test::TEST_FILE
