// EXT_lights_ies and EXT_lights_image_based: import, round trip through a save, and preservation of unedited lights.
#include "core/math.h"
#include "io/gltf/write/save.h"
#include "io/image/ies.h"
#include "io/project/scene_hash.h"
#include "scene/lights/ies_profile.h"
#include "tests/io/gltf/lit.h"
#include "tests/io/gltf/saving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

// Saves over another file of the same folder and reads that.
ImportedScene saved_and_loaded(const TempFolder& folder, const ImportedScene& original, const Scene& scene, SavedGltf* as = nullptr) {
    const auto saved = save_gltf(original.origin, {scene, {}, {}}, folder / "saved.gltf");
    if (!saved) throw std::runtime_error(saved.error().text());
    for (const Diagnostic& d : saved->diagnostics) ADD_FAILURE() << d.what;
    if (as) *as = *saved;
    ImportedScene loaded = load(folder / "saved.gltf");
    EXPECT_EQ(scene_hash(loaded.scene), scene_hash(saved->scene));
    EXPECT_EQ(loaded.scene.lights.size(), saved->scene.lights.size());
    return loaded;
}

OrderedJson written(const TempFolder& folder) { return OrderedJson::parse(text_of(folder / "saved.gltf")); }

// ---- luminaires

const Light& light_on(const Scene& scene, size_t node) { return *scene.lights.find(scene.nodes.entries()[node].value.light); }

TEST(IesLights, UseTheIntensityOfTheirNodes) {
    const TempFolder folder;
    const auto imported = import_text(folder, with_luminaires(folder).gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_TRUE(imported->report.diagnostics.empty());
    EXPECT_EQ(imported->report.extensions_honoured, std::vector<std::string>{"EXT_lights_ies"});
    const Scene& scene = imported->scene;
    const IesPtr profile = *read_ies(downlight);
    EXPECT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.nodes.entries()[0].value.light, scene.nodes.entries()[2].value.light);
    for (size_t node = 0; node < 4; ++node) {
        const Light& light = light_on(scene, node);
        EXPECT_EQ(light.kind, Light::Kind::point);
        ASSERT_TRUE(light.ies);
        EXPECT_EQ(light.ies->candela, profile->candela);
    }
    EXPECT_EQ(light_on(scene, 0).name, "down light");
    EXPECT_EQ(light_on(scene, 0).ies_file, "down light.ies");
    EXPECT_EQ(light_on(scene, 0).intensity, profile->peak) << "as measured";
    EXPECT_EQ(light_on(scene, 1).intensity, 0.25f * profile->peak);
    EXPECT_EQ(light_on(scene, 1).color, (Vec3{1, 0.5f, 0.25f}));
    EXPECT_EQ(light_on(scene, 3).name, "within");
    EXPECT_EQ(light_on(scene, 3).ies_file, "");
    EXPECT_EQ(light_on(scene, 3).intensity, 3 * profile->peak);
}

TEST(IesLights, AreUnchangedWithoutAnEdit) {
    const TempFolder folder;
    const auto original = import_text(folder, with_luminaires(folder).gltf());
    ASSERT_TRUE(original) << error_text(original);
    EXPECT_EQ(scene_hash(saved_and_loaded(folder, *original, original->scene).scene), scene_hash(original->scene));
    EXPECT_EQ(written(folder), OrderedJson::parse(*original->origin.json));
}

TEST(IesLights, EachFieldRoundTrips) {
    const TempFolder folder;
    const auto original = import_text(folder, with_luminaires(folder).gltf());
    ASSERT_TRUE(original) << error_text(original);
    for (const size_t node : {0, 1, 3}) {
        const Id<Light> id = original->scene.nodes.entries()[node].value.light;
        each_changed_field(*original->scene.lights.find(id), [&](const std::string& name, const Light& edited) {
            if (!validate(edited) || name == "ies_file") return;
            SCOPED_TRACE(name);
            Scene scene = original->scene;
            scene.lights.set(id, edited);
            // A profile embedded in this document cannot be kept for a light of another kind.
            if (edited.kind != Light::Kind::point && edited.ies_file.empty()) return;
            const Scene loaded = saved_and_loaded(folder, *original, scene).scene;
            Light found = *loaded.lights.find(id);
            ASSERT_TRUE(found.ies);
            found.ies = edited.ies;
            EXPECT_EQ(found, edited);
            for (size_t i = 0; i < 4; ++i) EXPECT_EQ(loaded.nodes.entries()[i].value.light, scene.nodes.entries()[i].value.light);
        });
    }
}

