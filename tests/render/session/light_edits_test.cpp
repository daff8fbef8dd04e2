// Edits of lights update only the tables of lights. After any sequence of them the film is that of a fresh renderer, bit for bit.
#include "core/math.h"
#include "render/bvh/accel.h"
#include "scene/affine.h"
#include "tests/render/session/rich_project.h"
#include "tests/support/images.h"
#include "tests/support/random_edits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

using test::all_planes;
using test::Rng;
using test::same_pixels;

float random_float(Rng& rng, float low, float high) { return std::uniform_real_distribution<float>(low, high)(rng); }

// Lights and objects in view, without motion; if `crowded`, beside so many copies of a leaf that lamps have a BVH of their own.
Project stage(bool crowded) {
    Project project = test::rich_project();
    Scene& scene = project.scene;
    scene.scene_selection = {};
    project.render.width = 24;
    project.render.height = 16;
    if (!crowded) return project;
    const Id<Mesh> twig = std::ranges::find_if(scene.meshes, [](const auto& m) { return m.value.name == "Twig"; })->id;
    auto places = std::make_shared<Instances>();
    for (size_t i = 0; i < Accel::min_instances_for_area_light_bvh; ++i) {
        const auto column = float(i % 64), row = float(i / 64);
        places->node_from_copy.push_back(
            {{0.03f, 0, 0}, {0, 0.03f, 0}, {0, 0, 0.03f}, {0.06f * column - 2, 0.04f * row - 1, -0.3f - 1e-4f * float(i)}});
    }
    Node leaves;
    leaves.name = "Leaves";
    leaves.mesh = twig;
    leaves.instances = std::move(places);
    scene.nodes.add(leaves);
    return project;
}

using Change = void (*)(Rng&, Scene&, Id<Node>);

void change_light(Scene& scene, Id<Node> node, auto&& with) {
    const Id<Light> id = scene.nodes.find(node)->light;
    Light light = *scene.lights.find(id);
    with(light);
    scene.lights.set(id, light);
}

void change_node(Scene& scene, Id<Node> id, auto&& with) {
    Node node = *scene.nodes.find(id);
    with(node);
    scene.nodes.set(id, node);
}

Id<Node> random_node(Rng& rng, const Scene& scene) { return (scene.nodes.begin() + std::ptrdiff_t(rng() % scene.nodes.size()))->id; }

// Some objects, or all but some.
ObjectSet random_set(Rng& rng, const Scene& scene) {
    ObjectSet set{rng() % 2 == 0, {}};
    if (rng() % 4 > 0) set.nodes = {random_node(rng, scene), random_node(rng, scene)};
    return set;
}

void set_kind(Rng& rng, Scene& scene, Id<Node> node) {
    change_light(scene, node, [&](Light& l) {
        l.kind = Light::Kind(rng() % 6);
        if (l.radius == 0 && l.kind >= Light::Kind::disk) l.radius = 0.2f;
    });
}

// No light below itself.
void set_parent(Rng& rng, Scene& scene, Id<Node> id) {
    const Id<Node> parent = rng() % 3 == 0 ? Id<Node>{} : random_node(rng, scene);
    for (Id<Node> up = parent; up; up = scene.nodes.find(up)->parent)
        if (up == id) return;
    change_node(scene, id, [&](Node& n) { n.parent = parent; });
}

void change_material(Rng& rng, Scene& scene, Id<Node>) {
    const auto& [id, value] = *(scene.materials.begin() + std::ptrdiff_t(rng() % scene.materials.size()));
    Material material = value;
    if (rng() % 4 == 0) material.emits = !material.emits;
    if (rng() % 4 == 0) material.emissive = material.emissive == Vec3{0, 0, 0} ? Vec3{1, 2, 1} : Vec3{0, 0, 0};
    material.emissive_strength = random_float(rng, 0.5f, 2);
    scene.materials.set(Id<Material>{id}, material);
}

