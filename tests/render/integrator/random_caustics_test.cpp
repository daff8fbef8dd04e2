// The strategies for caustics agree in the mean in random scenes: features that meet in none of the other tests meet here.
#include "tests/render/integrator/caustic_images.h"
#include "tests/render/integrator/manifold/lit_casters.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// A scene in which each part has one of some forms: casters, receivers, what lets pass a part of the light, and lights so large that paths
// find them by chance.
class RandomScene {
public:
    explicit RandomScene(uint32_t seed) : random_(seed) {
        objects_.push_back(place(scene, floor_quad(2), receiver()));
        if (one_in(3))
            objects_.push_back(place(scene, quad({-2, 0, -1.3f}, {2, 0, -1.3f}, {2, 1.6f, -1.3f}, {-2, 1.6f, -1.3f}), receiver()));
        for (const Vec3& center : {Vec3{-0.8f, 0.5f, 0}, {0.7f, 0.5f, 0.2f}, {0, 0.4f, 0.9f}}) {
            if (one_in(4)) continue;
            Transform where = at(center, 0.3f);
            if (one_in(4)) where.scale = {0.45f, 0.2f, 0.3f};
            const GeometryPtr shape = one_in(3) ? cube(false) : one_in(3) ? sphere(false) : round_sphere();
            objects_.push_back(place(scene, shape, caster(), where));
        }
        for (const float height : {1.1f, 1.4f}) {
            if (!one_in(3)) continue;
            const Material material = veil(); // before the place: arguments have no order
            objects_.push_back(place(scene, floor_quad(0.6f, height), material, at({number(-0.6f, 0.6f), 0, number(0, 0.4f)})));
        }
        if (one_in(4))
            objects_.push_back(
                place(scene, quad({-0.8f, 0.1f, 1.3f}, {0.6f, 0.1f, 1.3f}, {0.6f, 0.8f, 1.3f}, {-0.8f, 0.8f, 1.3f}), veil()));
        const int lights = 1 + int(random_() % 2);
        for (int i = 0; i < lights; ++i) add_light();
        if (one_in(4)) constant_world(scene, 0.3f);
        scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
        if (one_in(4)) scene.view.lens.aperture_radius = 0.1f, scene.view.lens.focus_distance = 4;
        settings = settings_for(36, 36, 64);
        if (one_in(5)) settings.max_bounces = 3 + int(random_() % 4);
    }

    Scene scene;
    RenderSettings settings;

private:
    bool one_in(uint32_t n) { return random_() % n == 0; }
    float number(float low, float high) { return low + (high - low) * float(random_() % 1024) / 1024; }
    Vec3 color() { return {number(0.3f, 0.9f), number(0.3f, 0.9f), number(0.3f, 0.9f)}; }

    Material receiver() {
        Material m = one_in(5) ? metal(0.35f) : lambert(color());
        if (one_in(4)) m.specular = 1, m.roughness = one_in(2) ? 0.4f : 0.f;
        if (one_in(6)) m.clearcoat = 0.8f, m.clearcoat_roughness = one_in(2) ? 0.3f : 0.f;
        return m;
    }
    Material caster() {
        const float roughness = one_in(3) ? 0.2f : 0.f;
        Material m = one_in(3) ? metal(roughness) : one_in(3) ? plastic(roughness) : glass(roughness, 1.4f);
        if (m.transmission > 0 && one_in(3)) m.attenuation_color = color(), m.attenuation_distance = 0.5f;
        if (m.transmission > 0 && one_in(6)) m.dispersion = 4;
        if (one_in(4)) m.base_color = color();
        if (one_in(8)) m.emissive = color(), m.emissive_strength = 2;
        if (one_in(8)) m.clearcoat = 1;
        return m;
    }
    // A pane or a leaf: blended, cut out or solid.
    Material veil() {
        Material m = one_in(2) ? window_glass(color()) : lambert(color());
        m.double_sided = one_in(2);
        if (one_in(3)) m.emissive = color(), m.emissive_strength = 2;
        if (one_in(4)) m.transmission = 0.5f;
        if (one_in(3)) return m;
        m.alpha = one_in(4) ? Material::Alpha::mask : Material::Alpha::blend;
        m.opacity = number(0.2f, 0.9f);
        return m;
    }
    ObjectSet some_objects() { return {one_in(2), {objects_[random_() % objects_.size()]}}; }
    void add_light() {
        if (one_in(3)) {
            Material lamp = emitter(10, one_in(2) ? 0.8f : 0.f);
            lamp.double_sided = one_in(2);
            if (one_in(4)) lamp.alpha = Material::Alpha::blend, lamp.opacity = 0.6f;
            if (one_in(4)) lamp.clearcoat = 1;
            const GeometryPtr shape = ceiling_quad(0.6f, number(1.6f, 2.5f));
            place(scene, shape, lamp, at({number(-0.4f, 0.4f), 0, number(-0.3f, 0.5f)}));
            return;
        }
        Light light = caustic_light(Light::Kind::point, 20, 0.45f);
        Transform where = at({number(-0.6f, 0.6f), number(1.9f, 2.5f), number(0, 0.6f)});
        if (one_in(3)) {
            light = caustic_light(Light::Kind::sun, 3);
            light.angle_radians = number(0.4f, 0.7f);
            where = aimed({0, 5, 0}, {number(-0.4f, 0.4f), -1, number(-0.3f, 0.3f)});
        } else if (one_in(3)) {
            light = caustic_light(one_in(2) ? Light::Kind::rectangle : Light::Kind::disk, 12);
            light.radius = 0.5f;
            light.two_sided = one_in(3);
            if (one_in(3)) light.spread_radians = 2;
            where = aimed(where.translation, {number(-0.2f, 0.2f), -1, number(-0.2f, 0.2f)});
        } else if (one_in(3)) {
            light.kind = Light::Kind::spot;
            light.outer_cone_radians = 1;
            where = aimed(where.translation, {number(-0.2f, 0.2f), -1, number(-0.2f, 0.2f)});
        }
        light.color = color();
        if (one_in(5)) light.lit_objects = some_objects();
        if (one_in(5)) light.shadow_casters = some_objects();
        place_light(scene, light, where);
    }

