// Textures: time and memory to load 64 images of 2048 x 2048 pixels or an environment map, and the cost and benefit of filtering.
#include "tests/bench/big/whole_process.h"
#include "tests/bench/machine.h"

#include "core/files.h"
#include "io/gltf/read/import.h"
#include "io/image/image_io.h"
#include "measure/stability/rendered_image.h"
#include "measure/stability/scenes.h"
#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>

namespace blush::bench {
namespace {

constexpr int texture_count = 64, texture_side = 2048;

// Gradients with noise, like photographs; all different.
void write_texture(const std::filesystem::path& file, int index) {
    std::mt19937 random{uint32_t(index)};
    std::vector<float> rgb;
    rgb.reserve(size_t(texture_side) * texture_side * 3);
    for (int y = 0; y < texture_side; ++y)
        for (int x = 0; x < texture_side; ++x)
            for (int c = 0; c < 3; ++c) {
                const float shade = 0.5f + 0.4f * std::sin(0.01f * float(x * (c + 1) + y * (index % 7 + 1)));
                rgb.push_back(shade + 0.1f * float(random() % 256) / 256);
            }
    if (const auto ok = write_display_image(file, texture_side, texture_side, rgb); !ok) throw std::runtime_error(ok.error().text());
}

// What the maps of a material with three of them are for.
constexpr std::array slots{"baseColorTexture", "metallicRoughnessTexture", "normalTexture"};

Json material_of(int image) { return {{"pbrMetallicRoughness", {{slots[0], {{"index", image}}}}}}; }

// Gives every third material the two images behind its own as further maps.
void share_as_three_maps(Json& gltf) {
    for (size_t i = 0; i + 2 < texture_count; i += 3) {
        gltf["materials"][i]["pbrMetallicRoughness"][slots[1]]["index"] = i + 1;
        gltf["materials"][i][slots[2]]["index"] = i + 2;
        gltf["materials"][i + 1] = gltf["materials"][i + 2] = gltf["materials"][i];
    }
}

// One square per texture. `formats`: file extensions of the images, in turn.
void write_scene(const std::filesystem::path& file, const std::vector<std::string>& formats, bool three_maps) {
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, /* texture coordinates */ 0, 1, 1, 1, 0, 0, 1, 0};
    const auto* bytes = reinterpret_cast<const uint8_t*>(square.data());
    if (const auto ok = write_file(file.parent_path() / "square.bin", {bytes, square.size() * sizeof(float)}); !ok)
        throw std::runtime_error(ok.error().text());
    Json gltf{{"asset", {{"version", "2.0"}}},
              {"buffers", {{{"uri", "square.bin"}, {"byteLength", square.size() * sizeof(float)}}}},
              {"bufferViews", {{{"buffer", 0}, {"byteLength", 48}}, {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 32}}}},
              {"accessors",
               {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}, {"min", {0, 0, 0}}, {"max", {1, 1, 0}}},
                {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}}}}};
    for (int i = 0; i < texture_count; ++i) {
        const std::string name = fmt::format("{}.{}", i, formats[size_t(i) % formats.size()]);
        write_texture(file.parent_path() / name, i);
        gltf["images"].push_back({{"uri", name}});
        gltf["textures"].push_back({{"source", i}});
        gltf["materials"].push_back(material_of(i));
        const Json primitive{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"mode", 5}, {"material", i}};
        gltf["meshes"].push_back({{"primitives", Json::array({primitive})}});
        gltf["nodes"].push_back({{"mesh", i}, {"translation", {i % 8, i / 8, 0}}});
    }
    if (three_maps) share_as_three_maps(gltf);
    const std::string text = gltf.dump();
    if (const auto ok = write_file(file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()}); !ok)
        throw std::runtime_error(ok.error().text());
}

bool has_all_colors(const Scene& scene) {
    return std::ranges::all_of(scene.materials, [](const auto& entry) { return bool(entry.value.base_color_texture.texture); });
}

// What the window shows while it loads the file: seconds until the preview scene, until all textures of colour are shown, and until
// all textures are, most of them smaller than they are.
Json measure_previews(const std::filesystem::path& file) {
    const Clock::time_point begin = Clock::now();
    std::vector<double> shown, with_colors, with_all;
    ImportOptions options;
    options.on_preview_scene = [&](const ImportedScene& preview) {
        shown.push_back(seconds_since(begin));
        if (has_all_colors(preview.scene)) with_colors.push_back(shown.back());
        if (preview.scene.textures.size() == size_t(texture_count)) with_all.push_back(shown.back());
    };
    if (const auto imported = import_gltf(file, options); !imported) throw std::runtime_error(imported.error().text());
    return {{"first_s", shown.empty() ? Json() : Json(rounded(shown[0]))},
            {"all_colors_s", with_colors.empty() ? Json() : Json(rounded(with_colors[0]))},
            {"all_textures_s", with_all.empty() ? Json() : Json(rounded(with_all[0]))},
            {"count", shown.size()},
            {"import_s", rounded(seconds_since(begin))}};
}

