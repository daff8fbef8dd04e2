// Time to the first coarse image: the Cornell box as shipped, and with textures, a sky and
// a view transform. Unused features must cost nothing. CPU seconds of all cores, in turn:
// of the engine alone, from an imported scene on, and of the program, from start to end.
#include "tests/bench/big/whole_process.h"

#include "color/color_management.h"
#include "io/image/image_io.h"
#include "render/renderer.h"

#include <algorithm>
#include <fstream>

namespace blush::bench {
namespace {

constexpr int first_divider = 8;
constexpr int texture_side = 2048, sky_width = 4096, sky_height = 2048;

// Values in [0, 1] without a pattern that could be cached or compressed.
float speckle(size_t i) { return float((i * 2654435761u >> 8) & 0xffff) / 65535.f; }

std::vector<float> speckles(int width, int height) {
    std::vector<float> values(3 * size_t(width) * size_t(height));
    for (size_t i = 0; i < values.size(); ++i) values[i] = speckle(i);
    return values;
}

ImagePtr byte_image(int side) {
    Image image{.width = side, .height = side, .channels = 3, .bytes = {}, .floats = {}};
    for (const float value : speckles(side, side)) image.bytes.push_back(uint8_t(255 * value));
    return std::make_shared<const Image>(std::move(image));
}

// Two images of 2048 x 2048 texels and a sky of 4096 x 2048, as in typical furnished scenes.
Scene with_everything(Scene scene) {
    std::vector<Id<Texture>> textures;
    for (int i = 0; i < 2; ++i) {
        Texture texture;
        texture.image = byte_image(texture_side);
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
    Image sky{.width = sky_width, .height = sky_height, .channels = 3, .bytes = {}, .floats = speckles(sky_width, sky_height)};
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = std::make_shared<const Image>(std::move(sky));
    return scene;
}

double engine_core_seconds(const Scene& scene, bool through_view, const Options& options) {
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
               if (!color->apply_display({}, {.exposure_ev = 1}, rgb.data(), rgb.size() / 3)) rgb.clear();
           })
        .core_seconds;
}

// The same scene as files: cornell.gltf with two textures on every surface, and sky.exr.
Result<void> write_everything(const std::filesystem::path& plain, const test::TemporaryFolder& folder) {
    Json gltf = Json::parse(std::ifstream(plain));
    std::filesystem::copy_file(plain.parent_path() / "cornell.bin", folder / "cornell.bin");
    const std::vector<float> texels = speckles(texture_side, texture_side);
    for (int i = 0; i < 2; ++i) {
        const std::string name = std::to_string(i) + ".png";
        if (const auto written = write_display_image(folder / name, texture_side, texture_side, texels); !written) return written;
        gltf["images"].push_back({{"uri", name}});
        gltf["textures"].push_back({{"source", i}});
    }
    for (Json& material : gltf["materials"]) {
        material.erase("extensions");
        material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
        material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}};
    }
    // Texture coordinates with arbitrary values: the bytes of the positions.
    for (Json& mesh : gltf["meshes"])
        for (Json& primitive : mesh["primitives"]) {
            Json coordinates = gltf["accessors"][primitive["attributes"]["POSITION"].get<size_t>()];
            coordinates["type"] = "VEC2";
            coordinates.erase("min");
            coordinates.erase("max");
            primitive["attributes"]["TEXCOORD_0"] = gltf["accessors"].size();
            gltf["accessors"].push_back(coordinates);
        }
    std::ofstream(folder / "full.gltf") << gltf;

    LayeredImage sky{.width = sky_width, .height = sky_height, .channels = {}, .metadata = {}};
    for (const char* name : {"R", "G", "B"}) sky.channels.push_back({name, {}});
    const std::vector<float> values = speckles(sky_width, sky_height);
    for (size_t i = 0; i < values.size(); ++i) sky.channels[i % 3].values.push_back(values[i]);
    return write_exr(folder / "sky.exr", sky);
}

// Runs `blush render` with these arguments; negative if it failed.
double program_core_seconds(std::vector<std::string> arguments, const Options& options) {
    const std::vector<std::string> common{"--spp", "1", "--size", "160x90", "--threads", std::to_string(options.threads), "--quiet"};
    arguments.insert(arguments.begin(), {BLUSH_BINARY, "render"});
    arguments.insert(arguments.end(), common.begin(), common.end());
    const double before = children_core_seconds();
    const test::Finished finished = test::run(arguments);
    return finished.exit_code == 0 ? children_core_seconds() - before : -1;
}

// Alternates two ways of starting; the ratio is the result.
Json compare(const std::function<double()>& plain, const std::function<double()>& full, int rounds) {
    std::vector<double> without, with, ratios;
    for (int round = 0; round < rounds; ++round) {
        without.push_back(plain());
        with.push_back(full());
        ratios.push_back(without.back() / with.back());
    }
    if (std::ranges::min(without) < 0 || std::ranges::min(with) < 0) return {{"failed", "a render did not end well"}};
    return {{"plain_core_ms", rounded(1e3 * median(without))},
            {"with_textures_sky_and_view_core_ms", rounded(1e3 * median(with))},
            {"plain_over_full", rounded(median(ratios))}};
}

} // namespace

Json run_startup(const Options& options) {
    const auto cornell = std::ranges::find(options.scenes, "cornell.gltf", &BenchScene::name);
    if (cornell == options.scenes.end()) return nullptr;
    const Scene everything = with_everything(cornell->scene);
    const test::TemporaryFolder folder;
    if (const auto written = write_everything(cornell->file, folder); !written) return {{"failed", written.error().text()}};
    const std::string out = folder / "out";
    const auto plain_program = [&] { return program_core_seconds({cornell->file, "-o", out + ".exr"}, options); };
    const auto full_program = [&] {
        return program_core_seconds({folder / "full.gltf", "-o", out + ".png", "--env", folder / "sky.exr", "--look", "High contrast"},
                                    options);
    };
    return {{"scene", cornell->name()},
            {"engine", compare([&] { return engine_core_seconds(cornell->scene, false, options); },
                               [&] { return engine_core_seconds(everything, true, options); }, options.rounds)},
            {"program", compare(plain_program, full_program, options.rounds)}};
}

} // namespace blush::bench