    std::mt19937 random_;
    std::vector<Id<Node>> objects_;
};

constexpr CausticOptions everything{.light_path_share = 0.5f, .manifold_sampling = true, .light_vertices = true, .shared_chains = true};

void expect_sum_is_beauty(const std::vector<std::vector<Vec3>>& planes, const Frame& frame, uint32_t seed) {
    ASSERT_FALSE(planes.empty()) << seed;
    for (size_t i = 0; i < planes[0].size(); ++i) {
        double sum = 0;
        for (const auto& plane : planes) sum += double(plane[i].y);
        const double whole = double(frame.rgba[4 * i + 1]);
        // A ray that meets two suns, or sun and sky, adds both in single precision.
        ASSERT_NEAR(sum, whole, 0x1p-20 * std::max(sum, whole)) << "scene " << seed << ", pixel " << i;
    }
}

TEST(RandomCaustics, AgreeForAllStrategies) {
    constexpr std::array seeds{1u, 2u, 3u, 4u, 5u, 17u}; // 17: a lamp that is blended, which shadowed itself
    const double alpha = sidak(significance, int64_t(3 * seeds.size()));
    for (const uint32_t seed : seeds) {
        SCOPED_TRACE(seed);
        const RandomScene random(seed);
        const auto blocks = [&](const CausticOptions& strategies, uint32_t first_seed) {
            return image_blocks(random.scene, random.settings, strategies, 24, first_seed, [](Renderer&) {});
        };
        const auto without = blocks({.light_path_share = 0.f, .manifold_sampling = false}, 1);
        EXPECT_TRUE(same_means(blocks({.light_path_share = 1.f, .manifold_sampling = false}, 1000), without, alpha)) << "light paths";
        EXPECT_TRUE(same_means(blocks({.light_path_share = 0.f, .manifold_sampling = true}, 2000), without, alpha)) << "manifold sampling";
        EXPECT_TRUE(same_means(blocks(everything, 3000), without, alpha)) << "all";
    }
}

// Each light is in one group, and each path has one length, whichever strategy finds it.
TEST(RandomCaustics, PlanesSumToTheBeauty) {
    for (uint32_t seed = 1; seed <= 40; ++seed) {
        RandomScene random(seed);
        random.settings.spp = 6;
        for (const bool by_bounce : {false, true}) {
            random.scene.mix.grouping = by_bounce ? LightMix::Grouping::none : LightMix::Grouping::by_light;
            Renderer renderer({.threads = 2, .planes = {.bounces = by_bounce ? 6 : 0}, .caustics = everything});
            renderer.update(random.scene, random.settings);
            renderer.render(0, random.settings.spp);
            const Frame frame = renderer.resolve();
            expect_sum_is_beauty(by_bounce ? frame.bounces : frame.groups, frame, seed);
        }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
