// Clearance boxes hold an emissive mesh and nothing else, and edits find the boxes of a fresh start.
#include "render/lights/lamp_clearance.h"

#include "core/math.h"
#include "render/integrator/light_sampling.h"
#include "tests/render/lights/lamp_rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

bool same_boxes(const CompiledLamps& a, const CompiledLamps& b) {
    const std::vector<ClearanceBox> x = a.boxes(), y = b.boxes();
    const bool none = !a.scene.tables().lights.clearances;
    return none == !b.scene.tables().lights.clearances && x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
}

Scene ball_in_room(float radius = 0.6f) {
    Scene scene = room();
    place(scene, sphere(false), glow(), at({0, 0, 0}, radius));
    return scene;
}

TEST(LampClearance, BoxesHoldTheLampAndShadowRaysEndAtThem) {
    Scene scene = ball_in_room();
    const CompiledLamps compiled(scene);
    ASSERT_EQ(compiled.clear(), std::vector<bool>{true});
    const LightTables& t = compiled.scene.tables().lights;
    const ClearanceBox box = t.clearances[0];
    EXPECT_EQ(compiled.numbered_records(), compiled.scene.info().emissive_triangles);
    const auto inside = [&](const Vec3& p, float slack) {
        return p.x > box.low.x - slack && p.y > box.low.y - slack && p.z > box.low.z - slack && p.x < box.high.x + slack &&
               p.y < box.high.y + slack && p.z < box.high.z + slack;
    };
    std::mt19937 bits(3);
    const auto random = [&](float low, float high) { return low + (high - low) * float(bits() >> 8) * 0x1p-24f; };
    int64_t shortened = 0, kept = 0;
    for (int i = 0; i < 20000; ++i) {
        const LightRecord& light = t.lights[bits() % uint32_t(t.count)];
        const Vec3 on = light.position + (light.edge1 + light.edge2) * 0.3f;
        ASSERT_TRUE(inside(on, 0));
        const float reach = i % 3 ? 4.f : i % 2 ? 0.7f : 1e4f;
        const Vec3 from{random(-reach, reach), random(-reach, reach), random(-reach, reach)};
        const float distance = length(on - from);
        const Vec3 along = (on - from) / distance;
        const float end = distance_before_lamp<float>(t, int32_t(&light - t.lights), from, along, distance, true);
        ASSERT_LE(end, distance);
        EXPECT_EQ(distance_before_lamp<float>(t, int32_t(&light - t.lights), from, along, distance, false), distance) << "its back side";
        if (inside(from, 0)) {
            ++kept;
            EXPECT_EQ(end, distance);
            continue;
        }
        ++shortened;
        if (reach < 10) { EXPECT_GT(distance - end, 0.02f * 0.6f) << "the lamp is left out"; }
        const float slack = 4e-6f * reach;
        EXPECT_TRUE(inside(from + along * end, slack));
        EXPECT_FALSE(inside(from + along * (end - 2 * slack), 0)) << "ends where it enters";
    }
    EXPECT_GT(shortened, 10000);
    EXPECT_GT(kept, 500);
}

TEST(LampClearance, FewTrianglesAreaLightsAndBsdfSamplingHaveNone) {
    Scene scene = room();
    place(scene, cube(false), glow(), at({0, 0, 0}, 0.3f));
    Light disk;
    disk.kind = Light::Kind::disk;
    disk.radius = 0.3f;
    place_light(scene, disk, aimed({1.5f, 2, 0}, {0, -1, 0}));
    EXPECT_EQ(CompiledLamps(scene).numbered_records(), 0);

    const CompiledLamps compiled(ball_in_room());
    RenderSettings bsdf = compiled.settings;
    bsdf.strategy = Strategy::bsdf;
    RenderScene other;
    other.update(compiled.expanded, bsdf, full_plan(), compiled.workers);
    EXPECT_EQ(other.tables().lights.clearances, nullptr);
}

