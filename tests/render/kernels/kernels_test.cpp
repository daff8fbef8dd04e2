// All kernels agree with the scalar reference: every instruction set and every superset of features is bit-identical.
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/integrator/kernel_settings.h"
#include "render/kernels/kernel.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <cstring>
#include <memory>

namespace blush::test::TEST_FILE {
namespace {

constexpr int size = 24, samples = 4;

struct Tile {
    std::vector<double> values; // radiance and first-hit data
    int64_t rays = 0;
};

// A scene compiled once for many kernels.
struct Compiled {
    RenderSettings settings = settings_for(size, size, samples);
    Workers workers{1};
    RenderScene scene;

    explicit Compiled(const Scene& s, bool compensate = false, int reuse = 1, SamplerType sampler = SamplerType::sobol,
                      const MisHeuristic& heuristic = {}) {
        settings.reuse = reuse;
        settings.heuristic = heuristic;
        settings.sampler = sampler;
        settings.energy_compensation = compensate;
        scene.update(expand_area_lights(s), settings, full_plan(), workers);
    }

    Tile render(const Kernel& kernel) const {
        const KernelContext context{&scene.tables(), &scene.accel(), kernel_settings(settings, size, size), settings.seed};
        const TileJob job{0, 0, size, size, 0, samples};
        const auto scratch = std::make_unique<TileScratch>();
        scratch->first = std::make_unique<FirstHitColumns>();
        workers.run([&] { kernel.render(context, job, *scratch); });
        Tile tile;
        FirstHitColumns& f = *scratch->first;
        for (const Column<double>* column : {&scratch->r, &scratch->g, &scratch->b})
            tile.values.insert(tile.values.end(), column->data, column->data + job.paths());
        for (const Column<float>* column : {&f.albedo_r, &f.albedo_g, &f.albedo_b, &f.normal_x, &f.normal_y, &f.normal_z, &f.depth})
            tile.values.insert(tile.values.end(), column->data, column->data + job.paths());
        tile.rays = scratch->camera_rays + scratch->bounce_rays + scratch->shadow_rays;
        return tile;
    }
};

// Number of values of `b` whose bits differ from `a`.
int64_t differing_bits(const Tile& a, const Tile& b) {
    int64_t n = 0;
    for (size_t i = 0; i < a.values.size(); ++i) n += std::memcmp(&a.values[i], &b.values[i], sizeof(double)) != 0;
    return n;
}

void expect_same_bits_from_all_kernels(const Compiled& compiled) {
    const Tile oracle = compiled.render(kernels_of("scalar").back());
    ASSERT_GT(*std::max_element(oracle.values.begin(), oracle.values.end()), 0);
    int compared = 0;
    for (const std::string_view isa : runnable_isas())
        for (const Kernel& kernel : kernels_of(isa)) {
            if (!kernel.features.contains(compiled.scene.features())) continue;
            const Tile tile = compiled.render(kernel);
            EXPECT_EQ(differing_bits(oracle, tile), 0) << kernel.isa << "/" << kernel.name;
            EXPECT_EQ(oracle.rays, tile.rays) << kernel.isa << "/" << kernel.name;
            ++compared;
        }
    EXPECT_GE(compared, int(runnable_isas().size()));
}

TEST(Kernels, GiveTheSameBitsOnShippedScenes) {
    for (const std::string& name : shipped_scene_names()) {
        SCOPED_TRACE(name);
        expect_same_bits_from_all_kernels(Compiled(shipped_scene(name)));
    }
}

TEST(Kernels, GiveTheSameBitsOnCaustics) {
    for (const std::string& name : caustic_scene_names()) {
        SCOPED_TRACE(name);
        expect_same_bits_from_all_kernels(Compiled(shipped_scene(name)));
    }
}

TEST(Kernels, GiveTheSameBitsFromIndependentNumbers) {
    expect_same_bits_from_all_kernels(Compiled(shipped_scene("card-and-mug"), false, 1, SamplerType::random));
}

TEST(Kernels, GiveTheSameBitsWithEachHeuristic) {
    for (const char* heuristic : {"balance", "power=8", "cutoff=0.3", "maximum"}) {
        SCOPED_TRACE(heuristic);
        expect_same_bits_from_all_kernels(Compiled(shipped_scene("veach-mis"), false, 1, SamplerType::sobol, *parse_heuristic(heuristic)));
    }
}

TEST(Kernels, GiveTheSameBitsWhenPathsAreShared) {
    for (const char* name : {"cornell", "corridor"})
        for (const int reuse : {4, 8, 16}) {
            SCOPED_TRACE(name + std::to_string(reuse));
            expect_same_bits_from_all_kernels(Compiled(shipped_scene(name), false, reuse));
        }
}

// A scene with every feature, seen through a lens.
Scene everything() {
    Scene scene;
    std::vector<Vec3> texels;
    for (int i = 0; i < 64; ++i) texels.push_back({0.1f + float(i % 7) / 8, 0.5f, 0.2f + float(i % 5) / 7});
    const Id<Texture> noise = add_texture(scene, float_image(8, 8, texels), Texture::Filter::linear);

    Geometry g = *floor_quad(3);
    g.serial = next_payload_serial();
    g.normals.assign(4, {0, 1, 0});
    g.tangents.assign(4, {1, 0, 0, 1});
    g.colors = {{1, 0.5f, 0.5f, 1}, {0.5f, 1, 0.5f, 0.8f}, {0.5f, 0.5f, 1, 0.6f}, {1, 1, 1, 1}};
    Material ground = plastic(0.4f);
    ground.base_color_texture.texture = ground.metallic_roughness_texture.texture = ground.normal_texture.texture = noise;
    place(scene, std::make_shared<const Geometry>(g), ground);

    Material clear = glass(0.1f, 1.5f);
    clear.attenuation_color = {0.5f, 0.9f, 0.7f};
    clear.attenuation_distance = 0.5f;
    place(scene, sphere(false), clear, at({-1, 0.7f, 0}, 0.6f));
    Material veil = lambert(0.8f);
    veil.alpha = Material::Alpha::blend;
    veil.opacity = 0.5f;
    place(scene, cube(false), veil, at({0.9f, 0.5f, 0.4f}, 0.4f));
    Material lamp = emitter(3, 0.5f);
    lamp.emissive_texture.texture = noise;
    place(scene, cube(false), lamp, at({0.2f, 0.2f, -1.2f}, 0.2f));
    place(scene, cube(false), unlit({0.2f, 0.4f, 0.6f}), at({-0.4f, 0.1f, 1.2f}, 0.1f));
    const Id<Mesh> twice = scene.meshes.add({"", {{sphere(false), scene.materials.add(metal(0.3f))}}});
    for (const float x : {0.2f, 1.8f}) {
        Node node;
        node.mesh = twice;
        node.local = at({x, 0.3f, -0.4f}, 0.3f);
        node.local.scale.x = -0.3f;
        scene.nodes.add(node);
    }

    Light light;
    light.intensity = 3;
    place_light(scene, light, at({0, 2, 1}));
    light.kind = Light::Kind::spot;
    place_light(scene, light, aimed({-2, 2, 1}, {1, -1, 0}));
    light.radius = 0.1f;
    place_light(scene, light, aimed({-1.5f, 1, 0.5f}, {1, -0.5f, 0}));
    light.kind = Light::Kind::sphere;
    light.visible_to_camera = false;
    place_light(scene, light, at({0.5f, 0.9f, 0.4f}, 0.7f));
    light.kind = Light::Kind::disk;
    light.spread_radians = 1;
    place_light(scene, light, aimed({1, 1.5f, 1}, {-1, -1, -1}));
    light.kind = Light::Kind::sun;
    light.angle_radians = 0.02f;
    place_light(scene, light, aimed({0, 0, 0}, {-1, -2, -1}));
    light.kind = Light::Kind::rectangle;
    place_light(scene, light, aimed({2, 2, 2}, {-1, -1, -1}));
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = float_image(8, 8, texels);
    scene.view = looking({1, 2.5f, 4}, {0.2f, 0.3f, 0}, 0.8f);
    scene.view.lens.aperture_radius = 0.05f;
    scene.view.lens.focus_distance = 4;
    return scene;
}

TEST(Kernels, GiveTheSameBitsOnASceneWithAllFeatures) {
    Scene scene = everything();
    expect_same_bits_from_all_kernels(Compiled(scene, true));
    expect_same_bits_from_all_kernels(Compiled(scene, true, 16));
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 2;
    expect_same_bits_from_all_kernels(Compiled(scene));
}

// Shadow rays through many of them, and through window glass between them.
TEST(Kernels, GiveTheSameBitsOnBlendedSurfaces) {
    Scene scene = everything();
    Material veil = lambert(0.7f);
    veil.alpha = Material::Alpha::blend;
    for (int i = 0; i < 12; ++i) {
        veil.opacity = 0.07f * float(i + 1);
        place(scene, floor_quad(1), veil, aimed({0.3f, 0.8f + 0.1f * float(i), 0}, {0.1f * float(i % 3), -0.3f, 1}));
    }
    expect_same_bits_from_all_kernels(Compiled(scene));
    expect_same_bits_from_all_kernels(Compiled(scene, false, 16));
    place(scene, floor_quad(2, 1.25f), window_glass());
    const Compiled glazed(scene);
    EXPECT_TRUE(glazed.scene.tables().panes && glazed.scene.tables().blends);
    expect_same_bits_from_all_kernels(glazed);
}

TEST(Kernels, GiveTheSameBitsOnCoatsSheenAndFilms) {
    Scene scene = everything();
    int next = 0;
    for (const auto& [id, material] : Table<Material>(scene.materials)) {
        Material m = material;
        const int k = next++;
        m.clearcoat = k % 2 ? 0.8f : 0;
        m.clearcoat_roughness = 0.1f * float(k % 3);
        m.clearcoat_normal_texture = m.normal_texture;
        if (k % 3 == 0) m.sheen_color = {0.5f, 0.4f, 0.6f};
        m.sheen_roughness = 0.4f;
        m.anisotropy = k % 3 == 1 ? 0.7f : 0;
        m.anisotropy_texture = m.base_color_texture;
        m.iridescence = k % 4 < 2 ? 0.9f : 0;
        m.diffuse_transmission = k % 3 == 2 ? 0.5f : 0;
        m.dispersion = 1;
        scene.materials.set(id, m);
    }
    const Compiled compiled(scene, true);
    EXPECT_TRUE(compiled.scene.features().contains(layer_features));
    expect_same_bits_from_all_kernels(compiled);
    expect_same_bits_from_all_kernels(Compiled(scene, false, 16));
}

// Most scenes have no such material, and their kernels contain no code for it.
// Of those without light paths, and of those with them.
TEST(Kernels, OnlyTheLargestHasLayers) {
    for (const std::string_view isa : runnable_isas()) {
        int know[2] = {0, 0};
        for (const Kernel& kernel : kernels_of(isa))
            know[kernel.features.has(Feature::light_paths)] += (kernel.features.bits & layer_features.bits) != 0;
        EXPECT_EQ(know[0], 1);
        EXPECT_EQ(know[1], 1);
    }
}

TEST(Kernels, GiveTheSameBitsWithManyLights) {
    Scene scene = everything();
    for (int i = 0; i < 60; ++i) {
        Light light;
        light.kind = i % 3 == 0 ? Light::Kind::spot : i % 3 == 1 ? Light::Kind::point : Light::Kind::rectangle;
        light.width = light.height = 0.1f;
        light.radius = i % 4 == 0 ? 0.05f : 0.f;
        light.intensity = 0.1f + 0.03f * float(i);
        place_light(scene, light, aimed({float(i % 8) - 4, 1.5f + 0.1f * float(i % 5), float(i / 8) - 3}, {0.1f * float(i % 3), -1, 0.2f}));
    }
    const Compiled compiled(scene);
    EXPECT_TRUE(compiled.scene.features().has(Feature::light_tree));
    expect_same_bits_from_all_kernels(compiled);
}

// Emissive meshes with and without a table by direction, near and far away.
TEST(Kernels, GiveTheSameBitsWithEmissiveMeshes) {
    Scene scene = everything();
    auto sparks = std::make_shared<Geometry>();
    for (uint32_t i = 0; i < 3 * 1500; ++i) {
        const uint32_t bits = pcg_hash(i), turn = pcg_hash(i / 3 + 7000);
        sparks->positions.push_back({0.7f * float(turn & 255u) / 255 + 0.02f * float(bits & 15u),
                                     0.7f * float(turn >> 8 & 255u) / 255 + 0.02f * float(bits >> 4 & 15u),
                                     0.7f * float(turn >> 16 & 255u) / 255 + 0.02f * float(bits >> 8 & 15u)});
        sparks->indices.push_back(i);
    }
    place(scene, sparks, emitter(3), at({-1, 1, -1}, 0.5f));
    place(scene, sphere(false), emitter(2), at({3, 2, -2}, 0.2f));
    const Compiled compiled(scene);
    EXPECT_TRUE(compiled.scene.features().has(Feature::light_tree));
    expect_same_bits_from_all_kernels(compiled);
}

TEST(Kernels, TheSmallestSufficientOneIsChosen) {
    for (const std::string_view isa : runnable_isas()) {
        for (const Kernel& kernel : kernels_of(isa)) {
            EXPECT_EQ(kernel.isa, isa);
            ASSERT_EQ(setenv("BLUSH_ISA", std::string(isa).c_str(), 1), 0);
            EXPECT_EQ(&choose_kernel(kernel.features), &kernel);
        }
        EXPECT_EQ(choose_kernel(all_features).name, "layered");
    }
    setenv("BLUSH_ISA", "none such", 1);
    EXPECT_EQ(choose_kernel(no_features).isa, runnable_isas().back());
    unsetenv("BLUSH_ISA");
    EXPECT_EQ(choose_kernel(no_features).isa, runnable_isas().back());
}

} // namespace
} // namespace blush::test::TEST_FILE
