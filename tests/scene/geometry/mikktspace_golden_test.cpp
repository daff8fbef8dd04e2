// Against what the reference code of MikkTSpace makes of the same meshes (tests/golden/mikktspace; generate.js there says how).
//
// Where the reference has no tangent it leaves its initial value, (1, 0, 0), whatever the normal, or a vector of no length. There we differ
// on purpose, and have a perpendicular of the normal.
#include "core/math.h"
#include "scene/geometry/mikktspace.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>

namespace blush::test::TEST_FILE {
namespace {

struct Golden {
    Geometry geometry;
    std::vector<Vec4> tangents; // by corner, w as in glTF
};

template <class V> GeometryArray<V> vectors(const nlohmann::json& numbers) {
    static_assert(sizeof(V) % sizeof(float) == 0);
    const auto flat = numbers.get<std::vector<float>>();
    GeometryArray<V> values(flat.size() * sizeof(float) / sizeof(V));
    std::memcpy(values.data(), flat.data(), values.size() * sizeof(V));
    return values;
}

Golden golden(const std::string& name) {
    std::ifstream file(std::filesystem::path(BLUSH_TESTS) / "golden/mikktspace" / (name + ".json"));
    const auto json = nlohmann::json::parse(file);
    Golden made;
    made.geometry.positions = vectors<Vec3>(json["positions"]);
    made.geometry.normals = vectors<Vec3>(json["normals"]);
    made.geometry.uv = {vectors<Vec2>(json["uvs"])};
    const auto indices = json["indices"].get<std::vector<uint32_t>>();
    made.geometry.indices.assign(indices.begin(), indices.end());
    const GeometryArray<Vec4> tangents = vectors<Vec4>(json["tangents"]);
    made.tangents.assign(tangents.begin(), tangents.end());
    for (Vec4& t : made.tangents) t.w = -t.w; // there v points down
    return made;
}

struct Mesh {
    const char* name;
    size_t corners, without; // of these, corners that have no tangent there
};

void PrintTo(const Mesh& mesh, std::ostream* out) { *out << mesh.name; }

class MikktspaceGolden : public testing::TestWithParam<Mesh> {};

TEST_P(MikktspaceGolden, TangentsAreThoseOfTheReference) {
    const auto [geometry, expected] = golden(GetParam().name);
    ASSERT_EQ(expected.size(), GetParam().corners);
    const std::vector<Vec4> made = mikktspace_tangents(geometry, geometry.uv[0]);
    ASSERT_EQ(made.size(), expected.size());
    size_t without = 0;
    for (size_t i = 0; i < made.size(); ++i) {
        const Vec3 t{made[i].x, made[i].y, made[i].z}, there{expected[i].x, expected[i].y, expected[i].z};
        ASSERT_NEAR(length(t), 1, 1e-5) << "corner " << i;
        ASSERT_NEAR(dot(t, geometry.normals[geometry.indices[i]]), 0, 1e-5) << "corner " << i;
        if (there == Vec3{1, 0, 0} || there == Vec3{0, 0, 0}) {
            ++without;
            continue;
        }
        EXPECT_LT(length(t - there), 1e-3) << "corner " << i << ": " << t.x << " " << t.y << " " << t.z << " there " << there.x << " "
                                           << there.y << " " << there.z;
        EXPECT_EQ(made[i].w, expected[i].w) << "corner " << i;
    }
    EXPECT_EQ(without, GetParam().without);
}

INSTANTIATE_TEST_SUITE_P(Meshes, MikktspaceGolden,
                         testing::Values(Mesh{"sphere", 432, 2}, Mesh{"mirrored", 144, 0}, Mesh{"diagonals", 216, 0},
                                         Mesh{"degenerate", 234, 91}, Mesh{"noisy", 456, 0}, Mesh{"folded", 36, 0}),
                         [](const auto& mesh) { return std::string(mesh.param.name); });

} // namespace
} // namespace blush::test::TEST_FILE
