// Planes by bounce and by light group of images with light paths and manifold sampling: they sum to the beauty, and each agrees with an
// image without these strategies.
#include "render/film/film_state.h"
#include "tests/render/integrator/caustic_images.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr int width = 24, height = 14, planes = 6;
constexpr CausticOptions everything{.light_path_share = 1.f, .manifold_sampling = true, .light_vertices = true};

// With wide lights, and a second light.
Scene lit_scene(const std::string& name) {
    Scene scene = with_wide_lights(name);
    Node second;
    second.name = "second";
    second.local.translation = {0.2f, 0.6f, 0.1f};
    second.light = scene.lights.add(caustic_light(Light::Kind::point, 1, 0.1f));
    scene.nodes.add(second);
    scene.mix.grouping = LightMix::Grouping::none;
    return scene;
}

Frame rendered(const Scene& scene, RenderSettings settings, const CausticOptions& caustics, unsigned threads = 2) {
    Renderer renderer({.threads = threads, .planes = {.bounces = planes}, .caustics = caustics});
    renderer.update(scene, settings);
    renderer.render(0, settings.spp);
    if (settings.caustics != CausticStrategy::off) {
        EXPECT_TRUE(feature_line(renderer, "light paths").used || feature_line(renderer, "manifold sampling").used);
    }
    return renderer.resolve();
}

void expect_sum(const std::vector<std::vector<Vec3>>& split, const Frame& frame) {
    ASSERT_FALSE(split.empty());
    for (size_t i = 0; i < size_t(width) * height; ++i) {
        double sum = 0;
        for (const auto& plane : split) {
            EXPECT_GE(plane[i].y, 0);
            sum += double(plane[i].y);
        }
        const double whole = double(frame.rgba[4 * i + 1]);
        EXPECT_NEAR(sum, whole, std::max(sum, whole) * 0x1.01p-23);
    }
}

double mean_of(const std::vector<Vec3>& plane) {
    double sum = 0;
    for (const Vec3& v : plane) sum += double(v.y);
    return sum / double(plane.size());
}

// Means of the planes over independent images.
template <class Split> std::vector<Moments> plane_means(const Scene& scene, RenderSettings settings, uint32_t seed, const Split& split) {
    std::vector<Moments> means;
    for (int k = 0; k < 12; ++k) {
        settings.seed = seed + uint32_t(k);
        const Frame frame = rendered(scene, settings, everything);
        means.resize(split(frame).size());
        for (size_t i = 0; i < means.size(); ++i) means[i].add(mean_of(split(frame)[i]));
    }
    return means;
}

// The planes agree with those without the strategies. Negative control: they differ from the planes of their neighbours.
template <class Split> void expect_agreement(const Scene& scene, const Split& split) {
    RenderSettings settings = settings_for(width, height, 64);
    const auto with = plane_means(scene, settings, 1, split);
    settings.caustics = CausticStrategy::off;
    settings.spp = 256;
    const auto without = plane_means(scene, settings, 1000, split);
    ASSERT_EQ(with.size(), without.size());
    const double alpha = sidak(significance, int64_t(with.size()));
    for (size_t k = 0; k < with.size(); ++k) EXPECT_TRUE(same_mean(with[k], without[k], alpha)) << k;
    EXPECT_FALSE(same_mean(with[0], without[1], alpha));
}

constexpr auto bounces_of = [](const Frame& frame) -> const auto& { return frame.bounces; };
constexpr auto groups_of = [](const Frame& frame) -> const auto& { return frame.groups; };

TEST(CausticPlanes, BouncesSumToTheBeauty) {
    for (const std::string& name : caustic_scene_names()) {
        SCOPED_TRACE(name);
        RenderSettings settings = settings_for(width, height, 8);
        const Frame frame = rendered(lit_scene(name), settings, everything);
        expect_sum(frame.bounces, frame);
        settings.adaptive = true;
        settings.spp = 24;
        const Frame adaptive = rendered(lit_scene(name), settings, everything);
        expect_sum(adaptive.bounces, adaptive);
    }
}

TEST(CausticPlanes, EachBounceAgreesWithCameraPaths) {
    for (const char* name : {"metal-ring", "pool"}) {
        SCOPED_TRACE(name);
        expect_agreement(lit_scene(name), bounces_of);
    }
}

TEST(CausticPlanes, GroupsSumToTheBeauty) {
    for (const std::string& name : caustic_scene_names()) {
        SCOPED_TRACE(name);
        Scene scene = lit_scene(name);
        scene.mix.grouping = LightMix::Grouping::by_light;
        const Frame frame = rendered(scene, settings_for(width, height, 8), everything);
        EXPECT_GE(frame.groups.size(), 2u);
        expect_sum(frame.groups, frame);
        EXPECT_EQ(rendered(scene, settings_for(width, height, 8), everything, 3).groups, frame.groups) << "threads";
    }
}

TEST(CausticPlanes, EachGroupAgreesWithCameraPaths) {
    for (const char* name : {"metal-ring", "pool"}) {
        SCOPED_TRACE(name);
        Scene scene = lit_scene(name);
        scene.mix.grouping = LightMix::Grouping::by_light;
        expect_agreement(scene, groups_of);
    }
}

// Gains apply to splats, too.
TEST(CausticPlanes, AreMixedAndContinued) {
    Scene scene = lit_scene("metal-ring");
    scene.mix.grouping = LightMix::Grouping::by_light;
    const RenderSettings settings = settings_for(width, height, 8);
    const RendererOptions options{.threads = 2, .planes = {.bounces = planes}, .caustics = everything};
    Renderer whole(options), begun(options), continued(options);
    for (Renderer* r : {&whole, &begun, &continued}) r->update(scene, settings);
    whole.render(0, 8);
    begun.render(0, 4);
    ASSERT_TRUE(continued.load_film(*begun.save_film(0)));
    continued.render(4, 4);
    const Frame expected = whole.resolve(), frame = continued.resolve();
    EXPECT_EQ(frame.rgba, expected.rgba);
    EXPECT_EQ(frame.groups, expected.groups);
    EXPECT_EQ(frame.bounces, expected.bounces);
    Mixing mixing = mixing_of(*expected.light_groups, scene, {}).value();
    mixing.gains.assign(mixing.gains.size(), Vec3{0, 0, 0});
    mixing.gains[0] = {2, 2, 2};
    whole.set_mix(mixing);
    const Frame mixed = whole.resolve();
    for (size_t i = 0; i < size_t(width) * height; ++i)
        EXPECT_NEAR(double(mixed.rgba[4 * i + 1]), 2 * double(expected.groups[0][i].y), 0x1.01p-23 * 2 * double(expected.groups[0][i].y));
}

} // namespace
} // namespace blush::test::TEST_FILE
