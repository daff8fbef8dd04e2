// Instances without an invertible transform are rendered flat, or removed with a warning, and non-finite rays are not traced.
#include "core/math.h"
#include "render/bvh/accel.h"
#include "render/compile/baked_transforms.h"
#include "render/compile/scene_tables.h"
#include "scene/affine.h"
#include "scene/geometry/ray_queries.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <array>
#include <cmath>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

constexpr PlaneSet planes{.albedo = true, .normal = true, .depth = true, .ids = true};

// A tilted quad, which keeps its extent in X and Y when flattened along Z.
GeometryPtr leaning_quad() { return quad({-1, -1, 0.5f}, {1, -1, -0.5f}, {1, 1, 0.5f}, {-1, 1, 1.5f}); }

enum class How { own_mesh, shared_mesh, copies };

// Two objects side by side with that scale, in front of a wall; as
// small separate meshes, as nodes sharing one mesh, or as instances.
Scene pair_of(const Vec3& scale, How how, const GeometryPtr& shape = leaning_quad()) {
    Scene scene;
    place(scene, quad({-4, -4, -2}, {4, -4, -2}, {4, 4, -2}, {-4, 4, -2}), lambert(0.4f));
    constant_world(scene, 1);
    const Id<Material> red = scene.materials.add(lambert({0.8f, 0.3f, 0.2f}));
    const std::array<float, 2> places{-1.2f, 1.2f};
    std::array<Transform, 2> transforms;
    for (size_t i = 0; i < 2; ++i) {
        transforms[i].translation = {places[i], 0, 0};
        transforms[i].scale = scale;
        transforms[i].rotation = {0, 0.3f * float(i), 0, 1};
    }
    Id<Mesh> mesh = scene.meshes.add({"shape", {{shape, red}}});
    Node node;
    node.name = "flat one";
    if (how == How::copies) {
        Instances instances;
        for (const Transform& t : transforms) instances.node_from_copy.push_back(to_float(to_affine(t)));
        node.mesh = mesh;
        node.instances = std::make_shared<const Instances>(std::move(instances));
        scene.nodes.add(node);
    } else
        for (const Transform& t : transforms) {
            node.local = t;
            node.mesh = mesh;
            scene.nodes.add(node);
            if (how == How::own_mesh) mesh = scene.meshes.add({"shape", {{shape, red}}});
        }
    scene.view = looking({0.3f, 0.4f, 6}, {0, 0, 0}, 0.8f);
    return scene;
}

Frame image_of(const Scene& scene) { return render(scene, settings_for(48, 32, 16), planes).frame; }

size_t pixels_of(const Frame& frame, uint32_t wall) {
    return size_t(std::ranges::count_if(frame.object_id, [&](uint32_t id) { return id != 0 && id != wall; }));
}

std::vector<Diagnostic> warnings_of(const Scene& scene) {
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(scene, settings_for(8, 8, 1));
    return renderer.info().warnings;
}

TEST(Flattened, RenderLikeSmallSeparateMeshes) {
    for (const Vec3 scale : {Vec3{1, 1, 0}, Vec3{1, 1, 1e-30f}, Vec3{1, 1, 1e-7f}, Vec3{-0.7f, 1, 0}}) {
        const Frame own = image_of(pair_of(scale, How::own_mesh));
        const size_t seen = pixels_of(own, 1);
        EXPECT_GT(seen, 100u);
        for (const How how : {How::shared_mesh, How::copies}) {
            const Frame frame = image_of(pair_of(scale, how));
            EXPECT_NEAR(double(pixels_of(frame, 1)), double(seen), 8) << scale.z << ": edges may round differently";
            double difference = 0, sum = 0, turned = 0;
            for (size_t i = 0; i < own.rgba.size(); ++i)
                difference += std::abs(double(frame.rgba[i]) - double(own.rgba[i])), sum += double(own.rgba[i]);
            for (size_t i = 0; i < own.normal.size(); ++i) turned += double(length(frame.normal[i] - own.normal[i]));
            EXPECT_LT(difference / sum, 0.01) << scale.z;
            EXPECT_LT(turned / double(own.normal.size()), 0.01) << scale.z;
        }
    }
}

