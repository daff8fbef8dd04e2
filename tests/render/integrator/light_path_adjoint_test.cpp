// Light paths use the BSDF that paths from the camera use, with both directions exchanged: where shading normals differ from the geometric
// ones (Veach 1997, equation 5.19), through refraction (equation 5.14), and with coats, whose layering is not reciprocal.
#include "tests/render/integrator/caustic_images.h"
#include "tests/support/statistics.h"

#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

// A floor below a sun so large that paths from the camera find it through any surface, seen from above.
Scene floor_in_the_sun(const Vec3& direction) {
    Scene scene;
    place(scene, floor_quad(3), lambert({0.8f, 0.7f, 0.6f}));
    Light sun = caustic_light(Light::Kind::sun, 3);
    sun.angle_radians = 0.4f;
    place_light(scene, sun, aimed({0, 5, 0}, direction));
    scene.view = looking({0.3f, 3, 1.2f}, {0.3f, 0, 0}, 0.7f);
    return scene;
}

// 36 triangles with the normals of a sphere: up to 25 degrees from the geometric ones.
GeometryPtr coarse_ball() {
    Geometry g;
    constexpr int rows = 4, columns = 6;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const float theta = pi * float(i) / rows, phi = 2 * pi * (float(j) + 0.3f) / columns;
            g.positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)});
        }
    for (uint32_t i = 0; i < rows; ++i)
        for (uint32_t j = 0; j < columns; ++j) {
            const uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns, c = a + columns, d = b + columns;
            if (i > 0) g.indices.insert(g.indices.end(), {a, c, b});
            if (i + 1 < rows) g.indices.insert(g.indices.end(), {b, c, d});
        }
    g.normals = g.positions;
    return std::make_shared<const Geometry>(std::move(g));
}

Scene coarse_balls(const Material& left, const Material& right) {
    Scene scene = floor_in_the_sun({0.5f, -1, 0.2f});
    place(scene, coarse_ball(), left, at({-0.4f, 0.5f, 0}, 0.4f));
    place(scene, coarse_ball(), right, at({0.6f, 0.5f, 0.1f}, 0.4f));
    return scene;
}

Material coated(Material m) {
    m.clearcoat = 1;
    m.clearcoat_roughness = 0;
    return m;
}

// Light enters the block at one angle and leaves it at another: the coat takes different shares from the two ends of a path.
Scene coated_block() {
    Scene scene = floor_in_the_sun({1, -0.4f, 0.15f});
    place(scene, cube(false), coated(glass(0, 1.25f)), at({-0.4f, 0.3f, 0}, 0.3f));
    return scene;
}

// A mirror whose coat has a normal map of one slope, so that it mirrors about another normal than the surface's.
Scene tilted_coat() {
    Scene scene = floor_in_the_sun({-1, -0.8f, 0});
    Geometry g = *quad({-0.5f, 0, 1}, {-0.5f, 0, -1}, {-0.5f, 1.5f, -1}, {-0.5f, 1.5f, 1});
    g.serial = next_payload_serial();
    g.normals.assign(4, {1, 0, 0});
    g.tangents.assign(4, {0, 0, -1, 1});
    Material wall = coated(metal(0)); // metal, because a coat alone makes no caster
    const std::vector<Vec3> slope{{0.75f, 0.65f, 0.9f}};
    wall.clearcoat_normal_texture.texture = add_texture(scene, float_image(1, 1, slope));
    place(scene, std::make_shared<const Geometry>(std::move(g)), wall);
    return scene;
}

std::vector<std::pair<const char*, Scene>> adjoint_scenes() {
    return {{"mirror and smooth glass with shading normals", coarse_balls(metal(0), glass(0, 1.5f))},
            {"rough metal and rough glass with shading normals", coarse_balls(metal(0.2f), glass(0.2f, 1.5f))},
            {"coated block of glass", coated_block()},
            {"coat with a normal map", tilted_coat()}};
}

TEST(LightPathAdjoint, GivesTheLightThatPathsOfTheCameraFind) {
    for (const auto& [name, scene] : adjoint_scenes()) {
        SCOPED_TRACE(name);
        RenderSettings settings = settings_for(36, 36, 128);
        const auto without =
            caustic_blocks(scene, settings, {.light_path_share = 0.f, .manifold_sampling = false}, "light paths", false, 20, 1);
        settings.spp = 16;
        const auto with =
            caustic_blocks(scene, settings, {.light_path_share = 2.f, .manifold_sampling = false}, "light paths", true, 20, 1000);
        EXPECT_TRUE(same_means(with, without));
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