struct BlockerCase {
    const char* name;
    std::function<void(Scene&)> add;
    bool clear;
};
constexpr float r = 0.6f; // of the ball at the origin
const BlockerCase blocker_cases[]{
    {"NothingNear", [](Scene&) {}, true},
    {"SheetThatTouches", [](Scene& s) { place(s, floor_quad(2, -r), lambert(0.5f)); }, false},
    {"SheetThatNearlyTouches", [](Scene& s) { place(s, floor_quad(2, -1.01f * r), lambert(0.5f)); }, false},
    {"SheetBelow", [](Scene& s) { place(s, floor_quad(2, -1.2f * r), lambert(0.5f)); }, true},
    {"SlantedSheetAtACorner", // of the box, not of the ball
     [](Scene& s) {
         place(s, quad({1, -2, 0}, {1, 2, 0}, {-0.1f, 2, 1.1f}, {-0.1f, -2, 1.1f}), lambert(0.5f));
     },
     false},
    {"SlantedSheetBesideACorner",
     [](Scene& s) {
         place(s, quad({1.4f, -2, 0}, {1.4f, 2, 0}, {0, 2, 1.4f}, {0, -2, 1.4f}), lambert(0.5f));
     },
     true},
    {"SmallThingWithin",
     [](Scene& s) {
         place(s, cube(false), lambert(0.5f), at({0, 0, 0}, 0.01f));
     },
     false},
    {"Enclosure",
     [](Scene& s) {
         place(s, cube(false), lambert(0.5f), at({0, 0, 0}, 1.f));
     },
     true},
    {"CopyFarAwayAndCopyThatTouches",
     [](Scene& s) {
         const Id<Mesh> shared = s.meshes.add({"", {{sphere(false), s.materials.add(lambert(0.5f))}}});
         for (const Vec3& where : {Vec3{3, 0, 0}, Vec3{0.9f, 0, 0}}) {
             Node node;
             node.mesh = shared;
             node.local = stretched(where, {0.5f, 0.4f, 0.3f});
             s.nodes.add(node);
         }
     },
     false},
    {"SmallCopyThatTouches", // scaled evenly
     [](Scene& s) {
         const Id<Mesh> shared = s.meshes.add({"", {{sphere(false), s.materials.add(lambert(0.5f))}}});
         for (const float x : {3.f, 0.65f}) {
             Node node;
             node.mesh = shared;
             node.local = at({x, 0, 0}, 0.1f);
             s.nodes.add(node);
         }
     },
     false},
    {"SecondOfManyPlacesThatTouches",
     [](Scene& s) {
         auto places = std::make_shared<Instances>();
         for (const float x : {3.f, 0.65f, 5.f}) places->node_from_copy.push_back({{0.1f, 0, 0}, {0, 0.1f, 0}, {0, 0, 0.1f}, {x, 0, 0}});
         Node node;
         node.mesh = s.meshes.add({"", {{sphere(false), s.materials.add(lambert(0.5f))}}});
         node.instances = std::move(places);
         s.nodes.add(node);
     },
     false},
    {"CopyAtACorner", // its bounds touch the box, but not itself
     [](Scene& s) {
         const Id<Mesh> shared = s.meshes.add({"", {{sphere(false), s.materials.add(lambert(0.5f))}}});
         for (const Vec3& where : {Vec3{3, 0, 0}, Vec3{r + 0.25f, r + 0.25f, 0}}) {
             Node node;
             node.mesh = shared;
             node.local = at(where, 0.3f);
             s.nodes.add(node);
         }
     },
     true},
    {"SphereLightThatTouches",
     [](Scene& s) {
         Light light;
         light.kind = Light::Kind::sphere;
         light.radius = 0.2f;
         place_light(s, light, at({0.8f, 0, 0}));
     },
     false},
    {"SphereLightAtACorner", // its bounds touch the box, but not itself
     [](Scene& s) {
         Light light;
         light.kind = Light::Kind::sphere;
         light.radius = 0.3f;
         place_light(s, light, at({r + 0.25f, r + 0.25f, 0}));
     },
     true},
    {"AreaLightThatTouches",
     [](Scene& s) {
         Light light;
         light.kind = Light::Kind::rectangle;
         light.visible_to_camera = false;
         place_light(s, light, aimed({0, 0.61f, 0}, {0, -1, 0}));
     },
     false},
    {"HiddenObjectThatTouches",
     [](Scene& s) {
         Node node = *s.nodes.find(place(s, floor_quad(2, -r), lambert(0.5f)));
         node.visible = false;
         s.nodes.set(std::prev(s.nodes.end())->id, node);
     },
     true},
    {"ShadowCatcherThatTouches",
     [](Scene& s) {
         Node node = *s.nodes.find(place(s, floor_quad(2, -r), lambert(0.5f)));
         node.shadow_catcher = true;
         s.nodes.set(std::prev(s.nodes.end())->id, node);
     },
     false},
    {"BulbAtItsCentre",
     [](Scene& s) {
         place_light(s, Light{}, at({0, 0, 0}));
     },
     true},
};