// The case that crashed: one triangle shared by two nodes.
TEST(Flattened, OneTriangleOnTwoNodes) {
    auto triangle = std::make_shared<Geometry>();
    triangle->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle->indices = {0, 1, 2};
    EXPECT_GT(pixels_of(image_of(pair_of({1, 1, 0}, How::shared_mesh, triangle)), 1), 20u);
}

// A single mesh that is too large to be rebuilt at every move.
TEST(Flattened, ALargeMesh) {
    constexpr uint32_t n = 140;
    auto grid = std::make_shared<Geometry>();
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) grid->positions.push_back({2 * float(i) / n - 1, 2 * float(j) / n - 1, float((i * 7 + j) % 5)});
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, c = a + n + 2;
            grid->indices.insert(grid->indices.end(), {a, a + 1, c, a, c, c - 1});
        }
    Scene scene;
    place(scene, quad({-4, -4, -2}, {4, -4, -2}, {4, 4, -2}, {-4, 4, -2}), lambert(0.4f));
    constant_world(scene, 1);
    Transform flat;
    flat.scale = {1, 1, 0};
    const Id<Node> node = place(scene, grid, lambert(0.7f), flat);
    scene.view = looking({0, 0, 6}, {0, 0, 0}, 0.8f);
    const Frame frame = image_of(scene);
    const auto seen = size_t(std::ranges::count(frame.object_id, node.value));
    EXPECT_NEAR(double(seen), std::pow(2 / (2 * 6 * std::tan(0.4)) * 32, 2), 40);
    size_t facing = 0;
    for (size_t i = 0; i < frame.object_id.size(); ++i)
        facing += frame.object_id[i] == node.value && std::abs(frame.normal[i].z - 1) < 1e-4f;
    EXPECT_EQ(facing, seen) << "it is a plane";
}

// Passing through zero, as in an animation or while typing a scale: each image equals that of a fresh start.
TEST(Flattened, WhileAnEditPassesThroughZero) {
    Renderer renderer({.threads = 1, .planes = planes});
    for (const float z : {0.5f, 0.f, -0.5f, 0.f, 1e-8f, 0.5f})
        for (const How how : {How::shared_mesh, How::copies}) {
            const Scene scene = pair_of({1, 1, z}, how);
            renderer.update(scene, settings_for(48, 32, 2));
            renderer.render(0, 2);
            Renderer fresh({.threads = 1, .planes = planes});
            fresh.update(scene, settings_for(48, 32, 2));
            fresh.render(0, 2);
            ASSERT_EQ(renderer.resolve().rgba, fresh.resolve().rgba) << z;
        }
}

TEST(Flattened, ToALineOrAPointAreRemovedWithAWarning) {
    for (const Vec3 scale : {Vec3{1, 0, 0}, Vec3{0, 0, 0}, Vec3{1e30f, 1e-30f, 1e-30f}})
        for (const How how : {How::shared_mesh, How::copies}) {
            const Scene scene = pair_of(scale, how);
            EXPECT_EQ(pixels_of(image_of(scene), 1), 0u);
            const std::vector<Diagnostic> warnings = warnings_of(scene);
            ASSERT_EQ(warnings.size(), how == How::copies ? 1u : 2u);
            EXPECT_NE(warnings[0].what.find("not rendered"), std::string::npos) << warnings[0].what;
            EXPECT_NE(warnings[0].where.find("flat one"), std::string::npos) << warnings[0].where;
        }
    EXPECT_TRUE(warnings_of(pair_of({1, 1, 0}, How::shared_mesh)).empty());
}

