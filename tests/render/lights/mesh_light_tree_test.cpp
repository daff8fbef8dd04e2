// Trees of emissive meshes: selection has the stated probabilities near, inside and far away from a mesh, and does not depend on
// threads or on the order of edits.
#include "core/math.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/lights/light_tree.h"
#include "render/lights/mesh_lights.h"
#include "shading/light.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/random_numbers.h"

#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

struct Random : RandomNumbers {
    Random() : RandomNumbers(5) {}
};

// Around the sphere of radius 1: `shell` 1 is a mesh like a sphere, 0 a cloud of triangles. Sizes differ by a factor of e^3; every
// seventh has no area.
GeometryPtr triangles(int count, float shell) {
    Random random;
    Geometry g;
    for (int i = 0; i < count; ++i) {
        const Vec3 normal = random.direction(), center = normal * (shell > 0 ? 1 : random(0, 1));
        const Vec3 facing = shell > 0 ? normal : random.direction();
        const Basis<float> basis = basis_around(facing);
        const float size = i % 7 == 3 ? 0 : 0.05f * std::exp(random(-3, 0));
        for (const Vec3& corner : {basis.s, basis.t, -basis.s - basis.t}) {
            g.indices.push_back(uint32_t(g.positions.size()));
            g.positions.push_back(center + corner * size);
        }
    }
    return std::make_shared<const Geometry>(std::move(g));
}

Scene glowing(int count, float shell, bool two_sided = false) {
    Scene scene;
    place(scene, floor_quad(20, -3), lambert(0.5f));
    Material glow = emitter(5);
    glow.double_sided = two_sided;
    place(scene, triangles(count, shell), glow);
    // Beside it some lights that are single.
    Random random;
    for (int i = 0; i < 40; ++i) {
        Light light;
        light.kind = Light::Kind::point;
        light.intensity = random(0.01f, 0.1f);
        place_light(scene, light, at(random.point(4)));
    }
    return scene;
}

struct Compiled {
    RenderScene scene;
    explicit Compiled(const Scene& s, unsigned threads = 1) {
        scene.update(expand_area_lights(s), settings_for(8, 8, 1), full_plan(), Workers(threads));
    }
    const LightTables& lights() const { return scene.tables().lights; }
    int64_t count() const { return scene.info().emissive_triangles + scene.info().point_lights; }
};

float probability(const LightTables& t, const Receiver<float>& to, int64_t light) {
    return light_probability<all_features, float>(t, to, int32_t(light), true);
}
DiscreteSample<float> pick(const LightTables& t, const Receiver<float>& to, uint32_t x, uint32_t y) {
    return pick_light<all_features, float>(t, to, {x, y}, true);
}

// Near, inside, and so far away that the mesh's table by direction is used; every third receives from all sides.
std::vector<Receiver<float>> receivers() {
    Random random;
    std::vector<Receiver<float>> all;
    for (const float distance : {0.3f, 1.05f, 1.5f, 3.f, 6.f, 40.f})
        for (int i = 0; i < 3; ++i) {
            const Vec3 away = random.direction(), lateral = random.direction();
            all.push_back({away * distance, i == 0 ? Vec3{0, 0, 0} : i == 1 ? -away : lateral});
        }
    return all;
}

struct MeshCase {
    const char* name;
    int count;
    float shell;
    bool two_sided;
};
class MeshLightTree : public testing::TestWithParam<MeshCase> {
protected:
    Scene scene() const { return glowing(GetParam().count, GetParam().shell, GetParam().two_sided); }
};

TEST_P(MeshLightTree, SelectsTrianglesWithTheStatedProbability) {
    const Compiled compiled(scene());
    const LightTables& t = compiled.lights();
    ASSERT_FALSE(t.tree.empty());
    Random random;
    const std::vector<Receiver<float>> all = receivers();
    for (size_t r = 0; r < all.size(); ++r) {
        constexpr int64_t samples = 30'000;
        const auto n = size_t(compiled.count());
        // By class, as single triangles are too rare: 64 of them by a hash, and no light.
        constexpr size_t classes = 64;
        std::vector<int64_t> counts(classes + 1);
        std::vector<double> expected(classes + 1);
        const auto class_of = [](size_t light) { return size_t(pcg_hash(uint32_t(light)) % classes); };
        double sum = 0;
        for (size_t i = 0; i < n; ++i) {
            const auto p = double(probability(t, all[r], int64_t(i)));
            expected[class_of(i)] += p * samples;
            sum += p;
        }
        EXPECT_LT(sum, 1 + 1e-5) << r;
        expected[classes] = std::max(0.0, 1 - sum) * samples;
        Moments rest;
        for (int64_t i = 0; i < samples; ++i) {
            const auto one = pick(t, all[r], uint32_t(random.bits()), uint32_t(random.bits()));
            ++counts[one.probability > 0 ? class_of(size_t(one.index)) : classes];
            if (!(one.probability > 0)) continue;
            rest.add(double(one.remainder));
            ASSERT_NEAR(one.probability, probability(t, all[r], one.index), 2e-6 * one.probability) << r;
        }
        EXPECT_TRUE(chi_squared_test(counts, expected, sidak(significance, 2 * int64_t(all.size())))) << r;
        if (rest.count > 0) {
            EXPECT_TRUE(z_test(rest, 0.5, sidak(significance, 2 * int64_t(all.size())))) << r << ": the remainder is uniform";
        }
    }
}

