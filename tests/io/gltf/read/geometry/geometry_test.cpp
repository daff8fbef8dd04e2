#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blush::test::TEST_FILE {
namespace {

const Geometry& only_geometry(const Scene& scene) { return *scene.meshes.begin()->value.parts.at(0).geometry; }

// Face normal by winding.
Vec3 winding(const Geometry& g, size_t t) {
    const Vec3 a = g.positions[g.indices[3 * t]], b = g.positions[g.indices[3 * t + 1]], c = g.positions[g.indices[3 * t + 2]];
    const Vec3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

// A unit square in the XY plane as four vertices with normals, in strip order.
Json square_attributes(GltfBuilder& b) {
    return {{"POSITION", b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3")},
            {"NORMAL", b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}};
}

TEST(GltfGeometry, NonIndexedTriangleGetsFlatNormals) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Geometry& g = only_geometry(imported->scene);
    EXPECT_EQ(g.indices, (GeometryArray<uint32_t>{0, 1, 2}));
    EXPECT_EQ(g.normals, GeometryArray<Vec3>(3, Vec3{0, 0, 1}));
    EXPECT_TRUE(imported->report.diagnostics.empty());
}

TEST(GltfGeometry, SharedVerticesWithoutNormalsAreSplitSoThatEachFaceIsFlat) {
    GltfBuilder b;
    const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    b.show({{"attributes", {{"POSITION", positions}}}, {"indices", b.accessor<uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR")}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Geometry& g = only_geometry(imported->scene);
    ASSERT_EQ(g.positions.size(), 6u);
    EXPECT_EQ(g.normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(g.normals[3], (Vec3{1, 0, 0}));
}

template <class T> class GltfIndexWidth : public testing::Test {};
using IndexWidths = testing::Types<uint8_t, uint16_t, uint32_t>;
TYPED_TEST_SUITE(GltfIndexWidth, IndexWidths);
TYPED_TEST(GltfIndexWidth, IsRead) {
    GltfBuilder b;
    const Json attributes = square_attributes(b);
    b.show({{"attributes", attributes}, {"indices", b.accessor<TypeParam>({0, 1, 2, 2, 1, 3}, "SCALAR")}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(only_geometry(imported->scene).indices, (GeometryArray<uint32_t>{0, 1, 2, 2, 1, 3}));
}

TEST(GltfGeometry, StripsAndFansKeepTheirWinding) {
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        Json primitive = {{"attributes", square_attributes(b)}, {"mode", mode}};
        if (mode == 6) primitive["indices"] = b.accessor<uint16_t>({0, 1, 3, 2}, "SCALAR");
        b.show(primitive);
        const auto imported = import_built(b);
        ASSERT_TRUE(imported) << error_text(imported);
        const Geometry& g = only_geometry(imported->scene);
        ASSERT_EQ(g.triangle_count(), 2u);
        EXPECT_EQ(winding(g, 0), (Vec3{0, 0, 1})) << "mode " << mode;
        EXPECT_EQ(winding(g, 1), (Vec3{0, 0, 1})) << "mode " << mode;
    }
}

TEST(GltfGeometry, IntegerTextureCoordinatesAndColorsAreNormalised) {
    GltfBuilder b;
    const Json attributes = {{"POSITION", b.triangle_positions()},
                             {"NORMAL", b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                             {"TEXCOORD_0", b.accessor<uint8_t>({0, 255, 255, 0, 51, 102}, "VEC2", true)},
                             {"TEXCOORD_1", b.accessor<uint16_t>({0, 65535, 65535, 0, 13107, 0}, "VEC2", true)},
                             {"COLOR_0", b.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3")}};
    b.show({{"attributes", attributes}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Geometry& g = only_geometry(imported->scene);
    ASSERT_EQ(g.uv.size(), 2u);
    EXPECT_EQ(g.uv[0], (GeometryArray<Vec2>{{0, 1}, {1, 0}, {0.2f, 0.4f}}));
    EXPECT_EQ(g.uv[1], (GeometryArray<Vec2>{{0, 1}, {1, 0}, {0.2f, 0}}));
    EXPECT_EQ(g.colors, (GeometryArray<Vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}}));
}

TEST(GltfGeometry, QuantisedPositionsAreRead) {
    GltfBuilder b;
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    b.show({{"attributes", {{"POSITION", b.accessor<int16_t>({0, 0, 0, 7, 0, 0, 0, -3, 0}, "VEC3")}}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(only_geometry(imported->scene).positions, (GeometryArray<Vec3>{{0, 0, 0}, {7, 0, 0}, {0, -3, 0}}));
}

TEST(GltfGeometry, SparseValuesReplaceDenseOnes) {
    GltfBuilder b;
    const int positions = b.triangle_positions();
    const uint8_t index = 2;
    const float value[3] = {5, 6, 7};
    const int indices = b.buffer_view({reinterpret_cast<const char*>(&index), 1});
    const int values = b.buffer_view({reinterpret_cast<const char*>(value), sizeof value});
    b.json["accessors"][size_t(positions)]["sparse"] = {
        {"count", 1}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
    b.show({{"attributes", {{"POSITION", positions}}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(only_geometry(imported->scene).positions, (GeometryArray<Vec3>{{0, 0, 0}, {1, 0, 0}, {5, 6, 7}}));
}

TEST(GltfGeometry, InterleavedAttributesAreReadByStride) {
    GltfBuilder b;
    const std::vector<float> interleaved = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1};
    const int view = b.buffer_view({reinterpret_cast<const char*>(interleaved.data()), interleaved.size() * sizeof(float)});
    b.json["bufferViews"][size_t(view)]["byteStride"] = 24;
    const int positions = b.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    const int normals =
        b.add("accessors", {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    b.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(only_geometry(imported->scene).positions[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(only_geometry(imported->scene).normals[2], (Vec3{0, 0, 1}));
}

TEST(GltfGeometry, NodesOfOneMeshShareItsGeometry) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    b.add("nodes", {{"mesh", 0}, {"translation", {3, 0, 0}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Scene& scene = imported->scene;
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes.entries()[0].value.mesh, scene.nodes.entries()[1].value.mesh);
}

TEST(GltfGeometry, TrianglesWithNonFiniteCornersAreLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    GltfBuilder b;
    const int positions = b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 0, infinity, 0}, "VEC3");
    b.show({{"attributes", {{"POSITION", positions}}}, {"indices", b.accessor<uint8_t>({0, 1, 2, 0, 1, 3, 0, 1, 4}, "SCALAR")}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(only_geometry(imported->scene).triangle_count(), 1u);
    EXPECT_TRUE(reports(imported->report, "2 triangles with a NaN"));
    for (const Vec3& p : only_geometry(imported->scene).positions) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
}

TEST(GltfGeometry, ZeroNormalsAreRepaired) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}, {"NORMAL", b.accessor<float>({0, 0, 0, 0, 0, 1, 0, 0, 1}, "VEC3")}}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(only_geometry(imported->scene).normals[0], (Vec3{0, 0, 1}));
    EXPECT_TRUE(reports(imported->report, "zero or non-finite normals replaced"));
}

TEST(GltfGeometry, UnknownAttributesAreReported) {
    GltfBuilder b;
    const int positions = b.triangle_positions();
    b.show({{"attributes", {{"POSITION", positions}, {"_HEAT", positions}}}, {"targets", Json::array({Json{{"TEXCOORD_0", positions}}})}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_TRUE(reports(imported->report, "attribute _HEAT"));
    EXPECT_TRUE(reports(imported->report, "TEXCOORD_0 of a morph target"));
}

} // namespace
} // namespace blush::test::TEST_FILE