constexpr Change changes[]{
    [](Rng& rng, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.intensity = random_float(rng, 0, 9); }); },
    [](Rng& rng, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.color.y = random_float(rng, 0, 1); }); },
    [](Rng& rng, Scene& s, Id<Node> n) { change_node(s, n, [&](Node& x) { x.local.translation.x += random_float(rng, -0.3f, 0.3f); }); },
    [](Rng& rng, Scene& s, Id<Node> n) { change_node(s, n, [&](Node& x) { x.local.rotation.x += random_float(rng, -0.1f, 0.1f); }); },
    [](Rng&, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.enabled = !l.enabled; }); },
    [](Rng& rng, Scene& s, Id<Node> n) {
        change_light(s, n, [&](Light& l) { l.radius = rng() % 2 ? 0.f : random_float(rng, 0.1f, 0.4f); });
    },
    [](Rng& rng, Scene& s, Id<Node> n) {
        change_light(s, n, [&](Light& l) { l.spread_radians = random_float(rng, 0.5f, std::numbers::pi_v<float>); });
    },
    [](Rng& rng, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.lit_objects = random_set(rng, s); }); },
    [](Rng& rng, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.shadow_casters = random_set(rng, s); }); },
    [](Rng&, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.lit_objects = l.shadow_casters = {}; }); },
    [](Rng&, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.visible_to_camera = !l.visible_to_camera; }); },
    [](Rng&, Scene& s, Id<Node> n) { change_light(s, n, [&](Light& l) { l.solo = !l.solo; }); },
    [](Rng&, Scene& s, Id<Node> n) { change_node(s, n, [&](Node& x) { x.visible = !x.visible; }); },
    [](Rng& rng, Scene& s, Id<Node>) { s.mix.grouping = rng() % 3 ? LightMix::Grouping::none : LightMix::Grouping::by_light; },
    [](Rng& rng, Scene& s, Id<Node>) { s.environment.intensity = rng() % 4 ? random_float(rng, 0, 2) : 0; },
    [](Rng& rng, Scene& s, Id<Node>) { change_node(s, random_node(rng, s), [&](Node& x) { x.shadow_catcher = rng() % 3 == 0; }); },
    [](Rng& rng, Scene& s, Id<Node>) { change_node(s, random_node(rng, s), [&](Node& x) { x.local.translation.y += 0.1f; }); },
    // Far away, so that the origin of the tables moves, and back.
    [](Rng&, Scene& s, Id<Node> n) {
        change_node(s, n, [&](Node& x) { x.local.translation.z += x.local.translation.z > 500 ? -1000.f : 1000.f; });
    },
    set_kind,
    set_parent,
    change_material,
};

Id<Node> random_light(Rng& rng, const Scene& scene) {
    std::vector<Id<Node>> nodes;
    for (const auto& [id, node] : scene.nodes)
        if (node.light) nodes.push_back(id);
    return nodes[rng() % nodes.size()];
}

struct Case {
    unsigned seed;
    bool crowded;
};
void PrintTo(const Case& c, std::ostream* out) { *out << "seed " << c.seed << (c.crowded ? ", crowded" : ""); }

class LightEdits : public ::testing::TestWithParam<Case> {};

TEST_P(LightEdits, RenderLikeAFreshScene) {
    Rng rng(GetParam().seed);
    Project project = stage(GetParam().crowded);
    Project base = project; // that the film was rendered from; it may differ in the light mix only
    Renderer updated(all_planes());
    size_t images = 0;
    for (size_t step = 0; step < 8 * std::size(changes); ++step) {
        const size_t kind = step % 3 ? rng() % 6 : step / 3 % std::size(changes); // mostly the common edits
        changes[kind](rng, project.scene, random_light(rng, project.scene));
        if (rng() % 5 == 0) continue; // two edits at once
        if (updated.update(project.scene, project.render)) {
            updated.render(0, 1);
            base = project;
            ++images;
        }
        Renderer fresh(all_planes());
        fresh.update(base.scene, base.render);
        fresh.render(0, 1);
        fresh.update(project.scene, project.render);
        ASSERT_TRUE(same_pixels(updated.resolve(), fresh.resolve())) << "step " << step << ", change " << kind;
        EXPECT_EQ(updated.info().kernel, fresh.info().kernel);
        EXPECT_EQ(updated.info().emissive_triangles, fresh.info().emissive_triangles);
        EXPECT_EQ(updated.info().point_lights, fresh.info().point_lights);
        EXPECT_EQ(updated.resolve().missing_light, fresh.resolve().missing_light);
    }
    EXPECT_GT(images, std::size(changes));
}

