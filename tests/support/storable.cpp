#include "tests/support/storable.h"

#include "io/image/image_channels.h"

namespace blush::test {

Project storable(Project project) {
    Scene& scene = project.scene;
    const Table<Texture> textures = scene.textures;
    for (auto [id, texture] : textures) {
        texture.image = with_color_channels(texture.image);
        scene.textures.set(id, texture);
    }
    const Table<Light> lights = scene.lights;
    for (auto [id, light] : lights) {
        if (light.ies_file.empty()) light.ies = nullptr;
        scene.lights.set(id, light);
    }
    return project;
}

} // namespace blush::test