class Blockers : public testing::TestWithParam<BlockerCase> {
protected:
    // Beside so many copies that area lights have a BVH of their own.
    static Scene crowded(Scene scene) {
        auto places = std::make_shared<Instances>();
        for (size_t i = 0; i < Accel::min_instances_for_area_light_bvh; ++i)
            places->node_from_copy.push_back(
                {{0.01f, 0, 0}, {0, 0.01f, 0}, {0, 0, 0.01f}, {0.05f * float(i % 64) - 1.6f, 3, 0.05f * float(i / 64)}});
        Node leaves;
        leaves.mesh = scene.meshes.add({"", {{cube(false), scene.materials.add(lambert(0.5f))}}});
        leaves.instances = std::move(places);
        scene.nodes.add(leaves);
        return scene;
    }
};

TEST_P(Blockers, AreFound) {
    Scene scene = ball_in_room(r);
    GetParam().add(scene);
    for (const Scene& s : {scene, crowded(scene)})
        EXPECT_EQ(CompiledLamps(s).clear(), GetParam().clear ? std::vector<bool>{true} : std::vector<bool>{});
}

// Added, moved away and back, and switched off, by edits.
TEST_P(Blockers, AreFoundAfterEdits) {
    for (const bool many : {false, true}) {
        const Scene bare = many ? crowded(ball_in_room(r)) : ball_in_room(r);
        Scene scene = bare;
        GetParam().add(scene);
        CompiledLamps compiled(bare);
        const auto expect_fresh = [&](const Scene& now, const char* what) {
            compiled.follow(now);
            EXPECT_TRUE(same_boxes(compiled, CompiledLamps(now))) << what;
        };
        expect_fresh(scene, "added");
        EXPECT_EQ(!compiled.clear().empty(), GetParam().clear);
        if (scene.nodes.size() > bare.nodes.size()) {
            const auto [id, blocker] = *std::prev(scene.nodes.end());
            Scene edited = scene;
            Node away = blocker;
            away.local.translation.y += 7;
            edited.nodes.set(id, away);
            expect_fresh(edited, "moved away");
            EXPECT_FALSE(compiled.clear().empty());
            expect_fresh(scene, "moved back");
            EXPECT_EQ(!compiled.clear().empty(), GetParam().clear);
            if (blocker.light) {
                Light off = *scene.lights.find(blocker.light);
                off.enabled = false;
                edited = scene;
                edited.lights.set(blocker.light, off);
                expect_fresh(edited, "switched off");
                off.radius = 0.05f;
                off.enabled = true;
                edited.lights.set(blocker.light, off);
                expect_fresh(edited, "smaller");
            }
        }
        expect_fresh(bare, "removed");
        EXPECT_FALSE(compiled.clear().empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, Blockers, testing::ValuesIn(blocker_cases), [](const auto& test) { return test.param.name; });

// ---- edits of the lamp

TEST(LampClearance, FollowsEditsOfTheLamp) {
    Scene scene = ball_in_room();
    const auto [id, node] = *std::prev(scene.nodes.end());
    const Id<Material> material = scene.meshes.find(node.mesh)->parts[0].material;
    CompiledLamps compiled(scene);
    const auto expect_fresh = [&](bool clear, const char* what) {
        compiled.follow(scene);
        const CompiledLamps fresh(scene);
        EXPECT_TRUE(same_boxes(compiled, fresh)) << what;
        EXPECT_EQ(compiled.numbered_records(), fresh.numbered_records()) << what;
        EXPECT_EQ(!compiled.boxes().empty(), clear) << what;
    };
    const auto move_to = [&, id = id, node = node](const Vec3& where, const Vec3& scale) {
        Node moved = node;
        moved.local.translation = where;
        moved.local.scale = scale;
        scene.nodes.set(id, moved);
    };
    const auto set_emission = [&](float strength) {
        Material m = *scene.materials.find(material);
        m.emissive_strength = strength;
        scene.materials.set(material, m);
    };
    move_to({0.5f, 0.3f, 0}, {0.6f, 0.6f, 0.6f});
    expect_fresh(true, "moved");
    move_to({0.5f, -1.5f, 0}, {0.6f, 0.6f, 0.6f});
    expect_fresh(false, "into the floor");
    set_emission(7);
    expect_fresh(false, "brighter");
    move_to({0.5f, 0, 0}, {0.6f, -1.2f, 0.3f});
    expect_fresh(true, "back, mirrored and stretched");
    set_emission(2);
    expect_fresh(true, "darker");
    set_emission(0);
    expect_fresh(false, "dark");
    set_emission(2);
    expect_fresh(true, "bright again");
    move_to({1e5f, 0, 0}, {0.6f, 0.6f, 0.6f});
    expect_fresh(true, "far away, about another origin");
    move_to({0, 0, 0}, {0.6f, 0.6f, 0.6f});
    Mesh mesh = *scene.meshes.find(node.mesh);
    mesh.parts[0].geometry = sphere(true);
    scene.meshes.set(node.mesh, mesh);
    expect_fresh(false, "another shape");
    mesh.parts[0].geometry = capsule(8, 16, 0.5f);
    scene.meshes.set(node.mesh, mesh);
    expect_fresh(true, "a third shape");
    mesh.parts.push_back({moved(sphere(false), {2.5f, 0, 0}), mesh.parts[0].material});
    scene.meshes.set(node.mesh, mesh);
    expect_fresh(true, "two parts apart");
    EXPECT_EQ(compiled.clear(), (std::vector<bool>{true, true}));
    mesh.parts[1].geometry = moved(sphere(false), {1.5f, 0, 0});
    scene.meshes.set(node.mesh, mesh);
    expect_fresh(false, "two parts that touch");
}

// Where one of several lamps goes dark, the others keep their boxes under other numbers.
TEST(LampClearance, FollowsTheOtherLampsIfOneGoesDark) {
    Scene scene = room();
    std::vector<Id<Material>> materials;
    for (const float x : {-1.f, 0.f, 1.f}) {
        place(scene, sphere(false), glow(), at({x, 0.2f * x, 0}, 0.2f));
        materials.push_back(std::prev(scene.materials.end())->id);
    }
    CompiledLamps compiled(scene);
    EXPECT_EQ(compiled.clear(), (std::vector<bool>{true, true, true}));
    for (const Id<Material> id : materials) {
        Material dark = *scene.materials.find(id);
        dark.emissive_strength = 0;
        scene.materials.set(id, dark);
        compiled.follow(scene);
        EXPECT_TRUE(same_boxes(compiled, CompiledLamps(scene)));
    }
    EXPECT_EQ(compiled.scene.tables().lights.clearances, nullptr);
}

} // namespace
} // namespace blush::test::TEST_FILE
