// From an imported scene to its first image, coarse as the window shows it: the Cornell box as it is, and the same with textures, a sky and
// a view transform. What is not needed must not be paid for. Seconds of all cores, in turns.
#include "tests/bench/bench.h"

#include "color/color_management.h"
#include "render/renderer.h"

#include <algorithm>

namespace blush::bench {
namespace {

constexpr int first_divider = 8;

// Values in [0, 1] without a pattern that could be cached or compressed away.
float speckle(size_t i) { return float((i * 2654435761u >> 8) & 0xffff) / 65535.f; }

ImagePtr byte_image(int side) {
    Image image{.width = side, .height = side, .channels = 3, .bytes = {}, .floats = {}};
    image.bytes.resize(3 * size_t(side) * size_t(side));
    for (size_t i = 0; i < image.bytes.size(); ++i) image.bytes[i] = uint8_t(255 * speckle(i));
    return std::make_shared<const Image>(std::move(image));
}

ImagePtr sky_image(int width, int height) {
    Image image{.width = width, .height = height, .channels = 3, .bytes = {}, .floats = {}};
    image.floats.resize(3 * size_t(width) * size_t(height));
    for (size_t i = 0; i < image.floats.size(); ++i) image.floats[i] = speckle(i);
    return std::make_shared<const Image>(std::move(image));
}

// Two images of 2048 x 2048 texels and a sky of 4096 x 2048: what a furnished scene has several of.
Scene with_everything(Scene scene) {
    std::vector<Id<Texture>> textures;
    for (int i = 0; i < 2; ++i) {
        Texture texture;
        texture.image = byte_image(2048);
        textures.push_back(scene.textures.add(texture));
    }
    std::vector<std::pair<Id<Material>, Material>> changed;
    for (const auto& [id, material] : scene.materials) changed.emplace_back(id, material);
    for (auto& [id, material] : changed) {
        material.base_color_texture.texture = textures[0];
        material.specular = 1;
        material.metallic_roughness_texture.texture = textures[1];
        scene.materials.set(id, material);
    }
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = sky_image(4096, 2048);
    return scene;
}

double core_seconds_to_first_image(const Scene& scene, bool through_view, const Options& options) {
    return cost_of([&] {
               Renderer renderer({.threads = options.threads, .planes = {}});
               renderer.update(scene, window_settings());
               renderer.set_divider(first_divider);
               renderer.render(0, 1);
               const Frame frame = renderer.resolve();
               if (!through_view) return;
               const auto color = ColorManagement::load(BLUSH_ASSETS);
               if (!color) return;
               std::vector<float> rgb;
               for (size_t i = 0; i < frame.rgba.size(); ++i)
                   if (i % 4 != 3) rgb.push_back(frame.rgba[i]);
               if (!color->apply_display({}, {}, 1, 1, rgb.data(), rgb.size() / 3)) rgb.clear();
           })
        .core_seconds;
}

} // namespace

Json run_startup(const Options& options) {
    const auto cornell = std::ranges::find(options.scenes, "cornell.gltf", &BenchScene::name);
    if (cornell == options.scenes.end()) return nullptr;
    const Scene everything = with_everything(cornell->scene);
    std::vector<double> plain, full, ratios;
    for (int round = 0; round < options.rounds; ++round) {
        plain.push_back(core_seconds_to_first_image(cornell->scene, false, options));
        full.push_back(core_seconds_to_first_image(everything, true, options));
        ratios.push_back(plain.back() / full.back());
    }
    return {{"scene", cornell->name()},
            {"plain_core_ms", rounded(1e3 * median(plain))},
            {"with_textures_sky_and_view_core_ms", rounded(1e3 * median(full))},
            {"plain_over_full", rounded(median(ratios))}};
}

} // namespace blush::bench
