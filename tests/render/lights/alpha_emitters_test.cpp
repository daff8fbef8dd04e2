// Emitters with alpha (of factor, texture and vertices; blended and masked): NEE gives as much light as BSDF sampling finds.
#include "core/distribution.h"
#include "render/compile/render_scene.h"
#include "render/compile/update_plan.h"
#include "tests/render/irradiance.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <array>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using statistics::sidak;
using statistics::significance;

// 8 bits, RGBA; alpha by texel.
ImagePtr alpha_image(int width, int height, std::initializer_list<uint8_t> alphas) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = 4;
    for (const uint8_t a : alphas) image.bytes.insert(image.bytes.end(), {255, 255, 255, a});
    return std::make_shared<const Image>(std::move(image));
}

struct Panel {
    const char* name;
    Scene scene;
};

// An emissive panel over a floor and a box, both seen from the side.
template <class Change> Panel panel(const char* name, const Change& change) {
    Panel p{name, {}};
    place(p.scene, floor_quad(3), lambert(0.6f));
    place(p.scene, cube(false), plastic(0.4f), at({0.2f, 0.4f, 0}, 0.4f));
    Material glow = emitter(4, 0.3f);
    auto geometry = std::make_shared<Geometry>(*ceiling_quad(1, 2));
    change(p.scene, glow, *geometry);
    place(p.scene, geometry, glow);
    p.scene.view = looking({0, 1.6f, 4}, {0, 0.6f, 0}, 0.9f);
    return p;
}

std::vector<Panel> panels() {
    std::vector<Panel> all;
    all.push_back(panel("blended factor", [](Scene&, Material& m, Geometry&) {
        m.alpha = Material::Alpha::blend;
        m.opacity = 0.3f;
    }));
    all.push_back(panel("masked away", [](Scene&, Material& m, Geometry&) {
        m.alpha = Material::Alpha::mask;
        m.opacity = 0.3f;
    }));
    all.push_back(panel("masked by texture", [](Scene& scene, Material& m, Geometry&) {
        m.alpha = Material::Alpha::mask;
        m.base_color_texture.texture = add_texture(scene, alpha_image(2, 2, {255, 0, 0, 255}));
    }));
    all.push_back(panel("blended by texture", [](Scene& scene, Material& m, Geometry&) {
        m.alpha = Material::Alpha::blend;
        m.base_color_texture.texture = add_texture(scene, alpha_image(2, 1, {230, 40}));
    }));
    all.push_back(panel("vertex alpha", [](Scene&, Material& m, Geometry& g) {
        m.alpha = Material::Alpha::blend;
        g.colors = {{1, 1, 1, 1}, {1, 1, 1, 0.1f}, {1, 1, 1, 0.5f}, {1, 1, 1, 0}};
    }));
    all.push_back(panel("texture of light and alpha, two-sided", [](Scene& scene, Material& m, Geometry&) {
        m.alpha = Material::Alpha::blend;
        m.opacity = 0.8f;
        m.double_sided = true;
        const std::array<Vec3, 2> colors{Vec3{1, 0.2f, 0.1f}, Vec3{0.1f, 0.3f, 1}};
        m.emissive_texture.texture = add_texture(scene, float_image(2, 1, colors));
        m.base_color_texture.texture = add_texture(scene, alpha_image(1, 2, {250, 60}));
    }));
    return all;
}

std::vector<Measured> shot(const Scene& scene, Strategy strategy, int64_t spp) {
    RenderSettings settings = settings_for(32, 32, spp);
    settings.strategy = strategy;
    settings.seed = 1 + uint32_t(strategy);
    return render(scene, settings).blocks(16, 16);
}

TEST(AlphaOfEmitters, IsTheSameForEveryStrategy) {
    const double each = sidak(significance, 2 * 6);
    for (const Panel& p : panels()) {
        const auto mis = shot(p.scene, Strategy::mis, 128);
        EXPECT_TRUE(same_means(mis, shot(p.scene, Strategy::light, 128), each)) << p.name;
        EXPECT_TRUE(same_means(mis, shot(p.scene, Strategy::bsdf, 512), each)) << p.name;
    }
}

// A panel of opacity a gives a times the light (closed form).
TEST(AlphaOfEmitters, DimsInProportion) {
    Light corners;
    corners.kind = Light::Kind::rectangle;
    corners.width = corners.height = 2;
    const auto where = rectangle_corners(corners, aimed({0, 2, 0}, {0, -1, 0}));
    for (const bool textured : {false, true}) {
        Scene scene;
        Material glow = emitter(4);
        glow.alpha = Material::Alpha::blend;
        if (textured)
            glow.base_color_texture.texture = add_texture(scene, alpha_image(1, 1, {102})); // 0.4
        else
            glow.opacity = 0.4f;
        place(scene, ceiling_quad(1, 2), glow);
        EXPECT_TRUE(shows_on_floor(scene, [&](const Vec3d& point) { return 0.4 * 4 * polygon_irradiance(point, {0, 1, 0}, where); }));
    }
}

// Selection probabilities follow the emitted light: two panels, one with a quarter of the opacity.
TEST(AlphaOfEmitters, ScalesSelectionProbabilities) {
    for (const bool textured : {false, true}) {
        Scene scene;
        place(scene, ceiling_quad(1, 2), emitter(1));
        Material glow = emitter(1);
        glow.alpha = Material::Alpha::blend;
        if (textured)
            glow.base_color_texture.texture = add_texture(scene, alpha_image(2, 1, {102, 0})); // 0.4 and 0
        else
            glow.opacity = 0.2f;
        place(scene, ceiling_quad(1, 2), glow, at({5, 0, 0}));
        const Workers workers(1);
        RenderScene compiled;
        compiled.update(scene, RenderSettings{}, full_plan(), workers);
        const LightTables& lights = compiled.tables().lights;
        ASSERT_EQ(lights.count, 4);
        // Far above both, where they look alike.
        const Receiver<float> far{{2.5f, -2000, 0}, {0, 1, 0}};
        const auto probability = [&](int32_t i) { return double(light_probability<all_features, float>(lights, far, i, true)); };
        // One choice in 64 is uniform.
        const double dim = 63.0 / 64 * 0.2 / 1.2 + 0.5 / 64;
        EXPECT_NEAR(probability(2) + probability(3), dim, textured ? 0.03 * dim : 1e-4);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
