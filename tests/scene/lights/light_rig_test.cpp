// Light rigs: when they are offered, and their lights.
#include "core/math.h"
#include "scene/affine.h"
#include "scene/lights/light_rig.h"
#include "scene/lights/sky_model.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

GeometryPtr box(const Vec3& half) {
    auto g = std::make_shared<Geometry>();
    for (int k = 0; k < 8; ++k) g->positions.push_back({k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z});
    g->indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return g;
}

struct Model {
    Scene scene;
    Id<Material> material;
    Id<Node> node;

    explicit Model(const Vec3& half = {1, 1, 1}) {
        material = scene.materials.add(Material{});
        Node n;
        n.mesh = scene.meshes.add({"box", {{box(half), material}}});
        node = scene.nodes.add(n);
        scene.view.position = {0, 0, 8};
    }
    Id<Light> place_light(const Light& light) {
        Node n;
        const Id<Light> id = scene.lights.add(light);
        n.light = id;
        scene.nodes.add(n);
        return id;
    }
};

TEST(LightRig, IsOfferedWithoutLight) {
    EXPECT_FALSE(has_light(Scene{}));
    EXPECT_FALSE(has_light(Model().scene));

    Model lit;
    const Id<Light> lamp = lit.place_light({});
    EXPECT_TRUE(has_light(lit.scene));
    for (const auto& darken :
         std::vector<std::function<void(Light&)>>{[](Light& l) { l.enabled = false; }, [](Light& l) { l.intensity = 0; },
                                                  [](Light& l) {
                                                      l.color = {0, 0, 0};
                                                  }}) {
        Light dark;
        darken(dark);
        lit.scene.lights.set(lamp, dark);
        EXPECT_FALSE(has_light(lit.scene));
    }

    Model hidden;
    hidden.place_light({});
    for (const auto& [id, node] : Scene(hidden.scene).nodes) {
        Node n = node;
        n.visible = !n.light;
        hidden.scene.nodes.set(id, n);
    }
    EXPECT_FALSE(has_light(hidden.scene));

    Model glowing;
    Material m;
    m.emissive = {0, 1, 0};
    glowing.scene.materials.set(glowing.material, m);
    EXPECT_TRUE(has_light(glowing.scene));
    m.emissive_strength = 0;
    glowing.scene.materials.set(glowing.material, m);
    EXPECT_FALSE(has_light(glowing.scene));

    Model image;
    m = {};
    m.unlit = true;
    image.scene.materials.set(image.material, m);
    EXPECT_TRUE(has_light(image.scene)) << "unlit surfaces need none";
}

TEST(LightRig, IsOfferedForABlackEnvironment) {
    Model model;
    Environment& e = model.scene.environment;
    e.kind = Environment::Kind::constant;
    EXPECT_TRUE(has_light(model.scene));
    e.color = {0, 0, 0};
    EXPECT_FALSE(has_light(model.scene));
    e = {};
    e.kind = Environment::Kind::image;
    Image image;
    image.width = image.height = 1, image.channels = 3, image.floats = {0, 0, 0};
    e.image = std::make_shared<const Image>(image);
    EXPECT_FALSE(has_light(model.scene));
    image.floats[1] = 1;
    image.serial = next_payload_serial();
    e.image = std::make_shared<const Image>(image);
    EXPECT_TRUE(has_light(model.scene));
    e.lights_scene = false;
    EXPECT_FALSE(has_light(model.scene)) << "a backdrop";
}

// Illuminance at the centre of the scene on a surface that faces the softbox, by quadrature.
double lux_at(const Scene& scene, Id<Node> id, const Vec3d& point) {
    const Light& light = *scene.lights.find(scene.nodes.find(id)->light);
    const Affined world = world_from_node(scene, id);
    const Vec3d facing = normalize(world.t - point), emission = world.z * -1;
    constexpr int n = 64;
    double lux = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3d at = world.t + world.x * (((i + 0.5) / n - 0.5) * light.width) + world.y * (((j + 0.5) / n - 0.5) * light.height);
            const Vec3d to = at - point;
            const double d = length(to);
            lux += std::max(0.0, dot(to, facing) / d) * std::max(0.0, -dot(to, emission) / d) / (d * d);
        }
    return lux * light.intensity * light.width * light.height / (n * n);
}