// The transform keeps an area, but the shape is upright to it. Of a shape that leans a part is left.
TEST(Flattened, ShapesThatAreFlattenedToALineAreReported) {
    for (const float height : {0.f, 1e-30f})
        for (const How how : {How::own_mesh, How::shared_mesh, How::copies}) {
            const Scene scene = pair_of({1, height, 1}, how, quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}));
            EXPECT_EQ(pixels_of(image_of(scene), 1), 0u);
            const std::vector<Diagnostic> warnings = warnings_of(scene);
            ASSERT_EQ(warnings.size(), how == How::copies ? 1u : 2u);
            EXPECT_NE(warnings[0].what.find("not rendered: no area"), std::string::npos) << warnings[0].what;
            EXPECT_TRUE(warnings_of(pair_of({1, height, 1}, how)).empty());
        }
}

// The window shows them with each image; they are the same object until they change.
TEST(Flattened, WarningsComeWithTheImage) {
    Renderer renderer({.threads = 1, .planes = {}});
    const auto warnings_with = [&](const Scene& scene) {
        renderer.update(scene, settings_for(8, 8, 1));
        renderer.render(0, 1);
        return renderer.resolve().warnings;
    };
    for (const How how : {How::own_mesh, How::shared_mesh}) {
        const auto none = warnings_with(pair_of({1, 1, 1}, how)), flat = warnings_with(pair_of({0, 1, 0}, how));
        EXPECT_TRUE(none->empty());
        ASSERT_EQ(flat->size(), 2u);
        EXPECT_NE(flat->front().what.find("not rendered"), std::string::npos) << flat->front().what;
        Scene darker = pair_of({0, 1, 0}, how);
        constant_world(darker, 0.5f);
        EXPECT_EQ(warnings_with(darker), flat);
        EXPECT_TRUE(warnings_with(pair_of({1, 1, 0.5f}, how))->empty());
    }
}

TEST(Flattened, CopiesWithEqualStretchShareAMesh) {
    auto mesh = std::make_shared<Geometry>(*sphere(false));
    Scene scene;
    Instances instances;
    for (int i = 0; i < 1000; ++i) {
        Transform t;
        t.translation = {float(i), 0, 0};
        t.rotation = {0.1f * float(i % 7), 0.3f, 0.2f, 0.9f};
        t.scale = {1 + float(i % 3), 2, i % 10 == 0 ? 1.f : 0.f};
        instances.node_from_copy.push_back(to_float(to_affine(t)));
    }
    Node node;
    node.mesh = scene.meshes.add({"ball", {{mesh, scene.materials.add(lambert(0.5f))}}});
    node.instances = std::make_shared<const Instances>(std::move(instances));
    scene.nodes.add(node);
    constant_world(scene, 1);
    std::vector<SceneObject> objects = list_objects(scene);
    std::vector<Diagnostic> left_out;
    BakedTransforms().bake(scene, objects, left_out);
    ASSERT_EQ(objects.size(), 2u);
    EXPECT_EQ(objects[0].copies(), 100u);
    EXPECT_EQ(objects[0].parts[0].geometry, mesh);
    EXPECT_EQ(objects[1].copies(), 900u);
    EXPECT_TRUE(left_out.empty());
}

