// Instances of one node's mesh (EXT_mesh_gpu_instancing) render, emit and are picked like separate nodes, but as one object.
#include "render/compile/render_scene.h"
#include "render/lights/light_limits.h"
#include "scene/affine.h"
#include "scene/geometry/ray_queries.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

constexpr PlaneSet planes{.albedo = true, .normal = true, .depth = true, .ids = true};

std::vector<Affine> places() {
    Transform turned, mirrored;
    turned.translation = {1.2f, 0.3f, -0.4f}, turned.rotation = {0.1f, 0.2f, 0.05f, 0.97f}, turned.scale = {0.3f, 0.5f, 0.4f};
    mirrored.translation = {-1.1f, 0.2f, 0.3f}, mirrored.scale = {-0.4f, 0.6f, 0.4f};
    return {to_float(to_affine(at({0, 0.4f, 0}, 0.4f))), to_float(to_affine(turned)), to_float(to_affine(mirrored))};
}

struct Orchard {
    Scene scene;
    Id<Node> tree; // the only one, or the first

    Orchard(const Material& material, bool copies) {
        place(scene, floor_quad(3, -0.5f), lambert({0.4f, 0.5f, 0.3f}));
        constant_world(scene, 0.3f);
        const Id<Mesh> mesh =
            scene.meshes.add({"Tree", {{cube(false), scene.materials.add(material)}, {sphere(false), scene.materials.add(lambert(0.6f))}}});
        Node node;
        node.mesh = mesh;
        if (copies) {
            Instances instances;
            instances.node_from_copy = places();
            node.instances = std::make_shared<const Instances>(std::move(instances));
            tree = scene.nodes.add(node);
        } else {
            for (const Affine& place : places()) {
                node.local.matrix = place;
                const Id<Node> id = scene.nodes.add(node);
                if (!tree) tree = id;
            }
        }
        scene.view = looking({1, 3, 4}, {0, 0.2f, 0}, 0.7f);
    }
};

TEST(Copies, RenderLikeSeparateNodes) {
    Material leaves = lambert({0.8f, 0.3f, 0.2f});
    leaves.alpha = Material::Alpha::blend;
    leaves.opacity = 0.6f;
    for (const Material& material : {plastic(0.3f), metal(0.05f), leaves}) {
        const RenderSettings settings = settings_for(32, 24, 4);
        const Frame copies = render(Orchard(material, true).scene, settings, planes).frame;
        const Frame nodes = render(Orchard(material, false).scene, settings, planes).frame;
        EXPECT_EQ(copies.rgba, nodes.rgba);
        EXPECT_EQ(copies.normal, nodes.normal);
        EXPECT_EQ(copies.depth, nodes.depth);
    }
}

TEST(Copies, EmissiveCopiesAreSampledAsLights) {
    const Orchard copies(emitter(3, 0.5f), true), nodes(emitter(3, 0.5f), false);
    RenderSettings settings = settings_for(32, 24, 4);
    settings.strategy = Strategy::light;
    const RenderedImage image = render(copies.scene, settings, planes);
    EXPECT_EQ(image.frame.rgba, render(nodes.scene, settings, planes).frame.rgba);
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(copies.scene, settings);
    EXPECT_EQ(renderer.info().emissive_triangles, 3 * 12);
    EXPECT_EQ(renderer.info().instances, 3);
    EXPECT_EQ(renderer.info().triangles, int64_t(3 * (12 + sphere(false)->triangle_count()) + 2));
}

// An emissive sphere of 128 x 128 quads, instanced `count` times in a layer above a floor, and a light of two triangles.
Scene glowing_layer(int count) {
    constexpr uint32_t n = 128;
    auto ball = std::make_shared<Geometry>();
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float u = 2 * pi * float(i) / n, v = pi * (float(j) + 0.5f) / (n + 1);
            ball->positions.push_back({std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u)});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
            ball->indices.insert(ball->indices.end(), {a, b, c, a, c, d});
        }
    Scene scene;
    place(scene, floor_quad(3, 0), lambert(0.5f));
    place(scene, ceiling_quad(0.3f, 4), emitter(20));
    Instances instances;
    const int side = int(std::ceil(std::sqrt(double(count))));
    for (int i = 0; i < count; ++i) {
        const float step = 4.0f / float(side);
        instances.node_from_copy.push_back(
            to_float(to_affine(at({(float(i % side) + 0.5f) * step - 2, 1.5f, (float(i / side) + 0.5f) * step - 2}, 0.4f * step))));
    }
    Node node;
    node.mesh = scene.meshes.add({"Ball", {{ball, scene.materials.add(emitter(1))}}});
    node.instances = std::make_shared<const Instances>(std::move(instances));
    scene.nodes.add(node);
    scene.view = looking({0, 1, 0.01f}, {0, 0, 0}, 1.5f);
    return scene;
}