INSTANTIATE_TEST_SUITE_P(Seeds, LightEdits,
                         ::testing::Values(Case{1, false}, Case{2, false}, Case{3, false}, Case{4, true}, Case{5, true}));

// A disabled area light is not there for rays, for the scene's extent (which scales a sky's selection power) and for the statistics.
TEST(DisabledAreaLight, IsInNoRaysWay) {
    Project project = stage(false);
    project.scene.environment.intensity = 1;
    // Stochastic opacity depends on the number of an instance, which the panel shifts.
    for (const auto& [id, material] : Table<Material>(project.scene.materials)) {
        Material opaque = material;
        opaque.alpha = Material::Alpha::opaque;
        project.scene.materials.set(id, opaque);
    }
    Light panel;
    panel.kind = Light::Kind::rectangle;
    panel.width = panel.height = 40;
    panel.enabled = false;
    Node node;
    node.light = project.scene.lights.add(panel);
    node.local.translation = {0, 0, -1};
    const Id<Node> id = project.scene.nodes.add(node);
    Scene without = project.scene;
    change_node(without, id, [](Node& n) { n.light = {}; });
    EXPECT_TRUE(same_pixels(test::fresh_image(project.scene, project.render, 2), test::fresh_image(without, project.render, 2)));

    Renderer with_panel(all_planes()), with_none(all_planes());
    with_panel.update(project.scene, project.render);
    with_none.update(without, project.render);
    EXPECT_EQ(with_panel.info().triangles, with_none.info().triangles);
    EXPECT_EQ(with_panel.info().meshes, with_none.info().meshes);

    Scene enabled = project.scene;
    panel.enabled = true;
    enabled.lights.set(node.light, panel);
    EXPECT_FALSE(same_pixels(test::fresh_image(enabled, project.render, 2), test::fresh_image(without, project.render, 2)));
}

// Beside many copies, lamps are traced in a BVH of their own. The image is that of one BVH: here of the same scene without the last
// copies, which are too small to be hit. Without the flag, which has points in common with the screen: which one is hit there depends
// on the BVH.
TEST(AreaLightBvh, ShowsTheSameImage) {
    const Project crowded = stage(true);
    const auto named = [&](const char* name) {
        return std::ranges::find_if(crowded.scene.nodes, [&](const auto& n) { return n.value.name == name; })->id;
    };
    const Id<Node> leaves = named("Leaves"), flag = named("Flag");
    constexpr size_t all = Accel::min_instances_for_area_light_bvh, few = all - 64; // the scene has some other instances
    const auto image_of = [&](size_t count) {
        auto places = std::make_shared<Instances>(*crowded.scene.nodes.find(leaves)->instances);
        for (size_t i = few; i < all; ++i) {
            Affine& place = places->node_from_copy[i];
            place = {place.x * 1e-4f, place.y * 1e-4f, place.z * 1e-4f, places->node_from_copy[few / 2].t};
        }
        places->node_from_copy.resize(count);
        Scene scene = crowded.scene;
        change_node(scene, leaves, [&](Node& n) { n.instances = std::move(places); });
        change_node(scene, flag, [](Node& n) { n.visible = false; });
        return test::fresh_image(scene, crowded.render, 4);
    };
    EXPECT_TRUE(same_pixels(image_of(all), image_of(few)));
}

} // namespace
} // namespace blush::TEST_FILE