TEST(IesLights, AreWrittenInTheStandardForm) {
    const TempFolder folder;
    GltfBuilder b;
    b.add("nodes", {{"name", "a place"}});
    const auto original = import_text(folder, b.gltf());
    ASSERT_TRUE(original) << error_text(original);
    Scene scene = original->scene;
    Light light;
    light.name = "Key";
    light.ies = *read_ies(downlight);
    light.ies_file = downlight.string();
    light.intensity = 0.5f * light.ies->peak;
    light.color = {1, 0.5f, 0.5f};
    auto [id, node] = *scene.nodes.begin();
    node.light = scene.lights.add(light);
    scene.nodes.set(id, node);
    Node second = node; // with its own light of the same IES profile
    second.light = scene.lights.add(light);
    scene.nodes.add(second);
    const ImportedScene loaded = saved_and_loaded(folder, *original, scene);
    EXPECT_EQ(loaded.scene.lights.size(), 2u);
    const OrderedJson json = written(folder);
    EXPECT_EQ(json["extensionsUsed"], OrderedJson::array({"EXT_lights_ies"}));
    EXPECT_EQ(json["extensions"]["EXT_lights_ies"]["lights"][0]["uri"], "downlight.ies");
    const OrderedJson& said = json["nodes"][0]["extensions"]["EXT_lights_ies"];
    EXPECT_EQ(said["light"], 0);
    EXPECT_FLOAT_EQ(said["multiplier"].get<float>(), 0.5f);
    EXPECT_EQ(said["color"], OrderedJson::array({1.0, 0.5, 0.5}));
    EXPECT_EQ(text_of(folder / "downlight.ies"), text_of(downlight));
}

TEST(IesLights, SplitTheirProfileEntryWhenOneIsEditedOrRemoved) {
    const TempFolder folder;
    const auto original = import_text(folder, with_luminaires(folder).gltf());
    ASSERT_TRUE(original) << error_text(original);
    Scene scene = original->scene;
    const Id<Light> kept = scene.nodes.entries()[1].value.light;
    for (const size_t gone : {2, 0}) scene.nodes.remove(scene.nodes.entries()[gone].id);
    SavedGltf saved;
    const ImportedScene loaded = saved_and_loaded(folder, *original, scene, &saved);
    EXPECT_EQ(loaded.scene.lights.size(), 2u);
    Light light = *loaded.scene.lights.find(kept);
    light.intensity *= 2;
    light.radius = 0.1f;
    Scene edited = saved.scene;
    edited.lights.set(kept, light);
    const auto again = save_gltf(saved.origin, {edited, {}, {}}, folder / "again.glb");
    ASSERT_TRUE(again) << error_text(again);
    const Scene last = load(folder / "again.glb").scene;
    EXPECT_EQ(last.lights.find(kept)->intensity, light.intensity);
    EXPECT_EQ(last.lights.find(kept)->radius, 0.1f);
}

TEST(IesLights, HostileLightsAreRefusedOrReported) {
    const TempFolder folder;
    const auto imported_with = [&](const Json& profile, const Json& node) {
        GltfBuilder b;
        b.json["extensionsUsed"] = {"EXT_lights_ies"};
        b.json["extensions"]["EXT_lights_ies"]["lights"] = Json::array({profile});
        b.add("scenes", {{"nodes", {b.add("nodes", node)}}});
        return import_text(folder, b.gltf());
    };
    const std::string data = "data:application/x-ies-lm-63;base64," + base64(text_of(downlight));
    EXPECT_EQ(imported_with({{"uri", data}}, light_node(0))->scene.lights.size(), 1u);
    EXPECT_NE(error_text(imported_with({{"uri", data}}, light_node(1))).find("IES light 1 does not exist; there are 1"), std::string::npos);
    const Json profiles[] = {Json::object(),
                             7,
                             {{"uri", "none.ies"}},
                             {{"uri", "../out.ies"}},
                             {{"uri", "http://example.org/a.ies"}},
                             {{"uri", "data:application/x-ies-lm-63;base64,!!!!"}},
                             {{"uri", "data:,plain"}},
                             {{"bufferView", 3}}};
    for (const Json& profile : profiles) {
        const auto imported = imported_with(profile, light_node(0));
        ASSERT_TRUE(imported) << error_text(imported);
        EXPECT_TRUE(reports(imported->report, "ignored: a light whose IES profile cannot be read")) << profile;
        EXPECT_EQ(imported->scene.lights.size(), 0u) << profile;
        EXPECT_FALSE(imported->scene.nodes.entries()[0].value.light);
        saved_and_loaded(folder, *imported, imported->scene);
        EXPECT_EQ(written(folder), OrderedJson::parse(*imported->origin.json)) << "unsupported parts are kept";
    }
    const auto odd = imported_with({{"uri", data}}, light_node(0, {{"multiplier", -3}, {"color", {2, "red", 0}}}));
    ASSERT_TRUE(odd) << error_text(odd);
    EXPECT_GE(light_on(odd->scene, 0).intensity, 0);
}

