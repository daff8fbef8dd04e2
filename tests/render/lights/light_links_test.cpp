// Light and shadow linking: illuminated objects and shadow casters, the same for NEE and BSDF sampling.
#include "render/lights/light_links.h"

#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <functional>

namespace blush::test::TEST_FILE {
namespace {

using statistics::sidak;
using statistics::significance;

ObjectSet only(std::vector<Id<Node>> nodes) { return {false, std::move(nodes)}; }
ObjectSet all_but(std::vector<Id<Node>> nodes) { return {true, std::move(nodes)}; }

// A floor and a box under one light, seen from the side; the light is not visible.
struct Stage {
    Scene scene;
    Id<Node> floor, box, lamp;

    explicit Stage(Light::Kind kind) {
        floor = place(scene, floor_quad(4), lambert(0.6f));
        box = place(scene, cube(false), plastic(0.4f), at({0.2f, 0.6f, 0}, 0.4f));
        Light light;
        light.kind = kind;
        light.intensity = kind == Light::Kind::sun ? 2.f : 5.f;
        light.radius = 0.4f;
        light.angle_radians = 0.3f;
        light.width = light.height = 0.8f;
        lamp = place_light(scene, light, aimed({0, 3, 0}, {0.2f, -1, 0.1f}));
        scene.view = looking({0, 2, 4}, {0, 0.3f, 0}, 0.7f);
    }
    void link(const std::function<void(Light&)>& with) {
        const Id<Light> id = scene.nodes.find(lamp)->light;
        Light light = *scene.lights.find(id);
        with(light);
        scene.lights.set(id, light);
    }
};

constexpr Light::Kind kinds[] = {Light::Kind::rectangle, Light::Kind::disk, Light::Kind::sphere, Light::Kind::sun, Light::Kind::point};
constexpr Strategy strategies[] = {Strategy::mis, Strategy::light, Strategy::bsdf};

RenderedImage shot(const Scene& scene, Strategy strategy, int64_t spp, int max_bounces = unlimited_bounces) {
    RenderSettings settings = settings_for(32, 32, spp);
    settings.strategy = strategy;
    settings.max_bounces = max_bounces;
    return render(scene, settings);
}

// Direct light only, by pixels of an object.
double light_on(const Scene& scene, Id<Node> object, Strategy strategy) {
    RenderSettings settings = settings_for(32, 32, 16);
    settings.strategy = strategy;
    settings.max_bounces = 1;
    settings.filter = PixelFilter::box;
    const RenderedImage image = render(scene, settings, {.ids = true});
    double sum = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        if (image.frame.object_id[i] == object.value) sum += image.pixels[i].y;
    return sum;
}

TEST(LightLinks, SelectIlluminatedObjects) {
    for (const Light::Kind kind : kinds)
        for (const Strategy strategy : strategies) {
            Stage stage(kind);
            ASSERT_GT(light_on(stage.scene, stage.box, strategy), 0);
            stage.link([&](Light& l) { l.lit_objects = all_but({stage.box}); });
            // Edge pixels see both: a pixel belongs to the object that its first sample hit.
            const double on_box = light_on(stage.scene, stage.box, strategy), on_floor = light_on(stage.scene, stage.floor, strategy);
            stage.link([&](Light& l) { l.lit_objects = only({stage.floor}); });
            EXPECT_EQ(light_on(stage.scene, stage.box, strategy), on_box) << "the complementary set";
            EXPECT_EQ(light_on(stage.scene, stage.floor, strategy), on_floor);
            stage.link([&](Light& l) { l.lit_objects = only({}); });
            EXPECT_EQ(light_on(stage.scene, stage.box, strategy), 0);
            EXPECT_EQ(light_on(stage.scene, stage.floor, strategy), 0);
            EXPECT_GT(on_floor, 5 * on_box) << int(kind) << " " << int(strategy);
        }
}

// Both kinds of links at once, with indirect light: NEE and BSDF sampling agree.
TEST(LightLinks, AreTheSameForEveryStrategy) {
    for (const Light::Kind kind : kinds)
        for (const bool shadows : {false, true}) {
            Stage stage(kind);
            stage.link([&](Light& l) {
                l.lit_objects = all_but({stage.box});
                if (shadows) l.shadow_casters = all_but({stage.box});
            });
            const auto mis = shot(stage.scene, Strategy::mis, 64).blocks(16, 16);
            const double each = sidak(significance, 20);
            EXPECT_TRUE(same_means(mis, shot(stage.scene, Strategy::light, 64).blocks(16, 16), each)) << int(kind) << shadows;
            EXPECT_TRUE(same_means(mis, shot(stage.scene, Strategy::bsdf, 256).blocks(16, 16), each)) << int(kind) << shadows;
        }
}

// A black board above the camera that casts no shadow has no effect, and one that casts a shadow has.
TEST(ShadowLinks, LetLightThrough) {
    for (const Light::Kind kind : kinds) {
        Stage open(kind);
        open.scene.view = looking({0, 1, 4}, {0, 0, 0}, 0.7f);
        Stage shaded = open;
        const Id<Node> board = place(shaded.scene, ceiling_quad(1.5f, 2), lambert(0.f));
        Material both_sides = lambert(0.f);
        both_sides.double_sided = true;
        shaded.scene.materials.set(shaded.scene.meshes.find(shaded.scene.nodes.find(board)->mesh)->parts[0].material, both_sides);
        EXPECT_FALSE(same_mean(shot(open.scene, Strategy::mis, 64, 1).whole(), shot(shaded.scene, Strategy::mis, 64, 1).whole()))
            << int(kind);
        shaded.link([&](Light& l) { l.shadow_casters = all_but({board}); });
        for (const Strategy strategy : strategies)
            EXPECT_TRUE(same_means(shot(open.scene, Strategy::mis, 64, 1).blocks(16, 16),
                                   shot(shaded.scene, strategy, 64, 1).blocks(16, 16), sidak(significance, 15)))
                << int(kind) << " " << int(strategy);
        // Only the board casts shadows: the box's shadow disappears.
        shaded.link([&](Light& l) { l.shadow_casters = only({}); });
        const Measured none = shot(shaded.scene, Strategy::mis, 64, 1).whole();
        EXPECT_GT(none.mean.y, shot(open.scene, Strategy::mis, 64, 1).whole().mean.y) << int(kind);
    }
}

TEST(ObjectSets, NodesIncludeTheirDescendants) {
    Stage stage(Light::Kind::point);
    Node child;
    child.parent = stage.box;
    const Id<Node> below = stage.scene.nodes.add(child);
    EXPECT_TRUE(contains(only({stage.box}), stage.scene, below));
    EXPECT_FALSE(contains(all_but({stage.box}), stage.scene, below));
    EXPECT_FALSE(contains(only({below}), stage.scene, stage.box));
    EXPECT_TRUE(contains(all_but({below}), stage.scene, stage.box));
}

TEST(ObjectSets, ToggleANode) {
    Stage stage(Light::Kind::point);
    for (ObjectSet set : {all_but({}), only({stage.floor}), all_but({stage.box}), only({stage.box})}) {
        const ObjectSet before = set;
        const bool in = contains(set, stage.scene, stage.box);
        toggle(set, stage.scene, stage.box);
        EXPECT_EQ(contains(set, stage.scene, stage.box), !in);
        toggle(set, stage.scene, stage.box);
        EXPECT_EQ(set, before);
    }
}

TEST(ObjectSets, IgnoreRemovedNodes) {
    Stage stage(Light::Kind::point);
    const Frame before = shot(stage.scene, Strategy::mis, 2).frame;
    stage.link([](Light& l) { l.lit_objects = l.shadow_casters = {true, {Id<Node>{12345}}}; });
    EXPECT_FALSE(leaves_out(all_but({Id<Node>{12345}}), stage.scene));
    const Frame after = shot(stage.scene, Strategy::mis, 2).frame;
    EXPECT_EQ(after.rgba, before.rgba);
    EXPECT_EQ(after.kernel, before.kernel) << "without links the kernel has no linking code";
}

TEST(ShadowLinks, WarnIfThereAreTooMany) {
    Stage stage(Light::Kind::point);
    std::vector<Id<Node>> things;
    for (int i = 0; i < 40; ++i) things.push_back(place(stage.scene, cube(false), lambert(0.5f), at({float(i) - 20, 0.5f, -2}, 0.1f)));
    for (const Id<Node> thing : things) {
        Light light;
        light.intensity = 0.1f;
        light.shadow_casters = all_but({thing});
        place_light(stage.scene, light, at({0, 2, 0}));
    }
    const CasterSets sets(stage.scene);
    EXPECT_EQ(sets.left_out(), 40 - max_caster_sets);
    Renderer renderer({.threads = 1});
    renderer.update(stage.scene, settings_for(8, 8, 1));
    bool said = false;
    for (const Diagnostic& d : renderer.info().warnings) said |= d.what.find("shadow casters") != d.what.npos;
    EXPECT_TRUE(said);
}

} // namespace
} // namespace blush::test::TEST_FILE
