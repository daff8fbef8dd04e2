#include "tests/bench/bench_scene.h"

#include "core/math.h"
#include "core/sampler.h"
#include "io/gltf/read/import.h"
#include "measure/stability/scenes.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::bench {
namespace {

Result<std::vector<BenchScene>> load_all(const std::vector<std::filesystem::path>& files, bool ours) {
    std::vector<BenchScene> scenes;
    for (const auto& file : files) {
        Result<ImportedScene> imported = import_gltf(file);
        if (!imported) return imported.error();
        scenes.push_back({file, std::move(imported->scene), ours});
    }
    return scenes;
}

// The k-th of a fixed series of numbers in [0, 1).
float number(uint32_t k) { return float(pcg_hash(k) >> 8) * 0x1p-24f; }

// A unit sphere with bumps, of 2 rows^2 triangles or more, with normals and texture coordinates.
GeometryPtr bumpy_sphere(int rows) {
    Geometry g;
    g.uv.resize(1);
    const int columns = rows;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j <= columns; ++j) {
            const double v = double(i) / rows, u = double(j) / columns, theta = std::numbers::pi * v, phi = 2 * std::numbers::pi * u;
            const Vec3d n{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
            g.positions.push_back(to_float(n * (1 + 0.04 * std::sin(18 * theta) * std::sin(13 * phi))));
            g.normals.push_back(to_float(n));
            g.uv[0].push_back({float(u), float(v)});
        }
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const uint32_t a = uint32_t(i * (columns + 1) + j), b = a + uint32_t(columns) + 1;
            g.indices.insert(g.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    return std::make_shared<const Geometry>(std::move(g));
}

// Noise, RGBA of 8 bits.
ImagePtr noise(int size, uint8_t low, uint8_t high) {
    Image image;
    image.width = image.height = size;
    image.channels = 4;
    for (uint32_t i = 0; i < uint32_t(4 * size * size); ++i)
        image.bytes.push_back(i % 4 == 3 ? 255 : uint8_t(low + int(pcg_hash(i) % uint32_t(high - low + 1))));
    return std::make_shared<const Image>(std::move(image));
}

// A leaf with a soft edge on a transparent image.
ImagePtr leaf_image(int size) {
    Image image;
    image.width = image.height = size;
    image.channels = 4;
    for (int i = 0; i < size * size; ++i) {
        const double x = 2 * (i % size + 0.5) / size - 1, y = 2 * (i / size + 0.5) / size - 1;
        const double inside = std::clamp((1 - std::hypot(1.6 * x, y)) / 0.3, 0.0, 1.0);
        image.bytes.insert(image.bytes.end(), {90, 150, 60, uint8_t(std::lround(255 * inside))});
    }
    return std::make_shared<const Image>(std::move(image));
}

void under_a_sky(Scene& scene, const View& view) {
    stability::place(scene, stability::floor_quad(20), stability::lambert(0.5f));
    stability::constant_world(scene, 0.5f);
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 4;
    sun.angle_radians = 0.01f;
    stability::place_light(scene, sun, stability::aimed({0, 9, 0}, {-0.4f, -1, -0.5f}));
    scene.view = view;
}

Scene textured_model() {
    Scene scene;
    Material m = stability::plastic(0.5f);
    m.base_color_texture.texture = stability::add_texture(scene, noise(2048, 60, 220), Texture::Filter::linear);
    m.metallic_roughness_texture.texture = stability::add_texture(scene, noise(1024, 40, 200), Texture::Filter::linear);
    m.metallic = 0.5f;
    stability::place(scene, bumpy_sphere(362), m, stability::at({0, 1, 0}));
    stability::place(scene, stability::floor_quad(5), m);
    std::vector<Vec3> sky;
    for (int i = 0; i < 128 * 64; ++i) {
        const bool sun = i / 128 > 12 && i / 128 < 15 && i % 128 > 40 && i % 128 < 44;
        const float up = 1 - float(i / 128) / 64;
        sky.push_back(sun ? Vec3{300, 280, 240} : Vec3{0.4f, 0.5f, 0.8f} * (0.2f + up));
    }
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = stability::float_image(128, 64, sky);
    scene.view = stability::looking({0, 1.8f, 3.6f}, {0, 0.9f, 0}, 0.8f);
    return scene;
}

Scene foliage(Material::Alpha alpha) {
    Scene scene;
    auto g = std::make_shared<Geometry>();
    g->uv.resize(1);
    for (uint32_t k = 0; k < 60'000; ++k) {
        const auto random = [&](uint32_t which) { return number(16 * k + which); };
        const Vec3d d = normalize(Vec3d{random(0) - 0.5, random(1) - 0.5, random(2) - 0.5} + Vec3d{1e-4, 0, 0});
        const double r = 1.4 * std::cbrt(double(random(3)));
        const Vec3d n = normalize(Vec3d{random(4) - 0.5, random(5) - 0.2, random(6) - 0.5} + Vec3d{1e-4, 0, 0});
        const Vec3d x = any_perpendicular(n) * 0.035, y = cross(n, x);
        const Vec3d at = Vec3d{3 * std::floor(3 * double(random(7))) - 3, 1.7, 0} + d * r;
        const auto first = uint32_t(g->positions.size());
        for (const Vec3d& corner : {at - x - y, at + x - y, at + x + y, at - x + y}) g->positions.push_back(to_float(corner));
        g->uv[0].insert(g->uv[0].end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) g->indices.push_back(first + i);
    }
    Material m = stability::lambert({1, 1, 1});
    m.double_sided = true;
    m.alpha = alpha;
    m.base_color_texture.texture = stability::add_texture(scene, leaf_image(64), Texture::Filter::linear);
    stability::place(scene, g, m);
    under_a_sky(scene, stability::looking({0, 2.5f, 7}, {0, 1.3f, 0}, 0.8f));
    return scene;
}

Scene many_instances() {
    Scene scene;
    const Id<Mesh> mesh = scene.meshes.add({"", {{bumpy_sphere(224), scene.materials.add(stability::lambert({0.6f, 0.5f, 0.4f}))}}});
    for (uint32_t k = 0; k < 1000; ++k) {
        Node node;
        node.mesh = mesh;
        const auto random = [&](uint32_t which) { return number(16 * k + which + (1u << 24)); };
        node.local =
            stability::aimed({12 * random(0) - 6, 2 * random(1), 12 * random(2) - 8}, {random(3) - 0.5f, random(4), random(5) - 0.5f});
        const float scale = 0.15f + 0.2f * random(6);
        node.local.scale = {scale, scale, scale};
        scene.nodes.add(node);
    }
    under_a_sky(scene, stability::looking({0, 3, 7}, {0, 0.8f, -1}, 0.8f));
    return scene;
}

} // namespace

std::vector<BenchScene> generated_scenes() {
    return {{"generated-textures", textured_model(), false},
            {"generated-masked-leaves", foliage(Material::Alpha::mask), false},
            {"generated-blended-leaves", foliage(Material::Alpha::blend), false},
            {"generated-instances", many_instances(), false}};
}

Result<std::vector<BenchScene>> shipped_scenes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(BLUSH_ASSETS) / "scenes"))
        if (entry.path().extension() == ".gltf") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return load_all(files, true);
}

Result<std::vector<BenchScene>> peer_scenes(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const char* name : {"cornell.glb", "cornell_spheres.glb", "dense_cornell.glb"})
        if (std::filesystem::exists(folder / name)) files.push_back(folder / name);
    return load_all(files, false);
}

RenderSettings rate_settings() {
    RenderSettings settings;
    settings.width = settings.height = 512;
    settings.filter = PixelFilter::box;
    return settings;
}

RenderSettings window_settings() {
    RenderSettings settings = recommended_settings();
    settings.width = 1280;
    settings.height = 720;
    settings.spp = 0;
    return settings;
}

} // namespace blush::bench