// ---- image-based lights

// Environment map lookup in a direction, as in the renderer.
Vec3 seen(const Environment& e, const Vec3& d) {
    const double turn = double(e.rotation_degrees) / 360;
    double u = std::atan2(double(d.x), -double(d.z)) / (2 * std::numbers::pi) + 0.5 + turn;
    u -= std::floor(u);
    const double v = std::acos(double(d.y)) / std::numbers::pi;
    const int x = std::min(int(u * e.image->width), e.image->width - 1), y = std::min(int(v * e.image->height), e.image->height - 1);
    const float* t = &e.image->floats[3 * size_t(y * e.image->width + x)];
    return {t[0], t[1], t[2]};
}

constexpr Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

TEST(ImageLight, FacesHaveTheirDirections) {
    const TempFolder folder;
    const auto imported = import_text(folder, with_image_light(coloured_faces(16), {{"intensity", 2.5}}).gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_TRUE(reports(imported->report, "EXT_lights_image_based"));
    EXPECT_EQ(imported->report.extensions_approximated, std::vector<std::string>{"EXT_lights_image_based"});
    const Environment& e = imported->scene.environment;
    ASSERT_EQ(e.kind, Environment::Kind::image);
    EXPECT_EQ(e.intensity, 2.5f);
    EXPECT_EQ(e.rotation_degrees, 0);
    EXPECT_EQ(e.image->width, 64);
    for (size_t i = 0; i < 6; ++i) EXPECT_EQ(seen(e, axes[i]), face_colors[i]) << i;
}

// Faces are not mirrored when seen from inside: the right half is on the right.
TEST(ImageLight, FacesAreNotMirrored) {
    const TempFolder folder;
    std::array<Image, 6> faces;
    for (Image& face : faces) {
        face = face_image(8, 3, {0, 0, 0});
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                face.bytes[size_t(3 * (8 * y + x))] = x >= 4 ? 255 : 0;    // red to the right
                face.bytes[size_t(3 * (8 * y + x)) + 1] = y < 4 ? 255 : 0; // green above
            }
    }
    const auto imported = import_text(folder, with_image_light(faces).gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    const Vec3 ups[] = {{0, 1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}};
    for (size_t i = 0; i < 6; ++i) {
        const Vec3 right = cross(axes[i], ups[i]);
        const auto towards = [&](float r, float u) {
            return seen(imported->scene.environment, normalize(axes[i] + right * splat<float>(r) + ups[i] * splat<float>(u)));
        };
        EXPECT_EQ(towards(0.5f, 0.5f), (Vec3{1, 1, 0})) << i;
        EXPECT_EQ(towards(-0.5f, 0.5f), (Vec3{0, 1, 0})) << i;
        EXPECT_EQ(towards(0.5f, -0.5f), (Vec3{1, 0, 0})) << i;
        EXPECT_EQ(towards(-0.5f, -0.5f), (Vec3{0, 0, 0})) << i;
    }
}

TEST(ImageLight, RgbdExceedsOne) {
    const TempFolder folder;
    std::array<Image, 6> faces;
    for (Image& face : faces) face = face_image(4, 4, {1, 0, 0}, 51);
    const auto imported = import_text(folder, with_image_light(faces).gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    for (const Vec3& axis : axes) {
        const Vec3 c = seen(imported->scene.environment, axis);
        EXPECT_FLOAT_EQ(c.x, 5);
        EXPECT_EQ(c.y, 0);
    }
}

TEST(ImageLight, TurnsTheCube) {
    const TempFolder folder;
    const float h = std::numbers::sqrt2_v<float> / 2;
    const auto about_y = import_text(folder, with_image_light(coloured_faces(8), {{"rotation", {0, h, 0, h}}}).gltf());
    ASSERT_TRUE(about_y) << error_text(about_y);
    EXPECT_NEAR(about_y->scene.environment.rotation_degrees, 90, 1e-4) << "which can still be edited";
    EXPECT_EQ(seen(about_y->scene.environment, {0, 0, -1}), face_colors[0]) << "counter-clockwise from above, +X goes to -Z";
    const auto about_x = import_text(folder, with_image_light(coloured_faces(8), {{"rotation", {h, 0, 0, h}}}).gltf());
    ASSERT_TRUE(about_x) << error_text(about_x);
    EXPECT_EQ(about_x->scene.environment.rotation_degrees, 0);
    EXPECT_EQ(seen(about_x->scene.environment, {0, 0, 1}), face_colors[2]) << "+Y goes to +Z";
}

TEST(ImageLight, RoundTripsInTheStandardForm) {
    const TempFolder folder;
    const auto original = import_text(folder, with_image_light(coloured_faces(8), {{"name", "studio"}}).gltf());
    ASSERT_TRUE(original) << error_text(original);
    const size_t files = folder.entries();
    EXPECT_EQ(scene_hash(saved_and_loaded(folder, *original, original->scene).scene), scene_hash(original->scene));
    EXPECT_EQ(written(folder), OrderedJson::parse(*original->origin.json)) << "no edits";
    EXPECT_EQ(folder.entries(), files + 1) << "no other copy of the pixels";

    Scene scene = original->scene;
    scene.environment.intensity = 3;
    scene.environment.rotation_degrees = 33;
    scene.environment.color = {1, 0.9f, 0.8f};
    const Environment loaded = saved_and_loaded(folder, *original, scene).scene.environment;
    EXPECT_EQ(loaded.rotation_degrees, 33);
    EXPECT_EQ(loaded.color, scene.environment.color);
    EXPECT_EQ(loaded.image->floats, scene.environment.image->floats);
    const OrderedJson light = written(folder)["extensions"]["EXT_lights_image_based"]["lights"][0];
    EXPECT_EQ(light["intensity"], 3);
    EXPECT_NEAR(light["rotation"][1].get<double>(), std::sin(33 * std::numbers::pi / 360), 1e-6);

    // Another environment: the reference and its images are removed.
    scene.environment = {};
    scene.environment.kind = Environment::Kind::constant;
    EXPECT_EQ(saved_and_loaded(folder, *original, scene).scene.environment, scene.environment);
    EXPECT_FALSE(written(folder).contains("images"));
    EXPECT_FALSE(written(folder).contains("extensions"));
}

TEST(ImageLight, HostileImagesAreReported) {
    const TempFolder folder;
    const auto broken = [&](const auto& damage) {
        GltfBuilder b = with_image_light(coloured_faces(4));
        damage(b.json, b.json["extensions"]["EXT_lights_image_based"]["lights"][0]);
        const auto imported = import_text(folder, b.gltf());
        ASSERT_TRUE(imported) << error_text(imported);
        EXPECT_TRUE(reports(imported->report, "the image-based light is not shown"));
        EXPECT_EQ(imported->scene.environment, Environment{});
        saved_and_loaded(folder, *imported, imported->scene);
        EXPECT_EQ(written(folder), OrderedJson::parse(*imported->origin.json)) << "unsupported parts are kept";
    };
    broken([](Json&, Json& light) { light.erase("specularImages"); });
    broken([](Json&, Json& light) { light["specularImages"] = Json::array({Json::array({0, 1, 2})}); });
    broken([](Json&, Json& light) { light["specularImages"][0][5] = 99; });
    broken([](Json&, Json& light) { light["specularImages"][0][5] = -1; });
    broken([](Json& root, Json&) { root["bufferViews"][2]["byteLength"] = 20; });
    broken([](Json& root, Json&) { root["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 7; });
    broken([](Json& root, Json&) { root["extensions"].erase("EXT_lights_image_based"); });
    GltfBuilder oblong = with_image_light([] {
        std::array<Image, 6> faces = coloured_faces(4);
        faces[3] = face_image(8, 3, {1, 1, 1});
        return faces;
    }());
    const auto imported = import_text(folder, oblong.gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_TRUE(reports(imported->report, "square and of one size"));
}

} // namespace
} // namespace blush::test::TEST_FILE
