// Large meshes that are read in place from the document render bit-identically to copies.
#include "core/math.h"
#include "render/compile/geometry_pool.h"
#include "render/renderer.h"
#include "scene/geometry/arena_geometry.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

constexpr PlaneSet planes{.albedo = true, .normal = true, .depth = true, .ids = true};

// A wavy square with all vertex attributes, and UV sets 0 and 3.
Geometry waves(uint32_t n) {
    Geometry g;
    g.uv.resize(4);
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float u = float(i) / float(n), v = float(j) / float(n);
            g.positions.push_back({2 * u - 1, 0.1f * std::sin(20 * u) * std::cos(17 * v), 1 - 2 * v});
            g.normals.push_back(unit({-std::cos(20 * u) * std::cos(17 * v), 1, -0.85f * std::sin(20 * u) * std::sin(17 * v)}));
            g.tangents.push_back({1, 0, 0, 1});
            g.colors.push_back({1, u, v, 1});
            g.uv[0].push_back({u, v});
            g.uv[3].push_back({3 * v, 3 * u});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            g.indices.insert(g.indices.end(), {a, b, d, a, d, c});
        }
    return g;
}

GeometryPtr large(bool placed) {
    Geometry g = waves(150);
    if (placed) move_to_arena(g);
    return std::make_shared<const Geometry>(std::move(g));
}

// Two instances of the large mesh, and small meshes in front and behind: copied into the pool, flat and instanced.
Scene scene_with(const GeometryPtr& shape, const Material& material) {
    Scene scene;
    Material dressed = material;
    dressed.base_color_texture.texture =
        add_texture(scene, float_image(2, 2, std::vector<Vec3>{{1, 0.5f, 0.2f}, {0.3f, 1, 0.4f}, {0.5f, 0.2f, 1}, {1, 1, 1}}));
    dressed.base_color_texture.uv_set = 3;
    dressed.normal_texture.texture = add_texture(scene, float_image(1, 1, std::vector<Vec3>{{0.6f, 0.5f, 0.9f}}));
    const auto twice = [&](const GeometryPtr& geometry, float y, float size) {
        const Id<Mesh> mesh = scene.meshes.add({"", {{geometry, scene.materials.add(dressed)}}});
        for (const float x : {-1.1f, 1.1f}) {
            Node node;
            node.mesh = mesh;
            node.local = at({x, y, 0}, size);
            scene.nodes.add(node);
        }
    };
    place(scene, floor_quad(5, -0.5f), lambert({0.4f, 0.5f, 0.3f}));
    twice(shape, 0, 1);
    twice(cube(true), 0.8f, 0.2f);
    constant_world(scene, 0.3f);
    place(scene, ceiling_quad(0.5f, 4), emitter(5));
    scene.view = looking({1, 3, 4}, {0, 0.2f, 0}, 0.9f);
    return scene;
}

TEST(ArenaGeometry, HoldsOnlyLargeInstancedMeshes) {
    const GeometryPtr placed = large(true), bare = large(false);
    ASSERT_TRUE(arena_offsets(*placed));
    EXPECT_FALSE(arena_offsets(*bare));
    EXPECT_FALSE(arena_offsets(Geometry(*placed)));
    Geometry small = waves(8);
    move_to_arena(small);
    EXPECT_FALSE(arena_offsets(small));
    EXPECT_EQ(placed->positions, bare->positions);
    EXPECT_EQ(placed->uv, bare->uv);
    EXPECT_EQ(placed->indices, bare->indices);
    // A single array outside the arena is enough.
    Geometry g = waves(150);
    move_to_arena(g);
    ASSERT_TRUE(arena_offsets(g));
    g.uv[3].push_back({0, 0});
    EXPECT_FALSE(arena_offsets(g));
}

TEST(ArenaGeometry, RendersLikeCopies) {
    for (const Material& material : {plastic(0.3f), emitter(1, 0.5f)}) {
        const RenderSettings settings = settings_for(40, 30, 4);
        const Frame placed = render(scene_with(large(true), material), settings, planes).frame;
        const Frame copied = render(scene_with(large(false), material), settings, planes).frame;
        EXPECT_EQ(placed.rgba, copied.rgba);
        EXPECT_EQ(placed.normal, copied.normal);
        EXPECT_EQ(placed.depth, copied.depth);
    }
}

// A pool that is rebuilt while others hold arena ranges, and one that outlives the document.
TEST(ArenaGeometry, LivesAsLongAsItIsUsed) {
    const RenderSettings settings = settings_for(40, 30, 4);
    Renderer renderer({.threads = 1, .planes = planes});
    Frame first, again;
    {
        const Scene scene = scene_with(large(true), plastic(0.3f));
        renderer.update(scene, settings);
    }
    const GeometryPtr other = large(true);
    renderer.render(0, 4);
    first = renderer.resolve();
    const Scene fresh = scene_with(other, plastic(0.3f));
    renderer.update(fresh, settings);
    renderer.render(0, 4);
    again = renderer.resolve();
    EXPECT_EQ(first.rgba, again.rgba);
}

TEST(ArenaGeometry, IsNotCopied) {
    const auto own_bytes = [](const Scene& scene) {
        GeometryPool pool;
        pool.build(list_objects(scene), {.tangents = true, .colors = true, .uv_sets = {0, 3}}, {0, 0, 0});
        return std::pair(int64_t(pool.memory_bytes()), int64_t(pool.in_place_bytes()));
    };
    const GeometryPtr placed = large(true), copied = large(false);
    const auto vertices = int64_t(copied->positions.size()), indices = int64_t(copied->indices.size());
    const auto [own_of_copied, none] = own_bytes(scene_with(copied, plastic(0.3f)));
    const auto [own_of_placed, in_place] = own_bytes(scene_with(placed, plastic(0.3f)));
    EXPECT_EQ(in_place, vertices * (12 + 12 + 16 + 16 + 8 + 8) + indices * 4);
    EXPECT_EQ(none, 0);
    EXPECT_EQ(own_of_copied - own_of_placed, in_place);
}

} // namespace
} // namespace blush::test::TEST_FILE
