// Lint: probably unintended content is reported with its location; intended content is not.
#include "io/image/image_io.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <limits>

namespace blush::test::TEST_FILE {
namespace {

// Location of the diagnostic that contains `part`, or "none".
std::string place_of(const Result<ImportedScene>& imported, std::string_view part) {
    if (!imported) return imported.error().text();
    for (const Diagnostic& d : imported->report.diagnostics)
        if (d.what.find(part) != std::string::npos) return d.where;
    return "none";
}

Result<ImportedScene> with_light(Json light) {
    GltfBuilder b;
    b.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(std::move(light));
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return import_built(b);
}

TEST(GltfLint, ImplausibleIntensities) {
    const std::string where = "extensions.KHR_lights_punctual.lights[0].intensity";
    EXPECT_EQ(place_of(with_light({{"type", "point"}, {"intensity", 50000}}), "not in watts"), where);
    EXPECT_EQ(place_of(with_light({{"type", "point"}, {"intensity", 130}}), "candela"), "none") << "a bulb of 100 W";
    EXPECT_EQ(place_of(with_light({{"type", "spot"}, {"intensity", 50000}, {"spot", {{"outerConeAngle", 0.2}}}}), "candela"), "none")
        << "of a theatre";
    EXPECT_EQ(place_of(with_light({{"type", "directional"}, {"intensity", 3e5}}), "brighter than the sun in space"), where);
    EXPECT_EQ(place_of(with_light({{"type", "directional"}, {"intensity", 3}}), "dimmer than a lit room"), where);
    EXPECT_EQ(place_of(with_light({{"type", "directional"}, {"intensity", 100000}}), "lux"), "none");

    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}, {"material", 0}});
    b.add("materials", {{"emissiveFactor", {1, 1, 1}}, {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e9}}}}}});
    EXPECT_EQ(place_of(import_built(b), "filament"), "materials[0]");
}

TEST(GltfLint, InnerConesWiderThanOuterCones) {
    const auto wrong = with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.9}, {"outerConeAngle", 0.5}}}});
    EXPECT_EQ(place_of(wrong, "the inner cone, 0.9 rad, is wider than the outer one, 0.5 rad"),
              "extensions.KHR_lights_punctual.lights[0].spot");
    EXPECT_EQ(wrong->scene.lights.begin()->value.inner_cone_radians, 0.5f);
    EXPECT_EQ(place_of(with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}}), "cone"), "none");
}

TEST(GltfLint, CamerasWithoutADirection) {
    const auto scaled = [](const std::vector<double>& by) {
        GltfBuilder b;
        b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
        b.add("nodes", {{"camera", 0}, {"name", "eye"}, {"scale", by}});
        return import_built(b);
    };
    EXPECT_EQ(place_of(scaled({1, 1, 0}), "flattens an axis"), "camera node \"eye\"");
    EXPECT_EQ(place_of(scaled({0, 0, 0}), "flattens an axis"), "camera node \"eye\"");
    EXPECT_EQ(place_of(scaled({-1, 2, 1e-3}), "a camera"), "none");
}

TEST(GltfLint, ImplausibleSceneSizes) {
    const auto scaled = [](float by) {
        GltfBuilder b;
        const int node = b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
        b.json["nodes"][size_t(node)]["scale"] = {by, by, by};
        return import_built(b);
    };
    EXPECT_EQ(place_of(scaled(1e5f), "km across"), "scene");
    EXPECT_EQ(place_of(scaled(1e-4f), "mm across"), "scene");
    EXPECT_EQ(place_of(scaled(1), "across"), "none");
}

TEST(GltfLint, DegenerateGeometry) {
    GltfBuilder b;
    const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0}, "VEC3");
    const int normals = b.accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 0.995f, 0, 0, 1}, "VEC3");
    b.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
            {"indices", b.accessor<uint8_t>({0, 1, 2, 0, 1, 3, 1, 1, 2}, "SCALAR")}});
    const auto imported = import_built(b);
    EXPECT_EQ(place_of(imported, "2 of 3 triangles have no area"), "meshes[0].primitives[0]");
    EXPECT_EQ(place_of(imported, "1 of 4 normals are not of unit length"), "meshes[0].primitives[0]");
}

// A triangle with texture coordinates, and an image of one colour that is used as `uses` say.
Result<ImportedScene> with_image(const std::vector<float>& rgb, const Json& material, std::string (*marked)(std::string) = nullptr) {
    std::vector<float> pixels;
    for (int i = 0; i < 16; ++i) pixels.insert(pixels.end(), rgb.begin(), rgb.end());
    const auto png = encode_png(4, 4, pixels);
    if (!png) return png.error();
    std::string bytes(png->begin(), png->end());
    if (marked) bytes = marked(bytes);
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}, {"TEXCOORD_0", b.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2")}}},
            {"material", 0}});
    b.add("images", {{"bufferView", b.buffer_view(bytes)}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", material);
    return import_built(b);
}

const Json as_color{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
const Json as_normals{{"normalTexture", {{"index", 0}}}};

TEST(GltfLint, ImagesUsedAsColourAndData) {
    Json both = as_color;
    both["normalTexture"] = {{"index", 0}};
    EXPECT_EQ(place_of(with_image({0.5f, 0.5f, 1}, both), "as colour for a base colour texture and as data for a normal texture"),
              "images[0]");
    EXPECT_EQ(place_of(with_image({0.5f, 0.5f, 1}, as_color), "as data"), "none");
}

TEST(GltfLint, ImplausibleNormalMaps) {
    EXPECT_EQ(place_of(with_image({0.8f, 0.2f, 0.1f}, as_normals), "does not look like one"), "images[0]");
    EXPECT_EQ(place_of(with_image({0.5f, 0.5f, 1}, as_normals), "does not look like one"), "none");
}

// With an sRGB chunk behind the header, whose checksum is that of the one value written here.
std::string with_srgb_chunk(std::string png) {
    std::string plain;
    for (size_t at = 8; at + 12 <= png.size();) {
        const auto byte = [&](size_t i) { return size_t(uint8_t(png[at + i])); };
        const size_t length = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
        if (png.substr(at + 4, 4) != "sRGB") plain += png.substr(at, 12 + length);
        at += 12 + length;
    }
    constexpr std::string_view chunk("\0\0\0\1sRGB\0\xae\xce\x1c\xe9", 13);
    return png.substr(0, 8) + plain.substr(0, 25) + std::string(chunk) + plain.substr(25);
}
std::string without_srgb_chunk(std::string png) { return with_srgb_chunk(std::move(png)).erase(33, 13); }

TEST(GltfLint, DataMarkedAsSrgb) {
    EXPECT_EQ(place_of(with_image({0.5f, 0.5f, 1}, as_normals, with_srgb_chunk), "marked as sRGB"), "images[0]");
    EXPECT_EQ(place_of(with_image({0.5f, 0.5f, 1}, as_normals, without_srgb_chunk), "marked as sRGB"), "none");
    EXPECT_EQ(place_of(with_image({0.5f, 0.5f, 1}, as_color, with_srgb_chunk), "marked as sRGB"), "none");
}

} // namespace
} // namespace blush::test::TEST_FILE
