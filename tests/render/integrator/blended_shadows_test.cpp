// Shadow rays carry the product of the transmittances of blended surfaces: no noise by chance, the same mean as BSDF sampling, and
// masks as before.
#include "render/bvh/transmittance.h"
#include "tests/render/integrator/strategy_shots.h"
#include "tests/render/irradiance.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using statistics::sidak;
using statistics::significance;

// ---- products

TEST(Transmittance, IsFoundFromItsDepth) {
    std::mt19937 bits(1);
    EXPECT_EQ(transmittance_of(0), 1);
    EXPECT_EQ(optical_depth(1), 0u);
    for (int k = 1; k <= 24; ++k) EXPECT_EQ(transmittance_of(optical_depth(std::ldexp(1.f, -k))), std::ldexp(1.f, -k));
    for (int i = 0; i < 100'000; ++i) {
        const float t = std::max(float(bits()) * 0x1p-32f, 0x1p-24f);
        EXPECT_NEAR(transmittance_of(optical_depth(t)), t, 1e-7f * t);
    }
    EXPECT_EQ(transmittance_of(opaque_depth), 0);
    EXPECT_GT(transmittance_of(opaque_depth - (25u << 24)), 0); // the least normal number is 2^-126; rendering flushes smaller ones to 0
}

TEST(Transmittance, OfManySurfacesIsTheProduct) {
    for (const float t : {0.9f, 0.5f, 0.1f})
        for (int n = 1; n <= 30; ++n) {
            const double product = std::pow(double(t), n);
            EXPECT_NEAR(double(transmittance_of(uint32_t(n) * optical_depth(t))), product, (n * 3e-8 + 1e-7) * product);
        }
}

// ---- shadow rays

Material blended(float opacity) {
    Material m = lambert(0.f);
    m.alpha = Material::Alpha::blend;
    m.opacity = opacity;
    m.double_sided = true;
    return m;
}

// Light that the floor reflects once. The camera is below everything but the floor.
RenderedImage direct_light(Scene scene, int64_t spp = 4) {
    place(scene, floor_quad(2), lambert(0.6f));
    scene.view = looking_down(1, 0.1f);
    RenderSettings settings = settings_for(16, 16, spp);
    settings.max_bounces = 1;
    settings.strategy = Strategy::light;
    return render(scene, settings);
}

struct LitScene {
    const char* name;
    Scene scene;
};
std::vector<LitScene> lamps() {
    std::vector<LitScene> all;
    const auto add = [&](const char* name, const std::function<void(Light&)>& change) {
        Light light;
        light.intensity = 3;
        change(light);
        all.push_back({name, {}});
        place_light(all.back().scene, light, aimed({0.3f, 3, 0.2f}, {0, -1, 0}));
    };
    add("point", [](Light&) {});
    add("sun", [](Light& l) { l.kind = Light::Kind::sun; });
    add("wide sun", [](Light& l) { l.kind = Light::Kind::sun, l.angle_radians = 0.2f; });
    add("sphere", [](Light& l) { l.radius = 0.4f; });
    add("rectangle", [](Light& l) { l.kind = Light::Kind::rectangle, l.width = 1.5f, l.height = 0.7f; });
    all.push_back({"emissive mesh", {}});
    place(all.back().scene, sphere(false), emitter(4), at({0.3f, 3, 0.2f}, 0.5f));
    all.push_back({"sky", {}});
    constant_world(all.back().scene, 2);
    return all;
}

// Each pixel is that without the boxes times (1 - a)^N: the boxes add no noise of their own.
TEST(BlendedShadows, DimEverySampleByTheProduct) {
    constexpr float opacity = 0.3f;
    for (const LitScene& lamp : lamps()) {
        const RenderedImage clear = direct_light(lamp.scene);
        for (const int boxes : {1, 2, 7}) { // below 1/16 there is Russian roulette
            Scene scene = lamp.scene;
            // Around the floor and below the lamps.
            Transform t = at({0, 0, 0}, 5);
            for (int i = 0; i < boxes; ++i) {
                t.scale.y = 0.5f + 0.05f * float(i);
                place(scene, cube(false), blended(opacity), t);
            }
            const RenderedImage dimmed = direct_light(scene);
            const double share = std::pow(1 - double(opacity), boxes);
            int off = 0; // a ray along an edge meets both of its triangles
            for (size_t i = 0; i < clear.pixels.size(); ++i) {
                ASSERT_GT(clear.pixels[i].y, 0);
                off += std::abs(dimmed.pixels[i].y / clear.pixels[i].y / share - 1) > 1e-5;
            }
            EXPECT_LE(off, 1) << lamp.name << ", " << boxes;
        }
    }
}

