// Preview scene while textures load.
#include "scene/document/preview_scene.h"
#include "scene/texture_slots.h"
#include "scene/validate.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

// No texture has its image.
Scene with_material(const Material& material) {
    test::Sample sample = test::sample_project();
    Scene& scene = sample.project.scene;
    const Table<Texture> textures = scene.textures;
    for (const auto& [id, texture] : textures) {
        Texture missing = texture;
        missing.image = nullptr;
        scene.textures.set(id, missing);
    }
    sample.project.scene.materials.set(sample.red, material);
    return sample.project.scene;
}
Material untextured_of(const Material& material) {
    const test::Sample sample = test::sample_project();
    return *preview_scene(with_material(material)).materials.find(sample.red);
}

TEST(PreviewScene, NoTexturesRemain) {
    const test::Sample sample = test::sample_project();
    Material material;
    for (const TextureSlot& slot : texture_slots) (material.*slot.ref).texture = sample.checker;
    const Scene scene = preview_scene(with_material(material));
    EXPECT_TRUE(scene.textures.empty());
    for (const auto& [id, m] : scene.materials)
        for (const TextureSlot& slot : texture_slots) EXPECT_EQ(m.*slot.ref, TextureRef{}) << slot.name;
    EXPECT_TRUE(validate(scene));
}

TEST(PreviewScene, TexturedColoursAreDimmedAndTexturedMetalIsNone) {
    const test::Sample sample = test::sample_project();
    Material material;
    material.base_color = {1, 0.5f, 0};
    material.emissive = {2, 2, 2};
    material.base_color_texture.texture = material.metallic_roughness_texture.texture = material.emissive_texture.texture = sample.checker;
    const Material shown = untextured_of(material);
    EXPECT_NEAR(shown.base_color.x, 0.214f, 1e-3f);
    EXPECT_NEAR(shown.base_color.y, 0.107f, 1e-3f);
    EXPECT_NEAR(shown.emissive.x, 0.428f, 1e-3f);
    EXPECT_EQ(shown.metallic, 0);
    EXPECT_EQ(shown.roughness, material.roughness);
}

TEST(PreviewScene, TexturesWithAnImageStay) {
    test::Sample sample = test::sample_project();
    Scene& scene = sample.project.scene;
    Material material;
    material.base_color = {1, 0.5f, 0};
    material.base_color_texture.texture = material.normal_texture.texture = sample.checker;
    material.metallic_roughness_texture.texture = scene.textures.add({.name = "later", .source = "", .image = {}});
    scene.materials.set(sample.red, material);
    const Scene shown = preview_scene(scene);
    const Material& m = *shown.materials.find(sample.red);
    EXPECT_EQ(m.base_color, material.base_color);
    EXPECT_EQ(m.base_color_texture, material.base_color_texture);
    EXPECT_EQ(m.normal_texture, material.normal_texture);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.metallic_roughness_texture, TextureRef{});
    EXPECT_EQ(shown.textures.size(), 1u);
    EXPECT_TRUE(validate(shown));
}

TEST(PreviewScene, UntexturedMaterialsAreUnchanged) {
    Material material;
    material.base_color = {0.3f, 0.2f, 0.1f};
    material.emissive = {5, 5, 5};
    material.clearcoat = 0.7f;
    EXPECT_EQ(untextured_of(material), material);
    const Scene scene = with_material(material), shown = preview_scene(scene);
    EXPECT_TRUE(shown.meshes.shares_storage(scene.meshes));
    EXPECT_TRUE(shown.nodes.shares_storage(scene.nodes));
    EXPECT_TRUE(shown.lights.shares_storage(scene.lights));
    EXPECT_EQ(shown.view, scene.view);
}

} // namespace
} // namespace blush::TEST_FILE