TEST(LightRig, StudioGivesTheStatedIlluminance) {
    for (const float size : {1e-3f, 1.f, 500.f}) {
        Model model({size, 2 * size, size});
        model.scene.view.position = {3 * size, size, 9 * size};
        const Result<Scene> lit = with_light_rig(model.scene, LightRig::studio, {});
        ASSERT_TRUE(lit) << lit.error().text();
        EXPECT_TRUE(has_light(*lit));
        ASSERT_EQ(lit->lights.size(), 3u);
        const double wanted[] = {rig_key_lux, rig_fill_lux, rig_rim_lux};
        int i = 0;
        for (const auto& [id, node] : lit->nodes) {
            if (!node.light) continue;
            EXPECT_NEAR(lux_at(*lit, id, {0, 0, 0}), wanted[i], 0.002 * wanted[i]) << node.name;
            EXPECT_GT(length(to_double(node.local.translation)), 2 * world_bounds(model.scene).radius()) << "outside of what it lights";
            EXPECT_FALSE(lit->lights.find(node.light)->visible_to_camera);
            ++i;
        }
        EXPECT_EQ(lit->environment.kind, Environment::Kind::constant) << "without a map";
    }
}

TEST(LightRig, StudioFollowsTheView) {
    Model model;
    for (const double turn : {0.0, 1.0, 2.5, -2.0}) {
        model.scene.view.position = {float(8 * std::sin(turn)), 2, float(8 * std::cos(turn))};
        model.scene.view.rotation = {0, float(std::sin(turn / 2)), 0, float(std::cos(turn / 2))};
        const Result<Scene> lit = with_light_rig(model.scene, LightRig::studio, {});
        ASSERT_TRUE(lit);
        const Vec3d right = to_affine(model.scene.view.rotation).x, back = to_affine(model.scene.view.rotation).z;
        std::vector<Vec3d> at;
        for (const auto& [id, node] : lit->nodes)
            if (node.light) at.push_back(to_double(node.local.translation));
        EXPECT_LT(dot(at[0], right), 0) << "key: left";
        EXPECT_GT(dot(at[0], back), 0) << "and in front";
        EXPECT_GT(at[0].y, 0) << "and above";
        EXPECT_GT(dot(at[1], right), 0) << "fill: right";
        EXPECT_LT(dot(at[2], back), 0) << "rim: behind";
    }
}

// In a closed room the softboxes are inside the walls and give the same illuminance.
TEST(LightRig, StudioStaysInsideOfARoom) {
    Model room({3, 1.5f, 4});
    room.scene.view.position = {0, 0, 3};
    room.scene.view.pivot_distance = 3;
    const Result<Scene> lit = with_light_rig(room.scene, LightRig::studio, {});
    ASSERT_TRUE(lit);
    for (const auto& [id, node] : lit->nodes) {
        if (!node.light) continue;
        const Vec3 p = node.local.translation;
        EXPECT_TRUE(std::abs(p.x) < 3 && std::abs(p.y) < 1.5f && std::abs(p.z) < 4) << node.name;
    }
}

TEST(LightRig, SkyGivesTheStatedIlluminance) {
    const Result<Scene> lit = with_light_rig(Model().scene, LightRig::sky, {});
    ASSERT_TRUE(lit);
    EXPECT_TRUE(has_light(*lit));
    ASSERT_EQ(lit->environment.kind, Environment::Kind::sky);
    const SkyModel sky(lit->environment.sky);
    const SkySun sun = sun_of(lit->environment);
    const double lux = luminance(sky.sky_illuminance()) * double(lit->environment.intensity) + double(luminance(sun.lux) * sun.direction.y);
    EXPECT_NEAR(lux, rig_sky_lux, 1e-3 * rig_sky_lux);
}

// Scenes without anything, of one point, and with the eye in the middle or straight above.
TEST(LightRig, OfUnusualScenesIsValid) {
    Model point({0, 0, 0}), above;
    above.scene.view.position = {0, 9, 0};
    above.scene.view.rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
    Model middle;
    middle.scene.view.position = {0, 0, 0};
    for (const Scene& scene : {Scene{}, point.scene, above.scene, middle.scene})
        for (const LightRig rig : {LightRig::none, LightRig::studio, LightRig::sky}) {
            const Result<Scene> lit = with_light_rig(scene, rig, {});
            ASSERT_TRUE(lit) << lit.error().text();
            EXPECT_EQ(has_light(*lit), rig != LightRig::none);
        }
    EXPECT_EQ(*with_light_rig(above.scene, LightRig::none, {}), above.scene);
}

TEST(LightRig, HasNames) {
    for (const LightRig rig : {LightRig::none, LightRig::studio, LightRig::sky}) EXPECT_EQ(*parse_light_rig(to_string(rig)), rig);
    EXPECT_FALSE(parse_light_rig("moon"));
}

} // namespace
} // namespace blush::TEST_FILE
