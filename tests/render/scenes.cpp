#include "tests/render/scenes.h"

#include "io/gltf/read/import.h"

#include <stdexcept>

namespace blush::test {

Scene shipped_scene(const std::string& name) {
    auto imported = import_gltf(std::string(BLUSH_ASSETS) + "/scenes/" + name + ".gltf");
    if (!imported) throw std::runtime_error(imported.error().text());
    return std::move(imported->scene);
}
Material window_glass(const Vec3& tint) {
    Material pane = glass(0, 1.5f);
    pane.thickness = 0;
    pane.base_color = tint;
    return pane;
}
void place_sphere_light(Scene& scene, const Vec3& position, float radius, float intensity) {
    Light light;
    light.kind = Light::Kind::sphere;
    light.radius = radius;
    light.intensity = intensity;
    place_light(scene, light, at(position));
}

Scene glass_ball_in_sun() {
    Scene scene;
    place(scene, floor_quad(3), lambert(0.7f));
    place(scene, sphere(false), glass(0, 1.5f), at({0, 1, 0}, 0.7f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.angle_radians = 0.2f;
    sun.intensity = 3;
    place_light(scene, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    scene.view = looking({0, 2, 5}, {0, 0.5f, 0}, 0.6f);
    return scene;
}
Scene with_wide_lights(const std::string& name) {
    const Scene shipped = shipped_scene(name);
    Scene scene = shipped;
    for (const auto& [id, record] : shipped.lights) {
        Light light = record;
        if (light.kind == Light::Kind::sun) light.angle_radians = 1.2f;
        scene.lights.set(id, light);
    }
    for (const auto& [id, record] : shipped.nodes) {
        Node node = record;
        if (node.name == "lamp") node.local.scale = {8, 1, 8};
        if (node.name == "filament") node.local.scale = {7, 7, 7};
        scene.nodes.set(id, node);
    }
    return scene;
}
Scene floor_under_an_overflowing_bulb() {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    Light bulb;
    bulb.intensity = 1e38f;
    place_light(scene, bulb, at({0, 0.3f, 0}));
    scene.view = looking_down(1, 1);
    return scene;
}
const std::vector<std::string>& shipped_scene_names() {
    static const std::vector<std::string> names = {"card-and-mug", "cornell", "corridor", "furnace", "veach-mis"};
    return names;
}
const std::vector<std::string>& caustic_scene_names() {
    static const std::vector<std::string> names = {"bulb", "metal-ring", "pool", "prism", "wine-glass"};
    return names;
}

} // namespace blush::test
