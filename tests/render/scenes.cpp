#include "tests/render/scenes.h"

#include "io/gltf/read/import.h"

#include <stdexcept>

namespace blush::test {

Scene shipped_scene(const std::string& name) {
    auto imported = import_gltf(std::string(BLUSH_ASSETS) + "/scenes/" + name + ".gltf");
    if (!imported) throw std::runtime_error(imported.error().text());
    return std::move(imported->scene);
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
