// Textures of materials: one undo step, saved with the scene, and thumbnails.
#include "core/files.h"
#include "io/gltf/read/import.h"
#include "io/gltf/write/save.h"
#include "io/image/image_io.h"
#include "tests/support/process.h"
#include "ui/jobs/map_thumbnails.h"
#include "ui/jobs/material_maps.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

ImagePtr checks(int width, int height, int channels = 3) {
    auto image = std::make_shared<Image>();
    image->width = width, image->height = height, image->channels = channels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) image->bytes.push_back(uint8_t((x + y) % 2 ? 250 - c : 10));
    return image;
}

Document opened() {
    const auto imported = import_gltf(std::filesystem::path(BLUSH_ASSETS) / "scenes" / "card-and-mug.gltf");
    EXPECT_TRUE(imported);
    return Document(Project{imported->scene, {}, {}});
}

const Material& first_material(const Document& d) { return d.project().scene.materials.begin()->value; }

TEST(Maps, SettingATextureIsOneUndoStep) {
    Document d = opened();
    const Id<Material> id = d.project().scene.materials.begin()->id;
    const size_t textures = d.project().scene.textures.size();
    ASSERT_TRUE(set_map(d, id, &Material::metallic_roughness_texture, "Metal-rough map",
                        {.name = "checks", .source = "embedded", .image = checks(4, 2)}, 1));
    EXPECT_EQ(d.undo_labels(), std::vector<std::string>{"Load Metal-rough map"});
    const Texture* texture = d.project().scene.textures.find(first_material(d).metallic_roughness_texture.texture);
    ASSERT_TRUE(texture);
    EXPECT_EQ(texture->image->width, 4);
    d.undo();
    EXPECT_FALSE(first_material(d).metallic_roughness_texture.texture);
    EXPECT_EQ(d.project().scene.textures.size(), textures);
}

TEST(Maps, ReplacingKeepsTheUvTransform) {
    Document d = opened();
    const Id<Material> id = d.project().scene.materials.begin()->id;
    Material m = first_material(d);
    m.base_color_texture.scale = {3, 4};
    ASSERT_TRUE(d.apply(SetMaterial{id, m}));
    ASSERT_TRUE(
        set_map(d, id, &Material::base_color_texture, "Base colour map", {.name = "a", .source = "embedded", .image = checks(2, 2)}, 1));
    ASSERT_TRUE(
        set_map(d, id, &Material::base_color_texture, "Base colour map", {.name = "b", .source = "embedded", .image = checks(8, 8)}, 2));
    const TextureRef& ref = first_material(d).base_color_texture;
    EXPECT_EQ(ref.scale, (Vec2{3, 4}));
    EXPECT_EQ(d.project().scene.textures.find(ref.texture)->name, "b");
    EXPECT_FALSE(set_map(d, Id<Material>{9999}, &Material::base_color_texture, "Base colour map",
                         {.name = "c", .source = "embedded", .image = checks(2, 2)}, 3));
}

TEST(Maps, SurviveSaveAndLoad) {
    const test::TemporaryFolder folder;
    const auto imported = import_gltf(std::filesystem::path(BLUSH_ASSETS) / "scenes" / "card-and-mug.gltf");
    ASSERT_TRUE(imported);
    Document d(Project{imported->scene, {}, {}});
    const Id<Material> id = d.project().scene.materials.begin()->id;
    const ImagePtr image = checks(6, 5);
    for (const auto slot : {&Material::base_color_texture, &Material::normal_texture, &Material::emissive_texture})
        ASSERT_TRUE(set_map(d, id, slot, "map", {.name = "checks", .source = "embedded", .image = image}, 1));
    for (const char* name : {"saved.gltf", "saved.glb"}) {
        const auto saved = save_gltf(imported->origin, d.project(), folder / name);
        ASSERT_TRUE(saved) << saved.error().text();
        const auto again = import_gltf(folder / name);
        ASSERT_TRUE(again) << again.error().text();
        const Material& m = again->scene.materials.begin()->value;
        for (const auto slot : {&Material::base_color_texture, &Material::normal_texture, &Material::emissive_texture}) {
            const Texture* texture = again->scene.textures.find((m.*slot).texture);
            ASSERT_TRUE(texture && texture->image);
            EXPECT_EQ(texture->image->bytes, image->bytes);
        }
        EXPECT_FALSE(m.metallic_roughness_texture.texture);
    }
}

TEST(Maps, InvalidImagesAreErrors) {
    const test::TemporaryFolder folder;
    const auto refused = [&](const char* name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        EXPECT_FALSE(read_image(folder / name)) << name;
    };
    const auto png = encode_png(*checks(64, 64));
    ASSERT_TRUE(png);
    const std::string whole(png->begin(), png->end());
    refused("empty.png", "");
    refused("text.png", "no image");
    refused("cut.png", whole.substr(0, whole.size() / 2));
    std::string huge = whole;
    huge.replace(16, 8, std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff", 8)); // width and height in its header
    refused("huge.png", huge);
    EXPECT_FALSE(read_image(folder / "missing.png"));
}

TEST(MapPreview, AveragesThePixels) {
    const SmallImage small = small_image(*checks(2048, 1024));
    EXPECT_EQ(small.width, map_preview_side);
    EXPECT_EQ(small.height, map_preview_side / 2);
    EXPECT_NEAR(small.rgb[0], 130, 1);
    const SmallImage same = small_image(*checks(3, 2, 1));
    EXPECT_EQ(same.width, 3);
    EXPECT_EQ(same.rgb[0], 10);
    EXPECT_EQ(same.rgb[3], 250);
    EXPECT_EQ(same.rgb[5], 250) << "one channel is grey";
    EXPECT_TRUE(small_image({}).rgb.empty());
    Image wild;
    wild.width = wild.height = 1, wild.channels = 3, wild.floats = {NAN, -5.f, 1e30f};
    EXPECT_EQ(small_image(wild).rgb, (std::vector<uint8_t>{0, 0, 255}));
}

} // namespace
} // namespace blush::TEST_FILE
