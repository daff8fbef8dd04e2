// Equivalent descriptions of a scene give the same image: mirrored or not, instanced or flat, with a neutral normal map.
#include "core/math.h"
#include "scene/affine.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// An asymmetric dome with smooth normals and texture coordinates.
Geometry dome() {
    Geometry g;
    g.uv.resize(1);
    constexpr int n = 8;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const float u = float(i) / n, v = float(j) / n, x = 2 * u - 1, z = 1 - 2 * v;
            g.positions.push_back({x, 0.8f - 0.6f * x * x - 0.4f * z * z + 0.3f * x, z});
            g.normals.push_back(unit({1.2f * x - 0.3f, 1, 0.8f * z}));
            g.uv[0].push_back({u, v});
        }
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < n; ++j) {
            const uint32_t a = i * (n + 1) + j, b = a + n + 1;
            for (const uint32_t k : {a, b, b + 1, a, b + 1, a + 1}) g.indices.push_back(k);
        }
    return g;
}
GeometryPtr shared(Geometry g) { return std::make_shared<const Geometry>(std::move(g)); }

// The same triangles transformed, with the winding kept outward.
GeometryPtr transformed(const Geometry& g, const Transform& transform) {
    const Affined m = to_affine(transform), normals = cofactor(m);
    const double sign = determinant(m) < 0 ? -1 : 1;
    Geometry t = g;
    t.serial = next_payload_serial();
    for (Vec3& p : t.positions) p = to_float(transform_point(m, to_double(p)));
    for (Vec3& n : t.normals) n = to_float(transform_vector(normals, to_double(n)) * sign); // not normalised: interpolated first
    if (sign < 0)
        for (size_t i = 0; i < t.indices.size(); i += 3) std::swap(t.indices[i + 1], t.indices[i + 2]);
    return shared(std::move(t));
}

std::vector<Transform> transforms() {
    Transform mirrored, stretched, both;
    mirrored.scale = {-1, 1, 1};
    mirrored.translation = {0.4f, 0, -0.2f};
    stretched.scale = {0.5f, 1.5f, 0.8f};
    stretched.rotation = {0.1f, 0.2f, 0.05f, 0.97f};
    both.scale = {0.7f, 0.6f, -1.1f};
    both.rotation = {-0.2f, 0.4f, 0.1f, 0.89f};
    both.translation = {-0.3f, 0.2f, 0.3f};
    return {mirrored, stretched, both};
}

void light_and_look(Scene& scene) {
    place(scene, floor_quad(5, -0.5f), lambert({0.4f, 0.5f, 0.3f}));
    constant_world(scene, 0.3f);
    Light bulb;
    bulb.intensity = 5;
    place_light(scene, bulb, at({1, 2.5f, 1.5f}));
    scene.view = looking({1, 3, 4}, {0, 0.2f, 0}, 0.7f);
}

constexpr PlaneSet guides{.albedo = true, .normal = true, .depth = true};

void expect_same_render(const Scene& a, const Scene& b, const std::string& what) {
    RenderSettings settings = settings_for(24, 24, 32);
    const RenderedImage first = render(a, settings, guides);
    settings.seed = 7;
    const RenderedImage other = render(b, settings, guides);
    EXPECT_TRUE(same_means(first.blocks(8, 8), other.blocks(8, 8), sidak(significance, 12))) << what;
    // First-hit data of a sample are equal up to rounding, except where rounding moved an edge.
    settings.seed = 0;
    settings.spp = 1;
    const Frame f = render(a, settings, guides).frame, g = render(b, settings, guides).frame;
    int turned = 0, moved = 0;
    for (size_t i = 0; i < f.normal.size(); ++i) {
        turned += length(f.normal[i] - g.normal[i]) > 1e-4f;
        moved += std::abs(f.depth[i] - g.depth[i]) > 1e-4f;
    }
    EXPECT_LE(turned, 2) << what;
    EXPECT_LE(moved, 2) << what;
}

TEST(Objects, TransformedNodesEqualTransformedTriangles) {
    for (const Material& material : {lambert({0.8f, 0.3f, 0.2f}), plastic(0.3f), emitter(1, 0.5f)})
        for (const Transform& t : transforms()) {
            Scene by_node, by_triangles;
            place(by_node, shared(dome()), material, t);
            place(by_triangles, transformed(dome(), t), material);
            light_and_look(by_node);
            light_and_look(by_triangles);
            expect_same_render(by_node, by_triangles, "placed by its node");
        }
}

TEST(Objects, InstancesEqualCopies) {
    for (const Material& material : {plastic(0.3f), emitter(1, 0.5f)}) {
        Scene instances, copies;
        const Id<Mesh> mesh = instances.meshes.add({"", {{shared(dome()), instances.materials.add(material)}}});
        for (const Transform& t : transforms()) {
            Node node;
            node.mesh = mesh;
            node.local = t;
            instances.nodes.add(node);
            place(copies, transformed(dome(), t), material);
        }
        light_and_look(instances);
        light_and_look(copies);
        expect_same_render(instances, copies, "instanced");
    }
}

// (0.5, 0.5, 1) is the unmodified normal, for any tangents.
TEST(Objects, FlatNormalMapChangesNothing) {
    Geometry g = dome();
    g.tangents.assign(g.positions.size(), Vec4{0.8f, 0.3f, 0.5f, -1});
    const GeometryPtr geometry = shared(g);
    for (const Transform& t : transforms()) {
        Scene mapped, plain;
        Material material = plastic(0.3f);
        place(plain, geometry, material, t);
        material.normal_texture.texture = add_texture(mapped, float_image(1, 1, std::vector<Vec3>{{0.5f, 0.5f, 1}}));
        place(mapped, geometry, material, t);
        light_and_look(plain);
        light_and_look(mapped);
        expect_same_render(mapped, plain, "flat normal map");
    }
}

// A normal map tilted by 45 degrees towards +X shifts the shading.
TEST(Objects, NormalMapTurnsTheNormal) {
    Geometry g = *floor_quad(5);
    g.serial = next_payload_serial();
    g.normals.assign(4, {0, 1, 0});
    g.tangents.assign(4, {1, 0, 0, 1});
    Scene scene;
    Material material = lambert(0.5f);
    material.normal_texture.texture = add_texture(scene, float_image(1, 1, std::vector<Vec3>{{1, 0.5f, 1}}));
    place(scene, shared(g), material);
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    place_light(scene, sun, aimed({0, 0, 0}, {-1, -1, 0}));
    scene.view = looking_down(1, 1);
    const RenderedImage image = render(scene, settings_for(8, 8, 4), guides);
    EXPECT_TRUE(is_mean(image.whole(), 0.5 / std::numbers::pi * 3));
    for (const Vec3& n : image.frame.normal) EXPECT_LT(length(n - unit({1, 1, 0})), 1e-6f);
}

} // namespace
} // namespace blush::test::TEST_FILE
