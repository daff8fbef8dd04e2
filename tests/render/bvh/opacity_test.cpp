// The opacity that rays meet is that which NEE of emitters multiplies by, bit for bit.
#include "render/bvh/opacity.h"
#include "render/compile/render_scene.h"
#include "render/compile/update_plan.h"
#include "tests/render/scenes.h"

#include <bit>
#include <gtest/gtest.h>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

struct Numbers {
    std::mt19937 bits{11};
    float unit() { return float(bits() >> 8) * 0x1p-24f; }
    int below(int n) { return int(bits() % uint32_t(n)); }
};

ImagePtr random_image(Numbers& numbers) {
    Image image;
    image.width = 1 + numbers.below(9);
    image.height = 1 + numbers.below(9);
    image.channels = 3 + numbers.below(2);
    const int values = image.width * image.height * image.channels;
    const bool bytes = numbers.below(2);
    for (int i = 0; i < values; ++i)
        if (bytes)
            image.bytes.push_back(uint8_t(numbers.below(256)));
        else
            image.floats.push_back(1.2f * numbers.unit());
    return std::make_shared<const Image>(std::move(image));
}

// Quads with all that gives alpha.
Scene random_scene(Numbers& numbers) {
    Scene scene;
    for (int i = 0; i < 60; ++i) {
        Geometry g = *floor_quad(1);
        g.serial = next_payload_serial();
        if (numbers.below(2)) g.uv.push_back({{0, numbers.unit()}, {9, 0}, {-3, 4}, {numbers.unit(), -1}});
        if (numbers.below(4) == 0) g.uv.clear();
        if (numbers.below(2))
            for (size_t k = 0; k < g.positions.size(); ++k) g.colors.push_back({1, 1, 1, 1.5f * numbers.unit()});
        Material m;
        m.alpha = numbers.below(2) ? Material::Alpha::blend : Material::Alpha::mask;
        m.opacity = numbers.unit();
        m.alpha_cutoff = numbers.unit();
        if (numbers.below(4)) {
            Texture texture;
            texture.image = random_image(numbers);
            texture.filter = numbers.below(2) ? Texture::Filter::linear : Texture::Filter::nearest;
            texture.wrap_u = Texture::Wrap(numbers.below(3));
            texture.wrap_v = Texture::Wrap(numbers.below(3));
            TextureRef& ref = m.base_color_texture;
            ref.texture = scene.textures.add(texture);
            ref.uv_set = uint8_t(numbers.below(2));
            ref.scale = {3 * numbers.unit(), -numbers.unit()};
            ref.offset = {numbers.unit(), numbers.unit()};
            ref.rotation_radians = 6 * numbers.unit();
        }
        place(scene, std::make_shared<const Geometry>(std::move(g)), m);
    }
    return scene;
}

float by_material(const SceneTables& scene, const PartRecord& part, int triangle, float u, float v) {
    const std::array<float, 3> weights{1 - u - v, u, v};
    std::array<int32_t, 3> vertices{};
    float alpha = part.flags & part_colors ? 0.f : 1.f;
    for (size_t k = 0; k < 3; ++k) {
        vertices[k] = part.first_vertex + int32_t(scene.indices[part.first_index + 3 * triangle + int(k)]);
        if (part.flags & part_colors) alpha += scene.colors[4 * vertices[k] + 3] * weights[k];
    }
    return opacity_at<all_features, float>(scene.materials, part.material, texture_point<float>(scene, part.flags, vertices, weights, true),
                                           alpha, true);
}

TEST(OpacityAtAHit, IsThatOfTheMaterial) {
    Numbers numbers;
    const Workers workers(1);
    int between = 0, clear = 0, opaque = 0;
    for (int round = 0; round < 20; ++round) {
        const Scene scene = random_scene(numbers);
        RenderScene compiled;
        compiled.update(scene, RenderSettings{}, full_plan(), workers);
        const SceneTables& tables = compiled.tables();
        for (int part = 0; part < 60; ++part)
            for (int i = 0; i < 100; ++i) {
                const int triangle = numbers.below(2);
                const float u = numbers.unit(), v = (1 - u) * numbers.unit();
                const float found = opacity_at_hit(tables, part, triangle, u, v);
                ASSERT_EQ(std::bit_cast<uint32_t>(found), std::bit_cast<uint32_t>(by_material(tables, tables.parts[part], triangle, u, v)));
                (found <= 0 ? clear : found >= 1 ? opaque : between)++;
            }
    }
    EXPECT_GT(std::min({between, clear, opaque}), 1000);
}

} // namespace
} // namespace blush::test::TEST_FILE
