// Scenes of manifold sampling: smooth balls that cast caustics, under lights of every kind.
#pragma once

#include "tests/render/integrator/caustic_images.h"

#include <cmath>
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
inline Scene smooth_balls() {
    Scene scene;
    place(scene, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
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

} // namespace blush::test
