#include "io/image/image_io.h"
#include "scene/texture_slots.h"
#include "tests/io/gltf/builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

std::string file_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// A PNG of 2 x 1 pixels: red, green.
std::string png_bytes() {
    const TempFolder folder;
    const float rgb[] = {1, 0, 0, 0, 1, 0};
    EXPECT_TRUE(write_display_image(folder / "image.png", 2, 1, rgb));
    return file_bytes(folder / "image.png");
}
const std::vector<uint8_t> red_green = {255, 0, 0, 0, 255, 0};

// A material whose base colour is texture 0.
void use_texture(GltfBuilder& b, Json info = Json::object()) {
    info["index"] = 0;
    b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", info}}}});
}
GltfBuilder embedded_texture(const Json& info = Json::object()) {
    GltfBuilder b;
    b.add("images", {{"bufferView", b.buffer_view(png_bytes())}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}});
    use_texture(b, info);
    return b;
}

TEST(GltfTextures, EmbeddedInABufferView) {
    const auto imported = import_built(embedded_texture());
    ASSERT_TRUE(imported) << error_text(imported);
    const Texture& texture = imported->scene.textures.begin()->value;
    EXPECT_EQ(texture.source, "embedded");
    EXPECT_EQ(texture.image->width, 2);
    EXPECT_EQ(texture.image->bytes, red_green);
    EXPECT_EQ(imported->scene.materials.begin()->value.base_color_texture.texture, imported->scene.textures.begin()->id);
}

TEST(GltfTextures, InADataUri) {
    GltfBuilder b;
    b.add("images", {{"uri", "data:image/png;base64," + base64(png_bytes())}});
    b.add("textures", {{"source", 0}});
    use_texture(b);
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    ASSERT_EQ(imported->scene.textures.size(), 1u);
    EXPECT_EQ(imported->scene.textures.begin()->value.image->bytes, red_green);
}

TEST(GltfTextures, BesideTheSceneWithAnEscapedName) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "maps");
    write_bytes(folder / "maps/red green.png", png_bytes());
    GltfBuilder b;
    b.add("images", {{"uri", "maps/red%20green.png"}});
    b.add("textures", {{"source", 0}, {"sampler", 0}});
    b.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    use_texture(b);
    const auto imported = import_text(folder, b.gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    ASSERT_EQ(imported->scene.textures.size(), 1u);
    const Texture& texture = imported->scene.textures.begin()->value;
    EXPECT_EQ(texture.source, "maps/red green.png");
    EXPECT_EQ(texture.image->bytes, red_green);
    EXPECT_EQ(texture.wrap_u, Texture::Wrap::clamp_to_edge);
    EXPECT_EQ(texture.wrap_v, Texture::Wrap::mirrored_repeat);
    EXPECT_EQ(texture.filter, Texture::Filter::nearest);
}

// Two textures by a sampler of these fields.
Result<ImportedScene> with_sampler(const Json& sampler) {
    GltfBuilder b = embedded_texture();
    b.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}, {{"source", 0}, {"sampler", 0}}});
    b.add("samplers", sampler);
    return import_built(b);
}

TEST(GltfTextures, OtherMinificationFiltersAreReportedOncePerSampler) {
    const auto said = [](const Json& sampler, std::string_view part) {
        const auto imported = with_sampler(sampler);
        EXPECT_TRUE(imported) << error_text(imported);
        return std::ranges::count_if(imported->report.diagnostics, [&](const Diagnostic& d) {
            return d.what.find(part) != std::string::npos && d.where == "samplers[0]";
        });
    };
    const std::pair<int, const char*> others[] = {{9728, "NEAREST"},
                                                  {9729, "LINEAR"},
                                                  {9984, "NEAREST_MIPMAP_NEAREST"},
                                                  {9985, "LINEAR_MIPMAP_NEAREST"},
                                                  {9986, "NEAREST_MIPMAP_LINEAR"}};
    for (const auto& [filter, name] : others)
        EXPECT_EQ(said({{"minFilter", filter}}, fmt::format("approximated: minification filter {}:", name)), 1) << name;
    EXPECT_EQ(said({{"minFilter", 9987}, {"magFilter", 9728}}, "filter"), 0) << "the filter that is used";
    EXPECT_EQ(said({{"wrapS", 33071}}, "filter"), 0) << "no filter in the file";
    EXPECT_EQ(said({{"minFilter", 5}}, "unknown minification filter 5"), 1);
    EXPECT_EQ(said({{"magFilter", 9987}}, "unknown magnification filter 9987"), 1);
}