// Below 1/16 Russian roulette leaves 1/16 or nothing.
TEST(BlendedShadows, KeepTheMeanOfSmallProducts) {
    EXPECT_EQ(roulette_limit(1), roulette_depth);
    for (const int sheets : {8, 12, 20}) {
        Scene scene;
        for (int i = 0; i < sheets; ++i) place(scene, floor_quad(50, 0.5f + 0.1f * float(i)), blended(0.3f));
        Light sun;
        sun.kind = Light::Kind::sun;
        sun.intensity = 3;
        place_light(scene, sun, aimed({0, 5, 0}, {0.2f, -1, 0.1f}));
        const double lit = 0.6 * 3 / std::numbers::pi / std::sqrt(1.05), share = std::pow(1 - double(0.3f), sheets);
        const RenderedImage image = direct_light(scene, 256);
        EXPECT_TRUE(is_mean(image.whole(), lit * share, sidak(significance, 3))) << sheets;
        const RenderedImage one = direct_light(scene, 1);
        int passed = 0;
        for (const Vec3d& pixel : one.pixels) {
            EXPECT_NEAR(pixel.y, pixel.y > 0 ? lit / 16 : 0, 1e-5 * lit);
            passed += pixel.y > 0;
        }
        EXPECT_LT(passed, int(one.pixels.size())) << sheets;
    }
}

// A sheet of long thin triangles in all directions, of about 10 x 10 m. A BVH with spatial splits would store each of them many times.
GeometryPtr sheet_of_slivers(int count, float y) {
    auto g = std::make_shared<Geometry>();
    // A fan around its corner: every point is in one triangle.
    const auto on_arc = [&](int i) {
        const double angle = std::numbers::pi / 2 * i / count;
        return Vec3{-5 + 15 * float(std::cos(angle)), y, -5 + 15 * float(std::sin(angle))};
    };
    g->positions.push_back({-5, y, -5});
    for (int i = 0; i <= count; ++i) g->positions.push_back(on_arc(i));
    for (uint32_t i = 0; i < uint32_t(count); ++i) g->indices.insert(g->indices.end(), {0, i + 1, i + 2});
    return g;
}

TEST(BlendedShadows, CountEachTriangleOfALargeMeshOnce) {
    const double share = std::pow(1 - 0.4, 3);
    for (const bool instanced : {false, true}) {
        Scene scene;
        for (int i = 0; i < 3; ++i) {
            const Id<Node> id = place(scene, sheet_of_slivers(20'000, 0.5f + 0.2f * float(i)), blended(0.4f));
            if (!instanced) continue;
            Node copy = *scene.nodes.find(id);
            copy.local.translation.x = 100; // not between the floor and the lamp
            scene.nodes.add(copy);
        }
        Scene clear;
        for (Scene* lit : {&scene, &clear}) place_light(*lit, Light{}, at({0.3f, 3, 0.2f}));
        const RenderedImage without = direct_light(clear, 16), image = direct_light(scene, 16);
        int off = 0; // a ray along an edge meets both of its triangles
        for (size_t i = 0; i < image.pixels.size(); ++i) off += std::abs(image.pixels[i].y / without.pixels[i].y / share - 1) > 1e-5;
        EXPECT_LT(off, 3) << instanced;
    }
}

ImagePtr alpha_image(int width, int height, const std::function<int(int)>& alpha) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = 4;
    for (int i = 0; i < width * height; ++i) image.bytes.insert(image.bytes.end(), {255, 255, 255, uint8_t(alpha(i))});
    return std::make_shared<const Image>(std::move(image));
}

// A mask in the same scene stays all or nothing.
TEST(BlendedShadows, LeaveMasksExact) {
    Scene scene;
    Material mask = lambert(0.f);
    mask.alpha = Material::Alpha::mask;
    mask.base_color_texture.texture = add_texture(scene, alpha_image(2, 1, [](int i) { return i ? 255 : 0; }));
    place(scene, floor_quad(100, 0.5f), mask); // opaque where x > 0
    place(scene, floor_quad(100, 0.7f), blended(0.25f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    place_light(scene, sun, aimed({0, 5, 0}, {0, -1, 0}));
    const RenderedImage image = direct_light(scene);
    const double lit = 0.6 * 3 * 0.75 / std::numbers::pi;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) EXPECT_NEAR(image.at(x, y).y, x < image.width / 2 ? lit : 0, 1e-6 * lit) << x << " " << y;
}

// ---- strategies agree

Scene floor_under(const std::function<void(Scene&)>& cover) {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.6f));
    cover(scene);
    place(scene, ceiling_quad(0.8f, 1.6f), emitter(6, 0.3f));
    scene.view = looking({0, 0.45f, 1.6f}, {0, 0, 0}, 0.9f);
    return scene;
}