TEST_P(MeshLightTree, GivesEveryContributingTriangleAProbability) {
    const Compiled compiled(scene());
    const LightTables& t = compiled.lights();
    int64_t asked = 0;
    for (const Receiver<float>& to : receivers())
        for (int64_t i = 0; i < compiled.scene.info().emissive_triangles; ++i) {
            const LightRecord& light = t.lights[i];
            const Vec3 normal = cross(light.edge1, light.edge2);
            bool contributes = false;
            for (const Vec3& point : {Vec3{0, 0, 0}, light.edge1, light.edge2, (light.edge1 + light.edge2) * (1.f / 3)}) {
                const Vec3 way = light.position + point - to.position, wi = way / length(way);
                const float receives = dot(to.normal, to.normal) > 0 ? dot(wi, to.normal) : 1, cosine = -dot(wi, normal) / length(normal);
                contributes |= receives > 1e-3f && (light.flags & light_two_sided ? std::abs(cosine) : cosine) > 1e-3f;
            }
            if (!contributes || !(light.inverse_area > 0)) continue;
            ++asked;
            ASSERT_GT(probability(t, to, i), 0) << "triangle " << i;
        }
    EXPECT_GT(asked, 500);
}

TEST_P(MeshLightTree, NeverSelectsTrianglesWithoutArea) {
    const Compiled compiled(scene());
    const LightTables& t = compiled.lights();
    for (const Receiver<float>& to : receivers()) {
        for (const uint32_t x : {0u, 1u, 0x7fffffffu, 0xfffffeffu, 0xffffffffu})
            for (const uint32_t y : {0u, 0x12345678u, 0xffffffffu}) {
                const auto one = pick(t, to, x, y);
                if (!(one.probability > 0)) continue;
                ASSERT_TRUE(t.lights[one.index].kind != int32_t(LightKind::triangle) || t.lights[one.index].inverse_area > 0);
                ASSERT_GE(one.remainder, 0);
                ASSERT_LT(one.remainder, 1);
            }
        for (int64_t i = 0; i < compiled.scene.info().emissive_triangles; ++i)
            if (!(t.lights[i].inverse_area > 0)) { ASSERT_EQ(probability(t, to, i), 0); }
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, MeshLightTree,
                         testing::Values(MeshCase{"Small", 200, 1, false}, MeshCase{"SmallWithPatches", 600, 1, false},
                                         MeshCase{"Sphere", 3000, 1, false}, MeshCase{"Cloud", 3000, 0, false},
                                         MeshCase{"TwoSidedCloud", 3000, 0, true}),
                         [](const auto& mesh) { return mesh.param.name; });

// Where a mesh fills the view, all lights together have probability 1: nothing is lost on the way.
TEST(MeshLightTrees, ProbabilitiesAddUpToOneWhereEverythingIsLit) {
    const Compiled compiled(glowing(2000, 0, true));
    for (const float distance : {0.f, 2.f, 20.f}) {
        double sum = 0;
        for (int64_t i = 0; i < compiled.count(); ++i) sum += double(probability(compiled.lights(), {{distance, 0, 0}, {0, 0, 0}}, i));
        EXPECT_NEAR(sum, 1, 1e-5) << distance;
    }
}

// The table by direction takes 64 KiB, so small meshes do without.
TEST(MeshLightTrees, HaveATableForDistantReceiversFrom256TrianglesOn) {
    const auto has_table = [](int count) {
        const Compiled compiled(glowing(count, 1));
        const LightTree& tree = compiled.lights().tree;
        return tree.meshes[tree.entries[~compiled.lights().lights[0].slot].mesh].has_patches != 0;
    };
    EXPECT_FALSE(has_table(250));
    EXPECT_TRUE(has_table(400));
}

// A ball sends no light to its own surface. Bounded by its box alone it would seem to: the box's corners are above the horizon.
TEST(MeshLightTrees, LeaveTheSurfaceOfABallToOtherLights) {
    Scene scene;
    place(scene, sphere(false), emitter(1), at({0, 0, 0}, 1));
    Random random;
    Light light;
    light.kind = Light::Kind::point;
    light.intensity = 0.01f;
    place_light(scene, light, at({0, 4, 0}));
    const Compiled compiled(scene);
    const LightTables& t = compiled.lights();
    ASSERT_FALSE(t.tree.empty());
    const int64_t bulb = compiled.scene.info().emissive_triangles;
    ASSERT_EQ(t.lights[bulb].kind, int32_t(LightKind::point));
    for (int i = 0; i < 1000; ++i) {
        const Vec3 normal = random.direction();
        if (normal.y < 0.5f) continue; // the bulb is well above the horizon
        EXPECT_GT(probability(t, {normal, normal}, bulb), 0.5f) << normal.x << ' ' << normal.y << ' ' << normal.z;
    }
}

TEST(MeshLightTrees, HaveAMillionTriangles) {
    constexpr int count = 1'000'000;
    const Compiled compiled(glowing(count, 1), 2);
    const LightTables& t = compiled.lights();
    ASSERT_FALSE(t.tree.empty());
    EXPECT_EQ(compiled.scene.info().emissive_triangles, count);
    Random random;
    int64_t found = 0; // receivers that look away from the mesh find few lights
    for (const Receiver<float>& to : receivers())
        for (int i = 0; i < 1000; ++i) {
            const auto one = pick(t, to, uint32_t(random.bits()), uint32_t(random.bits()));
            if (!(one.probability > 0)) continue;
            ++found;
            ASSERT_NEAR(one.probability, probability(t, to, one.index), 2e-6 * one.probability);
        }
    EXPECT_GT(found, 8000);
}

// Bit by bit.
void expect_same_selection(const Compiled& a, const Compiled& b) {
    ASSERT_EQ(a.count(), b.count());
    for (const Receiver<float>& to : receivers())
        for (int64_t i = 0; i < a.count(); i += 5) ASSERT_EQ(probability(a.lights(), to, i), probability(b.lights(), to, i)) << i;
}

TEST(MeshLightTrees, DoNotDependOnTheNumberOfThreads) {
    const Scene scene = glowing(9000, 1);
    expect_same_selection(Compiled(scene, 1), Compiled(scene, 3));
}

const void* tree_of(const Compiled& compiled, int64_t light) {
    const LightTree& tree = compiled.lights().tree;
    return tree.meshes[tree.entries[~compiled.lights().lights[light].slot].mesh].nodes;
}

// Edits of the emission keep the tree of the mesh, a move does not; the selection is that of a fresh start.
TEST(MeshLightTrees, AreReusedAfterEditsOfTheEmission) {
    const Scene first = glowing(4000, 1);
    const Id<Material> glow = std::ranges::find_if(first.materials, [](const auto& m) { return m.value.emissive.x > 0; })->id;
    Compiled compiled(first);
    const void* tree = tree_of(compiled, 0);
    Scene edited = first;
    Material stronger = *first.materials.find(glow);
    stronger.emissive_strength *= 3;
    stronger.emissive = {0.2f, 1, 0.3f};
    edited.materials.set(glow, stronger);
    UpdatePlan plan;
    plan.lights = plan.features = true;
    plan.materials = {glow};
    compiled.scene.update(expand_area_lights(edited), settings_for(8, 8, 1), plan, Workers(1));
    EXPECT_EQ(tree_of(compiled, 0), tree);
    expect_same_selection(compiled, Compiled(edited));

    const Id<Node> body = std::ranges::find_if(edited.nodes, [&](const auto& n) {
                              return n.value.mesh && edited.meshes.find(n.value.mesh)->parts[0].material == glow;
                          })->id;
    Node moved = *edited.nodes.find(body);
    moved.local.translation.x += 0.25f;
    edited.nodes.set(body, moved);
    UpdatePlan move;
    move.transforms = move.lights = move.features = true;
    compiled.scene.update(expand_area_lights(edited), settings_for(8, 8, 1), move, Workers(1));
    expect_same_selection(compiled, Compiled(edited));
}

} // namespace
} // namespace blush::test::TEST_FILE