Json measure_loading(const std::vector<std::string>& formats, const Options& options, bool three_maps = false) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "scene.gltf";
    write_scene(file, formats, three_maps);
    std::vector<double> import_seconds, import_core_seconds, compile_seconds;
    double peak_mb = 0, decoded_mb = 0, compiled_mb = 0; // compiled: besides the decoded images
    for (int round = 0; round < std::min(options.rounds, 3); ++round) {
        const MemoryGrowth memory;
        std::optional<Result<ImportedScene>> imported;
        const Cost cost = cost_of([&] { imported = import_gltf(file); });
        if (!*imported) throw std::runtime_error((*imported).error().text());
        import_seconds.push_back(cost.wall_seconds);
        import_core_seconds.push_back(cost.core_seconds);
        Renderer renderer({.threads = options.threads, .planes = {}});
        compile_seconds.push_back(cost_of([&] { renderer.update((*imported)->scene, window_settings()); }).wall_seconds);
        peak_mb = std::max(peak_mb, memory.peak_mb());
        compiled_mb = renderer.info().memory_mb;
        decoded_mb = 0;
        for (const auto& [id, texture] : (*imported)->scene.textures) decoded_mb += double(texture.image->bytes.size()) / 1e6;
    }
    return {{"formats", formats},
            {"three_maps_a_material", three_maps},
            {"textures", texture_count},
            {"previews", measure_previews(file)},
            {"side", texture_side},
            {"whole_process", measure_process({file}, folder, options)},
            {"import_seconds", rounded(median(import_seconds))},
            {"import_core_seconds", rounded(median(import_core_seconds))},
            {"compile_seconds", rounded(median(compile_seconds))},
            {"decoded_mb", rounded(decoded_mb)},
            {"compiled_mb", rounded(compiled_mb)},
            {"peak_mb", rounded(peak_mb)}};
}

// The Cornell box under a map of noise.
Json measure_environment(const Options& options) {
    const auto cornell = std::ranges::find(options.scenes, "cornell.gltf", &BenchScene::name);
    if (cornell == options.scenes.end()) return nullptr;
    constexpr int width = 4096, height = 2048;
    const test::TemporaryFolder folder;
    LayeredImage map{.width = width, .height = height, .channels = {}, .metadata = {}};
    std::mt19937 random{1};
    for (const char* name : {"R", "G", "B"}) {
        std::vector<float> values(size_t(width) * height);
        for (float& v : values) v = float(random() % 4096) / 4096;
        map.channels.push_back({name, std::move(values)});
    }
    const std::string file = folder / "map.exr";
    if (const auto written = write_exr(file, map); !written) return {{"failed", written.error().text()}};
    return {{"width", width},
            {"height", height},
            {"whole_process", measure_process({cornell->file, "--env", file}, folder, options)},
            {"without", measure_process({cornell->file}, folder, options)}};
}

// A room seen from inside, whose six sides have textures with squares of one metre.
Scene textured_room(float half) {
    Scene scene;
    std::vector<Vec3> texels;
    for (int i = 0; i < 64 * 64; ++i) texels.push_back((i / 8 + i / 512) % 2 ? Vec3{0.8f, 0.7f, 0.6f} : Vec3{0.1f, 0.2f, 0.3f});
    Material material = stability::lambert(1);
    material.base_color_texture.texture = stability::add_texture(scene, stability::float_image(64, 64, texels), Texture::Filter::linear);
    material.base_color_texture.scale = {half / 4, half / 4};
    stability::place(scene, stability::cube(true), material, stability::at({0, 0, 0}, half));
    Light bulb;
    bulb.intensity = 1000 * half * half;
    stability::place_light(scene, bulb, stability::at({0.3f * half, 0.5f * half, 0}));
    scene.view = stability::looking({-0.9f * half, -0.9f * half, 0}, {half, -half, 0}, 0.7f);
    return scene;
}

double error_squared(const stability::RenderedImage& image) {
    double sum = 0;
    for (const Vec3d& e : image.errors) sum += e.x * e.x + e.y * e.y + e.z * e.z;
    return sum;
}

// Rounds with and without filtering alternate.
Json measure_filtering(const char* name, const Scene& scene, const Options& options) {
    RenderSettings settings = rate_settings();
    settings.width = settings.height = 256;
    settings.max_bounces = 4;
    Renderer filtered({.threads = options.threads, .planes = {}, .filter_textures = true});
    Renderer points({.threads = options.threads, .planes = {}, .filter_textures = false});
    std::vector<double> ratios;
    for (Renderer* renderer : {&filtered, &points}) renderer->update(scene, settings);
    for (int round = 0; round < options.rounds; ++round) {
        const auto seconds = [&](Renderer& renderer) { return cost_of([&] { renderer.render(8 * round, 8); }).core_seconds; };
        const double with = seconds(filtered);
        ratios.push_back(with / seconds(points));
    }
    const double variance_left = error_squared(stability::image_of(filtered)) / error_squared(stability::image_of(points));
    return {{"scene", name},
            {"time_over_unfiltered", rounded(median(ratios))},
            {"time_quartiles", {rounded(quantile(ratios, 0.25)), rounded(quantile(ratios, 0.75))}},
            {"variance_over_unfiltered", rounded(variance_left)}};
}

} // namespace

Json run_textures(const Options& options) {
    return {{"loading",
             {measure_loading({"png"}, options), measure_loading({"png"}, options, true), measure_loading({"jpg"}, options),
              measure_loading({"png", "jpg"}, options)}},
            {"environment", measure_environment(options)},
            {"filtering",
             {measure_filtering("near: texels are magnified", textured_room(1), options),
              measure_filtering("middle: a texel is a pixel", textured_room(30), options),
              measure_filtering("far: hundreds of texels are a pixel", textured_room(10000), options)}}};
}

} // namespace blush::bench
