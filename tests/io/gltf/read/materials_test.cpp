#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

// The material of a file that has only that one.
Material import_material(Json material, ImportReport* report = nullptr) {
    GltfBuilder b;
    if (material.contains("extensions"))
        for (const auto& [name, extension] : material["extensions"].items()) b.json["extensionsUsed"].push_back(name);
    b.add("materials", std::move(material));
    const auto imported = import_built(b);
    EXPECT_TRUE(imported) << error_text(imported);
    if (!imported) return {};
    if (report) *report = imported->report;
    return imported->scene.materials.begin()->value;
}

TEST(GltfMaterials, AbsentValuesAreGltfDefaults) {
    Material expected;
    expected.name = "Material 0";
    EXPECT_EQ(import_material(Json::object()), expected);
}

TEST(GltfMaterials, CoreFactorsAreRead) {
    const Material m = import_material(
        {{"name", "Paint"},
         {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.6}}},
         {"emissiveFactor", {1, 0.5, 0.25}},
         {"alphaMode", "BLEND"},
         {"doubleSided", true}});
    EXPECT_EQ(m.name, "Paint");
    EXPECT_EQ(m.base_color, (Vec3{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(m.opacity, 0.4f);
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.6f);
    EXPECT_EQ(m.emissive, (Vec3{1, 0.5f, 0.25f}));
    EXPECT_EQ(m.alpha, Material::Alpha::blend);
    EXPECT_TRUE(m.double_sided);
    const Material mask = import_material({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}});
    EXPECT_EQ(mask.alpha, Material::Alpha::mask);
    EXPECT_EQ(mask.alpha_cutoff, 0.25f);
}

TEST(GltfMaterials, ExtensionsAreRead) {
    const Material m = import_material(
        {{"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 17.0}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_specular", {{"specularFactor", 0.0}, {"specularColorFactor", {1.0, 0.5, 0.25}}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
           {"KHR_materials_volume", {{"thicknessFactor", 0.1}, {"attenuationDistance", 2.0}, {"attenuationColor", {0.5, 1.0, 1.0}}}},
           {"KHR_materials_unlit", Json::object()}}}});
    EXPECT_EQ(m.emissive_strength, 17);
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.specular, 0);
    EXPECT_EQ(m.specular_color, (Vec3{1, 0.5f, 0.25f}));
    EXPECT_EQ(m.transmission, 0.9f);
    EXPECT_EQ(m.thickness, 0.1f);
    EXPECT_EQ(m.attenuation_distance, 2);
    EXPECT_EQ(m.attenuation_color, (Vec3{0.5f, 1, 1}));
    EXPECT_TRUE(m.unlit);
}

TEST(GltfMaterials, LayersAreRead) {
    const Material m =
        import_material({{"extensions",
                          {{"KHR_materials_clearcoat",
                            {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.125}, {"clearcoatNormalTexture", {{"scale", 0.5}}}}},
                           {"KHR_materials_sheen", {{"sheenColorFactor", {0.25, 0.5, 1.0}}, {"sheenRoughnessFactor", 0.375}}},
                           {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.625}, {"anisotropyRotation", -1.5}}},
                           {"KHR_materials_iridescence",
                            {{"iridescenceFactor", 0.875},
                             {"iridescenceIor", 1.75},
                             {"iridescenceThicknessMinimum", 150.0},
                             {"iridescenceThicknessMaximum", 550.0}}},
                           {"KHR_materials_dispersion", {{"dispersion", 0.36}}},
                           {"KHR_materials_diffuse_transmission",
                            {{"diffuseTransmissionFactor", 0.0625}, {"diffuseTransmissionColorFactor", {1.0, 0.25, 0.5}}}}}}});
    EXPECT_EQ(m.clearcoat, 0.75f);
    EXPECT_EQ(m.clearcoat_roughness, 0.125f);
    EXPECT_EQ(m.clearcoat_normal_scale, 0.5f);
    EXPECT_EQ(m.sheen_color, (Vec3{0.25f, 0.5f, 1}));
    EXPECT_EQ(m.sheen_roughness, 0.375f);
    EXPECT_EQ(m.anisotropy, 0.625f);
    EXPECT_EQ(m.anisotropy_rotation_radians, -1.5f);
    EXPECT_EQ(m.iridescence, 0.875f);
    EXPECT_EQ(m.iridescence_ior, 1.75f);
    EXPECT_EQ(m.iridescence_thickness_minimum, 150);
    EXPECT_EQ(m.iridescence_thickness_maximum, 550);
    EXPECT_EQ(m.dispersion, 0.36f);
    EXPECT_EQ(m.diffuse_transmission, 0.0625f);
    EXPECT_EQ(m.diffuse_transmission_color, (Vec3{1, 0.25f, 0.5f}));
}

