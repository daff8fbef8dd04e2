// Scenes of manifold sampling: smooth balls that cast caustics, under lights of every kind, also between walls; and a pool in which light
// vertices pay.
#pragma once

#include "tests/render/integrator/caustic_images.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace blush::test {

// With interpolated normals, and so fine that they hardly differ from those of the triangles.
inline GeometryPtr round_sphere() {
    constexpr int rows = 48, columns = 96;
    Geometry g;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double theta = std::numbers::pi * i / rows, phi = 2 * std::numbers::pi * j / columns;
            const Vec3 p{float(std::sin(theta) * std::cos(phi)), float(std::cos(theta)), float(std::sin(theta) * std::sin(phi))};
            g.positions.push_back(p);
            g.normals.push_back(p);
        }
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const int right = (j + 1) % columns, above = i * columns, below = above + columns;
            if (i > 0)
                for (const int k : {above + j, above + right, below + right}) g.indices.push_back(uint32_t(k));
            if (i + 1 < rows)
                for (const int k : {above + j, below + right, below + j}) g.indices.push_back(uint32_t(k));
        }
    return std::make_shared<const Geometry>(std::move(g));
}

// Smooth casters of caustics over a floor: a metal and a glass ball.
inline Scene smooth_balls(const Material& floor = lambert({0.7f, 0.6f, 0.5f})) {
    Scene scene;
    place(scene, floor_quad(2), floor);
    place(scene, round_sphere(), metal(0), at({-0.7f, 0.5f, 0}, 0.4f));
    place(scene, round_sphere(), glass(0, 1.5f), at({0.7f, 0.5f, 0.2f}, 0.4f));
    scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    return scene;
}
// Lights so large that paths find them by chance.
inline std::vector<std::pair<const char*, Scene>> lit_scenes() {
    std::vector<std::pair<const char*, Scene>> scenes;
    const auto add = [&](const char* name, const auto& light) { light(scenes.emplace_back(name, smooth_balls()).second); };
    add("triangles", [](Scene& s) { place(s, ceiling_quad(0.7f, 2.5f), emitter(10)); });
    add("two-sided triangles", [](Scene& s) {
        Material lamp = emitter(10);
        lamp.double_sided = true;
        place(s, ceiling_quad(0.7f, 2.5f), lamp);
        place(s, ceiling_quad(2, 4), lambert(0.8f));
    });
    add("spheres of unequal power", [](Scene& s) {
        place_light(s, caustic_light(Light::Kind::point, 20, 0.5f), at({0, 2.5f, 0.5f}));
        place_light(s, caustic_light(Light::Kind::point, 3, 0.5f), at({-1.5f, 2, 0}));
    });
    add("sun", [](Scene& s) {
        Light sun = caustic_light(Light::Kind::sun, 3);
        sun.angle_radians = 0.6f;
        place_light(s, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    });
    // Two spheres, one for a third ball alone and one for all but this, and a sun that does not see it.
    add("linked lights", [](Scene& s) {
        const Id<Node> ball = place(s, round_sphere(), glass(0, 1.5f), at({0, 0.4f, 0.9f}, 0.3f));
        for (const bool all_but : {false, true}) {
            Light light = caustic_light(Light::Kind::point, 20, 0.5f);
            light.color = all_but ? Vec3{1, 0.5f, 0.2f} : Vec3{0.2f, 0.5f, 1};
            light.lit_objects = {all_but, {ball}};
            place_light(s, light, at({all_but ? 0.8f : -0.8f, 2.2f, 0.5f}));
        }
        Light sun = caustic_light(Light::Kind::sun, 3);
        sun.angle_radians = 0.6f;
        sun.lit_objects = {true, {ball}};
        sun.shadow_casters = {true, {ball}};
        place_light(s, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    });
    add("flat and stretched casters, absorption", [](Scene& s) {
        Material green = glass(0, 1.3f);
        green.attenuation_color = {0.3f, 0.9f, 0.5f};
        green.attenuation_distance = 0.5f;
        place(s, cube(false), green, at({0, 0.4f, 0.9f}, 0.25f));
        Transform wide = at({0, 1.2f, -0.5f}, 0.3f);
        wide.scale = {0.5f, 0.15f, 0.3f};
        place(s, round_sphere(), glass(0, 1.5f), wide);
        place(s, ceiling_quad(0.7f, 2.5f), emitter(10));
    });
    return scenes;
}

inline void add_walls(Scene& scene, const Material& material = lambert({0.8f, 0.75f, 0.7f})) {
    const auto wall = [&](const Vec3& center, const Vec3& size) {
        Transform t = at(center);
        t.scale = size;
        place(scene, cube(false), material, t);
    };
    wall({0, 0.8f, -1.6f}, {2, 0.8f, 0.1f});
    wall({-1.8f, 0.8f, 0}, {0.1f, 0.8f, 1.6f});
}

// Walls that see the caustics on the floor.
inline std::vector<std::pair<const char*, Scene>> walled_scenes() {
    auto scenes = lit_scenes();
    for (auto& [name, scene] : scenes) add_walls(scene);
    return scenes;
}

// Surfaces with other lobes than a Lambertian one: chains begin there, too.
inline std::vector<std::pair<const char*, Material>> rough_materials() {
    std::vector<std::pair<const char*, Material>> materials;
    const auto add = [&](const char* name, const Material& base, const auto& change) { change(materials.emplace_back(name, base).second); };
    const Material paint = lambert({0.7f, 0.6f, 0.5f});
    add("plastic", paint, [](Material& m) { m.specular = 1, m.roughness = 0.4f; });
    add("polish", paint, [](Material& m) { m.specular = 1, m.roughness = 0; }); // a delta lobe on a diffuse base
    add("metal", metal(0.35f), [](Material&) {});
    add("coat and sheen", paint, [](Material& m) {
        m.clearcoat = 0.8f, m.clearcoat_roughness = 0.3f;
        m.sheen_color = {0.5f, 0.3f, 0.2f}, m.sheen_roughness = 0.5f;
    });
    return materials;
}

// Solids that spread light by its wavelength: a ball, and a cube that also reflects it totally. A second ball does not.
inline Scene dispersive_solids() {
    Scene scene;
    place(scene, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
    Material flint = glass(0, 1.5f);
    flint.dispersion = 4;
    place(scene, round_sphere(), flint, at({-0.7f, 0.5f, 0}, 0.4f));
    place(scene, cube(false), flint, at({0.7f, 0.4f, 0.2f}, 0.25f));
    place(scene, round_sphere(), glass(0, 1.5f), at({0, 0.3f, 0.9f}, 0.25f));
    place(scene, ceiling_quad(0.7f, 2.5f), emitter(10));
    scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    return scene;
}

// A block of water of the size of the pool, whose top has waves that focus on the bottom. Its sides are in the walls.
inline GeometryPtr waves() {
    constexpr int n = 48;
    Geometry g;
    const auto height = [](double x, double z) { return 0.004 * (std::sin(18 * x + 8 * z) + std::sin(6 * x - 22 * z)); };
    const auto slope = [](double x, double z) {
        const double a = std::cos(18 * x + 8 * z), b = std::cos(6 * x - 22 * z);
        return Vec3{float(-0.004 * (18 * a + 6 * b)), 1, float(-0.004 * (8 * a - 22 * b))};
    };
    const auto add = [&](double x, double y, double z, const Vec3& normal) {
        g.positions.push_back({float(x), float(y), float(z)});
        g.normals.push_back(normalize(normal));
        return uint32_t(g.positions.size() - 1);
    };
    const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        for (const uint32_t i : {a, b, c, a, c, d}) g.indices.push_back(i);
    };
    const auto side_of = [](int i) { return -1.05 + 2.1 * i / n; };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) add(side_of(i), height(side_of(i), side_of(j)), side_of(j), slope(side_of(i), side_of(j)));
    const auto top = [](int i, int j) { return uint32_t(i * (n + 1) + j); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) quad(top(i, j), top(i, j + 1), top(i + 1, j + 1), top(i + 1, j));
    const auto bottom = [&](double x, double z) { return add(x, -1.05, z, {0, -1, 0}); };
    const uint32_t corners[4] = {bottom(-1.05, -1.05), bottom(1.05, -1.05), bottom(1.05, 1.05), bottom(-1.05, 1.05)};
    quad(corners[0], corners[1], corners[2], corners[3]);
    // Sides, from the edges of the top to the bottom.
    const auto strip = [&](const Vec3& normal, auto&& x, auto&& z) {
        for (int i = 0; i < n; ++i) {
            const double x0 = x(i), z0 = z(i), x1 = x(i + 1), z1 = z(i + 1);
            quad(add(x0, height(x0, z0), z0, normal), add(x1, height(x1, z1), z1, normal), add(x1, -1.05, z1, normal),
                 add(x0, -1.05, z0, normal));
        }
    };
    strip({0, 0, -1}, side_of, [](int) { return -1.05; });
    strip(
        {-1, 0, 0}, [](int) { return -1.05; }, [&](int i) { return side_of(n - i); });
    strip(
        {0, 0, 1}, [&](int i) { return side_of(n - i); }, [](int) { return 1.05; });
    strip(
        {1, 0, 0}, [](int) { return 1.05; }, side_of);
    return std::make_shared<const Geometry>(std::move(g));
}

// White walls and bottom under waves, and a sun, by default of half a degree, whose reflection the camera does not see.
inline Scene deep_pool(float sun_angle_radians = 0.0087f, const Material& walls = lambert(0.8f)) {
    Scene scene;
    const auto wall = [&](const Vec3& center, const Vec3& size) {
        Transform t = at(center);
        t.scale = size;
        place(scene, cube(false), walls, t);
    };
    wall({0, -1.1f, 0}, {1.1f, 0.1f, 1.1f});
    for (const float side : {-1.f, 1.f}) {
        wall({1.1f * side, -0.4f, 0}, {0.1f, 0.7f, 1.1f});
        wall({0, -0.4f, 1.1f * side}, {1.1f, 0.7f, 0.1f});
    }
    Material water = glass(0, 1.33f);
    place(scene, waves(), water);
    Light sun = caustic_light(Light::Kind::sun, 4);
    sun.angle_radians = sun_angle_radians;
    place_light(scene, sun, aimed({0, 5, 0}, {0.9f, -1, 0.2f}));
    scene.view = looking({0.3f, 3, 1.5f}, {0, -0.6f, 0}, 0.6f);
    return scene;
}

// The walls of a pool above its water, under a sun so wide that paths find it by chance.
inline Scene dry_walls(float sun_angle_radians = 0.6f, const Material& walls = lambert(0.8f)) {
    Scene scene = deep_pool(sun_angle_radians, walls);
    scene.view = looking({0.9f, 0.9f, 0.9f}, {-0.9f, 0.1f, -0.9f}, 0.6f);
    return scene;
}

} // namespace blush::test