// More emissive triangles than the light-sampling limit: the light and some spheres are sampled, the others are found by BSDF
// sampling, and nothing is counted twice or lost.
TEST(Copies, EmissiveCopiesBeyondTheLimitAreUnbiased) {
    const Scene scene = glowing_layer(64);
    RenderSettings settings = settings_for(16, 16, 256);
    settings.max_bounces = 2;
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(scene, settings);
    ASSERT_EQ(renderer.info().emissive_triangles, 64 * 32768 + 2);
    ASSERT_GT(renderer.info().emissive_triangles, max_mesh_lights);
    const auto blocks = [&](Strategy strategy, uint32_t seed) {
        settings.strategy = strategy;
        settings.seed = seed;
        return render(scene, settings).blocks(8, 8);
    };
    const auto found = blocks(Strategy::bsdf, 1);
    EXPECT_TRUE(same_means(found, blocks(Strategy::mis, 2), statistics::sidak(statistics::significance, 2)));
    EXPECT_TRUE(same_means(found, blocks(Strategy::light, 3), statistics::sidak(statistics::significance, 2)));
}

// Three thousand million emissive triangles from a file of a few megabytes.
TEST(Copies, EmissiveCopiesAreBoundedInMemory) {
    const Scene scene = glowing_layer(100'000);
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(scene, settings_for(8, 8, 1));
    const CompiledInfo& info = renderer.info();
    EXPECT_EQ(info.emissive_triangles, int64_t(100'000) * 32768 + 2);
    EXPECT_LT(info.memory_mb, 300);
    const auto said = std::ranges::find_if(
        info.warnings, [](const Diagnostic& d) { return d.what.find("exceed the light-sampling limit") != std::string::npos; });
    ASSERT_NE(said, info.warnings.end());
    EXPECT_TRUE(said->what.starts_with(
        fmt::format("{} of {} emissive triangles", info.emissive_triangles - 31 * 32768 - 2, info.emissive_triangles)))
        << said->what;
    const auto left_out = std::ranges::find(info.features, "mesh lights beyond the limit", &FeatureUse::name);
    ASSERT_NE(left_out, info.features.end());
    EXPECT_FALSE(left_out->used);
}

TEST(Copies, ArePickedAsTheirNode) {
    const Orchard orchard(plastic(0.3f), true);
    const Frame frame = render(orchard.scene, settings_for(32, 24, 1), planes).frame;
    const auto seen = std::ranges::count(frame.object_id, orchard.tree.value);
    const Orchard nodes(plastic(0.3f), false);
    const Frame apart = render(nodes.scene, settings_for(32, 24, 1), planes).frame;
    EXPECT_GT(seen, 20);
    EXPECT_EQ(seen, std::ranges::count_if(apart.object_id, [&](uint32_t id) { return id >= nodes.tree.value; }));
}

TEST(Copies, HaveBoundsAndBlockTheLineOfSight) {
    const Orchard copies(plastic(0.3f), true), nodes(plastic(0.3f), false);
    const Bounds all = world_bounds(nodes.scene), same = world_bounds(copies.scene);
    EXPECT_EQ(all.low, same.low) << "cubes fill their boxes";
    EXPECT_EQ(all.high, same.high);
    const auto is_tree = [&](Id<Node> id) { return id == copies.tree; };
    EXPECT_EQ(first_occluder(copies.scene, {1.2, 3, -0.4}, {1.2, -3, -0.4}, is_tree), copies.tree);
    EXPECT_EQ(first_occluder(copies.scene, {-1.1, 3, 0.3}, {-1.1, -3, 0.3}, is_tree), copies.tree);
    EXPECT_FALSE(first_occluder(copies.scene, {-1.1, 3, 1.3}, {-1.1, -3, 1.3}, is_tree)) << "past it";
}

} // namespace
} // namespace blush::test::TEST_FILE
