// Scenes of light paths: casters of caustics under lights of every kind, also behind panes and blended surfaces and with light linking.
#pragma once

#include "tests/render/integrator/caustic_images.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace blush::test::light_path_scenes {

// Casters of caustics over a floor: a metal and a glass ball.
inline Scene balls(float roughness) {
    Scene scene;
    place(scene, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
    place(scene, sphere(false), metal(roughness), at({-0.7f, 0.5f, 0}, 0.5f));
    place(scene, sphere(false), glass(roughness, 1.5f), at({0.7f, 0.5f, 0.2f}, 0.5f));
    scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    return scene;
}
// Both rough, so that each strategy finds their light.
inline Scene rough_balls() { return balls(0.2f); }
// One for each kind of emission.
inline std::vector<std::pair<const char*, Scene>> lit_scenes() {
    std::vector<std::pair<const char*, Scene>> scenes;
    const auto add = [&](const char* name, const auto& light) { light(scenes.emplace_back(name, rough_balls()).second); };
    add("one-sided triangles", [](Scene& s) { place(s, ceiling_quad(0.5f, 2.5f), emitter(10)); });
    add("two-sided triangles", [](Scene& s) {
        Material lamp = emitter(10);
        lamp.double_sided = true;
        place(s, ceiling_quad(0.5f, 2.5f), lamp);
        place(s, ceiling_quad(2, 4), lambert(0.8f));
    });
    add("sphere", [](Scene& s) { place_light(s, caustic_light(Light::Kind::point, 20, 0.3f), at({0, 2, 0.5f})); });
    add("point", [](Scene& s) { place_light(s, caustic_light(Light::Kind::point, 20), at({0.2f, 2, 0.5f})); });
    add("parallel sun", [](Scene& s) { place_light(s, caustic_light(Light::Kind::sun, 3), aimed({0, 5, 0}, {0.3f, -1, 0.2f})); });
    add("point beside a sphere", [](Scene& s) {
        place_light(s, caustic_light(Light::Kind::point, 10), at({-0.5f, 2, 0.5f}));
        place_light(s, caustic_light(Light::Kind::point, 10, 0.2f), at({0.8f, 2, 0.5f}));
    });
    add("sun", [](Scene& s) {
        Light sun = caustic_light(Light::Kind::sun, 3);
        sun.angle_radians = 0.3f;
        place_light(s, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    });
    add("rough plastic", [](Scene& s) {
        place(s, floor_quad(1), plastic(0.4f), at({0, 0.01f, 0.8f}));
        place(s, ceiling_quad(0.5f, 2.5f), emitter(10));
    });
    scenes.emplace_back("dispersion", Scene{});
    Scene& prism = scenes.back().second;
    place(prism, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
    Material flint = glass(0.2f, 1.5f);
    flint.dispersion = 4;
    place(prism, sphere(false), flint, at({0, 0.5f, 0.2f}, 0.5f));
    place(prism, ceiling_quad(0.5f, 2.5f), emitter(10));
    prism.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    return scenes;
}

// What lets pass a part of the light, before, between and behind the balls: panes, of which one glows and one is half diffuse, blended
// surfaces, and panes that are blended.
inline Scene with_panes(Scene scene) {
    const Material pane = window_glass({0.9f, 0.6f, 0.8f});
    Material glowing = pane, half = pane;
    glowing.emissive = {1, 2, 3};
    glowing.double_sided = true;
    half.transmission = 0.5f;
    place(scene, floor_quad(0.8f, 1.6f), pane, at({0.5f, 0, 0}));
    place(scene, floor_quad(0.4f, 1.2f), glowing, at({-0.6f, 0, 0.3f}));
    place(scene, quad({-0.5f, 0.1f, 1}, {0.9f, 0.1f, 1}, {0.9f, 0.9f, 1}, {-0.5f, 0.9f, 1}), half);
    return scene;
}
inline Scene with_leaves(Scene scene, bool of_glass) {
    Material leaf = of_glass ? window_glass() : lambert({0.2f, 0.6f, 0.3f});
    leaf.alpha = Material::Alpha::blend;
    leaf.opacity = 0.6f;
    place(scene, floor_quad(0.7f, 1.5f), leaf, at({0.4f, 0, 0}));
    place(scene, floor_quad(0.4f, 1.1f), leaf, at({-0.6f, 0, 0.3f}));
    place(scene, quad({-0.2f, 0.1f, 1.1f}, {1.2f, 0.1f, 1.1f}, {1.2f, 0.9f, 1.1f}, {-0.2f, 0.9f, 1.1f}), leaf);
    return scene;
}
// One light for a third ball alone, one for all but this ball, and one for all.
inline Scene with_links() {
    Scene scene = rough_balls();
    const Id<Node> ball = place(scene, sphere(false), metal(0.2f), at({0, 0.4f, 0.9f}, 0.3f));
    for (const bool all_but : {false, true}) {
        Light light = caustic_light(Light::Kind::point, 20, 0.3f);
        light.color = all_but ? Vec3{1, 0.5f, 0.2f} : Vec3{0.2f, 0.5f, 1};
        light.lit_objects = {all_but, {ball}};
        place_light(scene, light, at({all_but ? 0.6f : -0.6f, 2, 0.5f}));
    }
    place_light(scene, caustic_light(Light::Kind::point, 5, 0.3f), at({0, 2.5f, 0}));
    return scene;
}
// A sphere that one of the balls casts no shadows of, and that does not illuminate the floor: all its light there has left a ball, by lobes
// of which light paths carry none. They carry that of another one.
inline Scene with_own_shadows() {
    Scene scene;
    const Id<Node> floor = place(scene, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
    place(scene, sphere(false), metal(0.2f), at({-0.7f, 0.5f, 0}, 0.5f));
    const Id<Node> without_shadow = place(scene, sphere(false), metal(0.2f), at({0.7f, 0.5f, 0.2f}, 0.5f));
    Light light = caustic_light(Light::Kind::point, 60, 0.3f);
    light.lit_objects = {true, {floor}};
    light.shadow_casters = {true, {without_shadow}};
    place_light(scene, light, at({0.2f, 2, 0.5f}));
    place_light(scene, caustic_light(Light::Kind::point, 1, 0.3f), at({-0.2f, 2, 0.5f}));
    scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    return scene;
}
inline std::vector<std::pair<const char*, Scene>> crossed_scenes() {
    const auto lit = lit_scenes();
    const auto scene_of = [&](std::string_view name) {
        return std::ranges::find(lit, name, [](const auto& scene) { return std::string_view(scene.first); })->second;
    };
    const Scene lamp = scene_of("one-sided triangles"), sun = scene_of("sun");
    return {{"panes", with_panes(lamp)},
            {"panes under a sun", with_panes(sun)},
            {"blended surfaces", with_leaves(lamp, false)},
            {"blended surfaces under a sun", with_leaves(sun, false)},
            {"panes and blended ones", with_leaves(with_panes(lamp), true)},
            {"linked lights", with_links()}};
}

} // namespace blush::test::light_path_scenes