// Grey, with alpha from 0 to 1.
Material leaf(Scene& scene, Texture::Filter filter) {
    Material m = lambert(0.5f);
    m.alpha = Material::Alpha::blend;
    m.double_sided = true;
    m.base_color_texture.texture = add_texture(scene, alpha_image(8, 8, [](int i) { return i * 37 % 256; }), filter);
    return m;
}

std::vector<LitScene> covers() {
    std::vector<LitScene> all;
    const auto add = [&](const char* name, const std::function<void(Scene&)>& cover) { all.push_back({name, floor_under(cover)}); };
    add("textures", [](Scene& s) {
        place(s, floor_quad(1, 0.6f), leaf(s, Texture::Filter::nearest), aimed({0.1f, 0.2f, 0}, {0.1f, 0.2f, -1}));
        place(s, floor_quad(1.2f, 1), leaf(s, Texture::Filter::linear));
    });
    add("vertex colours", [](Scene& s) {
        Geometry g = *floor_quad(1, 0.8f);
        g.serial = next_payload_serial();
        g.colors = {{1, 1, 1, 1}, {1, 1, 1, 0.2f}, {1, 1, 1, 0}, {1, 1, 1, 0.7f}};
        place(s, std::make_shared<const Geometry>(g), blended(0.9f));
    });
    add("around window panes", [](Scene& s) {
        place(s, floor_quad(1, 0.6f), leaf(s, Texture::Filter::nearest));
        place(s, floor_quad(3, 0.8f), window_glass({0.9f, 0.8f, 0.9f}));
        place(s, floor_quad(1, 1), leaf(s, Texture::Filter::nearest), at({0.2f, 0, 0.1f}));
    });
    add("on window panes", [](Scene& s) {
        Material glazed = window_glass({0.9f, 0.8f, 0.9f});
        glazed.alpha = Material::Alpha::blend;
        glazed.base_color_texture.texture = add_texture(s, alpha_image(4, 4, [](int i) { return i * 83 % 256; }));
        place(s, floor_quad(1.5f, 0.7f), glazed);
        place(s, floor_quad(1, 1), leaf(s, Texture::Filter::nearest));
    });
    add("leaves with a BVH of area lights", [](Scene& s) {
        const Id<Mesh> mesh = s.meshes.add({"leaf", {{floor_quad(1), s.materials.add(leaf(s, Texture::Filter::nearest))}}});
        std::mt19937 bits(7);
        const auto random = [&] { return float(bits()) * 0x1p-32f; };
        for (int i = 0; i < 4200; ++i) {
            Node node;
            node.mesh = mesh;
            node.local = aimed({3 * random() - 1.5f, 0.6f + 0.6f * random(), 3 * random() - 1.5f}, {random() - 0.5f, random(), random()});
            node.local.scale = {0.03f, 0.03f, 0.03f};
            s.nodes.add(node);
        }
    });
    return all;
}

TEST(BlendedShadows, AgreeWithBsdfSampling) {
    const double each = sidak(significance, 3 * 5);
    for (const LitScene& cover : covers()) {
        const auto found = shot(cover.scene, Strategy::bsdf, 2048);
        EXPECT_TRUE(same_means(shot(cover.scene, Strategy::light, 256), found, each)) << cover.name;
        EXPECT_TRUE(same_means(shot(cover.scene, Strategy::mis, 256), found, each)) << cover.name;
        EXPECT_TRUE(same_means(shot(cover.scene, Strategy::mis, 256, 16), found, each)) << cover.name << ", shared paths";
    }
}

// Connections that cross a blended surface, seen by some members of a group from one side, by others from the other.
TEST(BlendedShadows, KeepTheMeanOfSharedPaths) {
    Scene scene;
    place(scene, cube(true), lambert(0.8f));
    place(scene, ceiling_quad(0.3f, 0.95f), emitter(10));
    for (const float x : {-0.5f, -0.1f, 0.3f})
        place(scene, quad({x, -1, -1}, {x, -1, 1}, {x, 0.5f, 1}, {x, 0.5f, -1}), leaf(scene, Texture::Filter::nearest));
    scene.view = looking({0, -0.2f, 0.95f}, {0, -0.4f, -1}, 1.2f);
    const auto alone = shot(scene, Strategy::mis, 1024);
    for (const int reuse : {4, 16}) EXPECT_TRUE(same_means(shot(scene, Strategy::mis, 512, reuse), alone, sidak(significance, 2))) << reuse;
}

} // namespace
} // namespace blush::test::TEST_FILE