// Reflectance of the archived model: diffuse * (1 - max(specular)) and F0 = specular, at roughness 1 - glossiness.
TEST(GltfMaterials, SpecularGlossinessIsConverted) {
    const Json model = {{"diffuseFactor", {0.5, 0.25, 1.0, 0.75}}, {"specularFactor", {0.25, 0.5, 0.125}}, {"glossinessFactor", 0.75}};
    const Material m = import_material(
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 0}}}}, {"extensions", {{"KHR_materials_pbrSpecularGlossiness", model}}}});
    EXPECT_EQ(m.base_color, (Vec3{0.25f, 0.125f, 0.5f}));
    EXPECT_EQ(m.opacity, 0.75f);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.ior, 1.5f);
    // F0 of index 1.5 is 0.04.
    EXPECT_FLOAT_EQ(m.specular_color.x * 0.04f, 0.25f);
    EXPECT_FLOAT_EQ(m.specular_color.y * 0.04f, 0.5f);
    EXPECT_FLOAT_EQ(m.specular_color.z * 0.04f, 0.125f);
}

TEST(GltfMaterials, ValuesOutOfRangeAreClampedWithAWarning) {
    ImportReport report;
    const Material m = import_material({{"pbrMetallicRoughness", {{"baseColorFactor", {2, -1, 0.5, 1}}, {"roughnessFactor", 1e300}}},
                                        {"doubleSided", true},
                                        {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}},
                                       &report);
    EXPECT_EQ(m.base_color, (Vec3{1, 0, 0.5f}));
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.ior, 1);
    EXPECT_EQ(report.diagnostics.size(), 4u);
}

TEST(GltfMaterials, UnculledBackFacesAreReported) {
    for (const bool double_sided : {false, true}) {
        ImportReport report;
        import_material({{"doubleSided", double_sided}}, &report);
        EXPECT_EQ(reports(report, "back faces of 1 single-sided materials"), !double_sided);
    }
}

TEST(GltfMaterials, ValuesOfTheWrongTypeAreReported) {
    ImportReport report;
    const Material m = import_material(
        {{"extensions",
          {{"KHR_materials_ior", {{"ior", "glass"}}}, {"KHR_materials_transmission", {{"transmissionFactor", Json::array({1})}}}}}},
        &report);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.transmission, 0);
    EXPECT_TRUE(reports(report, "'ior' is not a number"));
    EXPECT_TRUE(reports(report, "'transmissionFactor' is not a number"));
}

TEST(GltfMaterials, ExtensionsAreSortedBySupport) {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_volume", "VENDOR_unheard_of"};
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const ImportReport& report = imported->report;
    EXPECT_EQ(report.extensions_used.size(), 3u);
    EXPECT_EQ(report.extensions_honoured, std::vector<std::string>{"KHR_materials_ior"});
    EXPECT_EQ(report.extensions_approximated, std::vector<std::string>{"KHR_materials_volume"});
    EXPECT_EQ(report.extensions_ignored, std::vector<std::string>{"VENDOR_unheard_of"});
    EXPECT_TRUE(reports(report, "unknown extension"));
}

TEST(GltfMaterials, RequiredExtensionsThatAreNotSupportedAreNamed) {
    GltfBuilder b;
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_animation_pointer"};
    EXPECT_NE(error_text(import_built(b)).find("needs KHR_animation_pointer, which this version cannot read"), std::string::npos);
}

TEST(GltfMaterials, PrimitivesReferToThem) {
    GltfBuilder b;
    b.add("materials", {{"name", "first"}});
    b.add("materials", {{"name", "second"}});
    const int positions = b.triangle_positions();
    b.show({{"attributes", {{"POSITION", positions}}}, {"material", 1}});
    b.show({{"attributes", {{"POSITION", positions}}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Scene& scene = imported->scene;
    EXPECT_EQ(scene.materials.find(scene.meshes.entries()[0].value.parts[0].material)->name, "second");
    EXPECT_FALSE(scene.meshes.entries()[1].value.parts[0].material);
    b.show({{"attributes", {{"POSITION", positions}}}, {"material", 2}});
    EXPECT_NE(error_text(import_built(b)).find("material 2 does not exist"), std::string::npos);
}

} // namespace
} // namespace blush::test::TEST_FILE