TEST(GltfTextures, TransformAndTexCoordOverride) {
    const Json transform = {{"offset", {0.5, 0.25}}, {"scale", {2.0, 3.0}}, {"rotation", 1.5}, {"texCoord", 1}};
    const auto imported = import_built(embedded_texture({{"texCoord", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}));
    ASSERT_TRUE(imported) << error_text(imported);
    const TextureRef ref = imported->scene.materials.begin()->value.base_color_texture;
    EXPECT_EQ(ref.offset, (Vec2{0.5f, 0.25f}));
    EXPECT_EQ(ref.scale, (Vec2{2, 3}));
    EXPECT_EQ(ref.rotation_radians, 1.5f);
    EXPECT_EQ(ref.uv_set, 1);
}

TEST(GltfTextures, UseAnyUvSet) {
    GltfBuilder b = embedded_texture({{"texCoord", 3}});
    b.add("materials", {{"emissiveTexture", {{"index", 0}, {"texCoord", 70}}}});
    b.add("materials", {{"emissiveTexture", {{"index", 0}, {"texCoord", 256}}}});
    Json attributes = {{"POSITION", b.triangle_positions()}};
    for (const int set : {0, 2, 3}) attributes[fmt::format("TEXCOORD_{}", set)] = b.accessor<float>({0, 0, float(set), 0, 0, 1}, "VEC2");
    b.show({{"attributes", attributes}, {"material", 0}});
    b.show({{"attributes", attributes}, {"material", 1}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Scene& scene = imported->scene;
    EXPECT_EQ(scene.materials.entries()[0].value.base_color_texture.uv_set, 3);
    EXPECT_FALSE(scene.materials.entries()[2].value.emissive_texture.texture);
    const Geometry& g = *scene.meshes.begin()->value.parts[0].geometry;
    ASSERT_EQ(g.uv.size(), 4u);
    EXPECT_EQ(g.uv[3], (GeometryArray<Vec2>{{0, 0}, {3, 0}, {0, 1}}));
    EXPECT_TRUE(g.has_uv_set(0) && !g.has_uv_set(1) && !g.has_uv_set(2)) << "the first two sets and those used by textures are kept";
    EXPECT_TRUE(reports(imported->report, "TEXCOORD_2, which no texture uses"));
    EXPECT_TRUE(reports(imported->report, "TEXCOORD_70, which is missing"));
    EXPECT_TRUE(reports(imported->report, "TEXCOORD_256; UV sets range from 0 to 255"));
}

TEST(GltfTextures, EveryUseOfATextureIsRead) {
    GltfBuilder b = embedded_texture();
    const Json info = {{"index", 0}, {"texCoord", 1}};
    b.json["materials"][0] = {
        {"pbrMetallicRoughness", {{"baseColorTexture", info}, {"metallicRoughnessTexture", info}}},
        {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
        {"occlusionTexture", info},
        {"emissiveTexture", info},
        {"extensions",
         {{"KHR_materials_specular", {{"specularTexture", info}, {"specularColorTexture", info}}},
          {"KHR_materials_transmission", {{"transmissionTexture", info}}},
          {"KHR_materials_clearcoat", {{"clearcoatTexture", info}, {"clearcoatRoughnessTexture", info}, {"clearcoatNormalTexture", info}}},
          {"KHR_materials_sheen", {{"sheenColorTexture", info}, {"sheenRoughnessTexture", info}}},
          {"KHR_materials_anisotropy", {{"anisotropyTexture", info}}},
          {"KHR_materials_iridescence", {{"iridescenceTexture", info}, {"iridescenceThicknessTexture", info}}},
          {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionTexture", info}, {"diffuseTransmissionColorTexture", info}}}}}};
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Material& m = imported->scene.materials.begin()->value;
    for (const TextureSlot& slot : texture_slots) {
        EXPECT_TRUE((m.*slot.ref).texture) << slot.name;
        EXPECT_EQ((m.*slot.ref).uv_set, slot.ref == &Material::normal_texture ? 0 : 1) << slot.name;
    }
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_TRUE(reports(imported->report, "occlusion texture"));
}

TEST(GltfTextures, OfSpecularGlossinessColourEachTexelAndTheMeanOfAlphaIsGlossiness) {
    auto image = std::make_shared<Image>();
    image->width = 2;
    image->height = 1;
    image->channels = 4;
    image->bytes = {255, 0, 0, 51, 0, 255, 0, 153}; // glossiness 0.2 and 0.6
    const auto png = encode_png(*image);
    ASSERT_TRUE(png);
    GltfBuilder b;
    const TempFolder folder;
    write_bytes(folder / "gloss.png", {reinterpret_cast<const char*>(png->data()), png->size()});
    b.add("images", {{"uri", "gloss.png"}});
    b.add("textures", {{"source", 0}});
    const Json map = {{"index", 0}, {"texCoord", 1}};
    b.add("materials", {{"extensions",
                         {{"KHR_materials_pbrSpecularGlossiness",
                           {{"diffuseFactor", {0.5, 0.5, 0.5, 1.0}}, {"diffuseTexture", map}, {"specularGlossinessTexture", map}}}}}});
    const auto imported = import_text(folder, b.gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    const Material& m = imported->scene.materials.begin()->value;
    EXPECT_NEAR(m.roughness, 1 - 0.4, 1e-6);
    EXPECT_EQ(m.base_color, (Vec3{0.5f, 0.5f, 0.5f}));
    for (const TextureRef& ref : {m.base_color_texture, m.specular_color_texture}) {
        EXPECT_TRUE(ref.texture);
        EXPECT_EQ(ref.uv_set, 1);
    }
}

TEST(GltfTextures, MissingAndBrokenImagesAreWarningsAndTheFactorRemains) {
    for (const std::string& bytes : {std::string(), std::string("not an image"), png_bytes().substr(0, 50)}) {
        const TempFolder folder;
        if (!bytes.empty()) write_bytes(folder / "image.png", bytes);
        GltfBuilder b;
        b.add("images", {{"uri", "image.png"}});
        b.add("textures", {{"source", 0}});
        use_texture(b);
        const auto imported = import_text(folder, b.gltf());
        ASSERT_TRUE(imported) << error_text(imported);
        EXPECT_TRUE(imported->scene.textures.empty());
        EXPECT_FALSE(imported->scene.materials.begin()->value.base_color_texture.texture);
        EXPECT_TRUE(reports(imported->report, "image.png"));
    }
}

TEST(GltfTextures, IndicesOutOfRangeAreErrors) {
    GltfBuilder texture = embedded_texture();
    texture.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 5;
    EXPECT_NE(error_text(import_built(texture)).find("texture 5 does not exist"), std::string::npos);
    GltfBuilder image = embedded_texture();
    image.json["textures"][0]["source"] = 5;
    EXPECT_NE(error_text(import_built(image)).find("image 5 does not exist"), std::string::npos);
    GltfBuilder sampler = embedded_texture();
    sampler.json["textures"][0]["sampler"] = 5;
    EXPECT_NE(error_text(import_built(sampler)).find("sampler 5 does not exist"), std::string::npos);
    GltfBuilder view = embedded_texture();
    view.json["bufferViews"][0]["byteOffset"] = 1u << 30;
    EXPECT_NE(error_text(import_built(view)).find("reach beyond the buffer"), std::string::npos);
}

// A triangle with a normal map; `uv` is its TEXCOORD_0, none if empty.
Result<ImportedScene> import_normal_mapped(const std::vector<float>& uv) {
    GltfBuilder b = embedded_texture();
    b.json["materials"][0] = {{"normalTexture", {{"index", 0}}}};
    Json attributes = {{"POSITION", b.triangle_positions()}, {"NORMAL", b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}};
    if (!uv.empty()) attributes["TEXCOORD_0"] = b.accessor<float>(uv, "VEC2");
    b.show({{"attributes", attributes}, {"material", 0}});
    return import_built(b);
}

TEST(GltfTangents, AreComputedForNormalMaps) {
    // u along +X, and v, which grows down the image, along -Y: not mirrored. Then u and v exchanged: mirrored.
    const auto straight = import_normal_mapped({0, 1, 1, 1, 0, 0}), mirrored = import_normal_mapped({1, 0, 1, 1, 0, 0});
    ASSERT_TRUE(straight) << error_text(straight);
    ASSERT_TRUE(mirrored) << error_text(mirrored);
    EXPECT_EQ(straight->scene.meshes.begin()->value.parts[0].geometry->tangents, GeometryArray<Vec4>(3, Vec4{1, 0, 0, 1}));
    EXPECT_EQ(mirrored->scene.meshes.begin()->value.parts[0].geometry->tangents, GeometryArray<Vec4>(3, Vec4{0, -1, 0, -1}));
    EXPECT_TRUE(reports(straight->report, "tangents are missing: computed"));
}

TEST(GltfTangents, DegenerateUvsGiveAPerpendicular) {
    const auto imported = import_normal_mapped({0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
    ASSERT_TRUE(imported) << error_text(imported);
    for (const Vec4& t : imported->scene.meshes.begin()->value.parts[0].geometry->tangents) {
        EXPECT_NEAR(t.x * t.x + t.y * t.y + t.z * t.z, 1, 1e-6);
        EXPECT_EQ(t.z, 0);
        EXPECT_EQ(std::abs(t.w), 1);
    }
    const auto without = import_normal_mapped({});
    ASSERT_TRUE(without) << error_text(without);
    EXPECT_TRUE(reports(without->report, "lacks its texture coordinates"));
}

} // namespace
} // namespace blush::test::TEST_FILE
