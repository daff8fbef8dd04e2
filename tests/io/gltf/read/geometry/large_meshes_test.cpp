// Large meshes: read by all threads and straight into the arena, with the same values and messages as by one thread.
#include "scene/geometry/arena_geometry.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace blush::test::TEST_FILE {
namespace {

constexpr uint32_t side = 640; // 410,881 vertices: loops over them are divided among threads
constexpr size_t vertices = size_t(side + 1) * (side + 1), triangles = 2 * size_t(side) * side;

struct Grid {
    std::vector<float> positions, normals, colors;
    std::vector<uint16_t> uv;
    std::vector<uint32_t> indices;

    Grid() {
        for (uint32_t y = 0; y <= side; ++y)
            for (uint32_t x = 0; x <= side; ++x) {
                positions.insert(positions.end(), {float(x), float(y), float((x * y) % 7)});
                normals.insert(normals.end(), {0, 0, 1});
                colors.insert(colors.end(), {float(x) / side, 0.5f, float(y) / side});
                uv.insert(uv.end(), {uint16_t(x), uint16_t(y)});
            }
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x) {
                const uint32_t i = y * (side + 1) + x, above = i + side + 1;
                indices.insert(indices.end(), {i, i + 1, above, above, i + 1, above + 1});
            }
    }
    Json add_to(GltfBuilder& b, bool with_normals = true) const {
        Json attributes{{"POSITION", b.accessor<float>(positions, "VEC3")},
                        {"TEXCOORD_0", b.accessor<uint16_t>(uv, "VEC2", true)},
                        {"COLOR_0", b.accessor<float>(colors, "VEC3")}};
        if (with_normals) attributes["NORMAL"] = b.accessor<float>(normals, "VEC3");
        return {{"attributes", attributes}, {"indices", b.accessor<uint32_t>(indices, "SCALAR")}};
    }
};

Result<ImportedScene> import_glb(const GltfBuilder& b, unsigned threads = 4) {
    const TempFolder folder;
    ImportOptions options;
    options.threads = threads;
    return import_text(folder, b.glb(), options);
}

const Geometry& only_geometry(const ImportedScene& imported) { return *imported.scene.meshes.begin()->value.parts.at(0).geometry; }

TEST(GltfLargeMeshes, AreReadWholeIntoTheArena) {
    const Grid grid;
    GltfBuilder b;
    b.show(grid.add_to(b));
    for (const unsigned threads : {1u, 4u}) {
        const auto imported = import_glb(b, threads);
        ASSERT_TRUE(imported) << error_text(imported);
        const Geometry& g = only_geometry(*imported);
        EXPECT_TRUE(arena_offsets(g));
        ASSERT_EQ(g.positions.size(), vertices);
        EXPECT_EQ(std::memcmp(g.positions.data(), grid.positions.data(), vertices * sizeof(Vec3)), 0);
        EXPECT_EQ(std::memcmp(g.normals.data(), grid.normals.data(), vertices * sizeof(Vec3)), 0);
        EXPECT_TRUE(std::ranges::equal(g.indices, grid.indices));
        for (size_t i = 0; i < vertices; ++i) {
            ASSERT_EQ(g.colors[i], (Vec4{grid.colors[3 * i], 0.5f, grid.colors[3 * i + 2], 1})) << i;
            ASSERT_EQ(g.uv[0][i], (Vec2{float(grid.uv[2 * i] / 65535.0), float(grid.uv[2 * i + 1] / 65535.0)})) << i;
        }
        EXPECT_TRUE(imported->report.diagnostics.empty());
    }
}

TEST(GltfLargeMeshes, WithoutNormalsHaveEachTriangleForItself) {
    const Grid grid;
    GltfBuilder b;
    b.show(grid.add_to(b, false));
    for (const unsigned threads : {1u, 4u}) {
        const auto imported = import_glb(b, threads);
        ASSERT_TRUE(imported) << error_text(imported);
        const Geometry& g = only_geometry(*imported);
        EXPECT_TRUE(arena_offsets(g));
        EXPECT_TRUE(g.flat);
        ASSERT_EQ(g.positions.size(), 3 * triangles);
        for (size_t i = 0; i < 3 * triangles; ++i) {
            const size_t from = grid.indices[i];
            ASSERT_EQ(g.indices[i], i);
            ASSERT_EQ(std::memcmp(&g.positions[i], &grid.positions[3 * from], sizeof(Vec3)), 0) << i;
            ASSERT_EQ(g.uv[0][i].x, float(grid.uv[2 * from] / 65535.0));
            ASSERT_EQ(g.normals[i], g.normals[i / 3 * 3]);
        }
        EXPECT_EQ(g.normals[0].x, 0); // the first row is level
        EXPECT_EQ(g.normals[0].z, g.normals[0].z);
    }
}