// The product of the factors is the original, and each factor has its documented properties.
TEST(Flattened, TransformsAreFactored) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vec3d{normal(random), normal(random), normal(random)}; };
    for (int i = 0; i < 2000; ++i) {
        Affined m{vector(), vector(), vector(), vector()};
        const double size = std::pow(10, 3 * normal(random));
        switch (i % 5) {
        case 0: m.z = m.x * normal(random) + m.y * normal(random); break; // sheared flat
        case 1: m.y = {0, 0, 0}; break;
        case 2: m.x = m.x * 1e-9; break;
        case 3: m.x = m.x * 1e-12, m.y = m.y * 1e-12, m.z = m.z * 1e-12; break;
        case 4: break;
        }
        m = {m.x * size, m.y * size, m.z * size, m.t};
        const PlaceSplit split = split_place(m);
        ASSERT_TRUE(split.has_area);
        if (split.invertible) {
            ASSERT_NE(i % 5, 1);
            continue;
        }
        const Affined product = split.place * split.stretch;
        const double largest = std::max({length(m.x), length(m.y), length(m.z)});
        for (const Vec3d& d : {product.x - m.x, product.y - m.y, product.z - m.z}) ASSERT_LT(length(d), 1e-9 * largest) << i;
        ASSERT_EQ(product.t, m.t);
        const Affined identity = inverse(split.place) * split.place;
        for (const Vec3d& d : {identity.x - Vec3d{1, 0, 0}, identity.y - Vec3d{0, 1, 0}, identity.z - Vec3d{0, 0, 1}})
            ASSERT_LT(length(d), 1e-6) << i;
    }
}

TEST(Flattened, BlockTheLineOfSight) {
    for (const How how : {How::shared_mesh, How::copies}) {
        const Scene scene = pair_of({1, 1, 0}, how);
        const auto is_flat = [&](Id<Node> id) { return id.value > 1; };
        EXPECT_TRUE(first_occluder(scene, {-1.2, 0.2, 3}, {-1.2, 0.2, -1}, is_flat));
        EXPECT_FALSE(first_occluder(scene, {-1.2, 3, 3}, {-1.2, 3, -1}, is_flat)) << "past it";
    }
}

// Rays that are not finite, or leave Embree's range in the space of
// an instance, miss; their neighbours in the packet are unaffected.
TEST(Flattened, NonFiniteRaysMiss) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const GeometryPtr shape = quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    const std::vector<InstanceRecord> small{{{{1e-6f, 0, 0}, {0, 1e-6f, 0}, {0, 0, 1e-6f}, {0, 0, 0}}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    AccelScene scene;
    scene.instances.push_back({{{shape->serial, nullptr, shape->positions.data(), 4, shape->indices.data(), 2}}, small});
    Accel accel;
    const SceneTables tables{};
    accel.commit(scene, &tables, Workers(1));
    struct Rays {
        alignas(64) float ox[16], oy[16], oz[16], dx[16], dy[16], dz[16], far[16];
    } r;
    for (const float bad : {nan, inf, -inf, 3e38f, 1e14f})
        for (int which = 0; which < 7; ++which) {
            if (which == 6 && !std::isnan(bad)) continue; // far distances may be infinite
            for (int i = 0; i < 16; ++i) {
                r.ox[i] = r.oy[i] = 1e-7f, r.oz[i] = 1, r.dx[i] = r.dy[i] = 0, r.dz[i] = -1, r.far[i] = inf;
                if (i % 2)
                    (which == 0   ? r.ox
                     : which == 1 ? r.oy
                     : which == 2 ? r.oz
                     : which == 3 ? r.dx
                     : which == 4 ? r.dy
                     : which == 5 ? r.dz
                                  : r.far)[i] = bad;
            }
            alignas(64) float t[16], u[16], v[16];
            alignas(64) int32_t geometry[16], instance[16], triangle[16];
            accel.intersect({r.ox, r.oy, r.oz, r.dx, r.dy, r.dz, r.far, nullptr}, 16, false, {t, u, v, geometry, instance, triangle});
            uint8_t blocked[16];
            accel.occluded({r.ox, r.oy, r.oz, r.dx, r.dy, r.dz, r.far, nullptr}, 16, true, blocked);
            for (int i = 0; i < 16; ++i) {
                EXPECT_EQ(geometry[i] >= 0, i % 2 == 0) << bad << ' ' << which << ' ' << i;
                EXPECT_EQ(blocked[i] != 0, i % 2 == 0) << bad << ' ' << which << ' ' << i;
            }
        }
}

} // namespace
} // namespace blush::test::TEST_FILE