TEST(GltfLargeMeshes, MessagesCountWhatAllThreadsFind) {
    Grid grid;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const size_t i : {size_t(70'000), size_t(200'000), size_t(399'999)}) {
        grid.positions[3 * i] = nan;
        grid.normals[3 * (i + 9) + 2] = 0;  // no length
        grid.normals[3 * (i + 19) + 2] = 2; // not of unit length
        grid.colors[3 * (i + 29)] = nan;
        std::fill_n(grid.indices.begin() + std::ptrdiff_t(3 * i), 3, 5u); // a triangle without area
    }
    GltfBuilder b;
    b.show(grid.add_to(b));
    const auto serial = import_glb(b, 1), parallel = import_glb(b, 4);
    ASSERT_TRUE(serial && parallel) << error_text(serial) << error_text(parallel);
    EXPECT_EQ(serial->report.diagnostics, parallel->report.diagnostics);
    for (const char* part : {"3 non-finite values of COLOR_0", "18 triangles with a NaN", "3 of 819182 triangles have no area",
                             "6 of 410881 normals are not of unit length", "3 zero or non-finite normals"})
        EXPECT_TRUE(reports(parallel->report, part)) << part;
    const Geometry &a = only_geometry(*serial), &c = only_geometry(*parallel);
    EXPECT_EQ(a.positions, c.positions);
    EXPECT_EQ(a.normals, c.normals);
    EXPECT_EQ(a.colors, c.colors);
    EXPECT_EQ(a.indices, c.indices);
}

TEST(GltfLargeMeshes, TheFirstIndexBeyondTheVerticesIsNamed) {
    Grid grid;
    grid.indices[900'000] = 500'001;
    grid.indices[300'000] = 500'000;
    GltfBuilder b;
    b.show(grid.add_to(b));
    EXPECT_NE(error_text(import_glb(b)).find("index 500000 is not below the number of vertices, 410881"), std::string::npos);
}

TEST(GltfLargeMeshes, ArraysOfOtherLengthsAreRefused) {
    for (const size_t count : {vertices - 1, vertices + 1}) {
        Grid grid;
        grid.normals.resize(3 * count, 1);
        GltfBuilder b;
        b.show(grid.add_to(b));
        EXPECT_NE(error_text(import_glb(b)).find("NORMAL has"), std::string::npos) << count;
    }
}

// Triangles that a later step makes or removes: the arrays find a new place.
TEST(GltfLargeMeshes, StripsAreInTheArenaToo) {
    const Grid grid;
    GltfBuilder b;
    Json primitive = grid.add_to(b);
    primitive["mode"] = 5;
    b.show(primitive);
    const auto imported = import_glb(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_TRUE(arena_offsets(only_geometry(*imported)));
    EXPECT_EQ(only_geometry(*imported).triangle_count(), grid.indices.size() - 2);
}

// An accessor without a buffer view is all zeros (glTF 2.0, 3.6.2.3), also where memory was used before.
TEST(GltfLargeMeshes, AccessorsWithoutBytesAreZero) {
    constexpr int count = 3000;
    for (int round = 0; round < 4; ++round) {
        const std::vector<float> used(2 * count, 7.f); // whose memory the import may get
        GltfBuilder b;
        std::vector<float> positions;
        for (int i = 0; i < count; ++i) positions.insert(positions.end(), {float(i), float(i * i % 17), 1});
        const int zeros = b.add("accessors", {{"componentType", 5126}, {"count", count}, {"type", "VEC2"}});
        b.show({{"attributes", {{"POSITION", b.accessor<float>(positions, "VEC3")}, {"TEXCOORD_0", zeros}}}});
        const auto imported = import_glb(b, 1);
        ASSERT_TRUE(imported) << error_text(imported);
        for (const Vec2& uv : only_geometry(*imported).uv.at(0)) ASSERT_EQ(uv, (Vec2{0, 0}));
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
