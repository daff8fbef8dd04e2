// The light mix: images mixed from groups while their lights change.
#include "render/light_mix/light_mix.h"

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/light_mix/bake_mix.h"
#include "scene/affine.h"
#include "tests/render/studio.h"

#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

using Grouping = LightMix::Grouping;
using statistics::Moments;
using statistics::sidak;
using statistics::significance;
using statistics::z_test;

// A studio with a renderer that already has a few samples.
struct RenderedStudio {
    Studio studio;
    RenderSettings settings = settings_for(24, 16, 4);
    Renderer renderer{{.threads = 1, .planes = {}}};

    RenderedStudio() {
        renderer.update(studio.scene, settings);
        renderer.render(0, settings.spp);
    }
};

TEST(LightMix, OfEqualGainsMatchesAFreshRender) {
    RenderedStudio rendered;
    auto& [studio, settings, renderer] = rendered;
    for (auto [id, light] : studio.scene.lights) {
        light.intensity *= 2;
        studio.scene.lights.set(id, light);
    }
    for (auto [id, material] : studio.scene.materials) {
        material.emissive_strength *= 2;
        studio.scene.materials.set(id, material);
    }
    studio.scene.environment.intensity *= 2;
    EXPECT_FALSE(renderer.update(studio.scene, settings)) << "the film is kept";
    const Frame mixed = renderer.resolve(), fresh = render_frame(studio.scene, settings);
    EXPECT_EQ(mixed.samples, 4);
    EXPECT_EQ(mixed.gains, Gains(5, Vec3{2, 2, 2}));
    // The same probabilities and samples, each twice as bright.
    for (size_t i = 0; i < mixed.rgba.size(); ++i) ASSERT_NEAR(mixed.rgba[i], fresh.rgba[i], 0x1p-20f * fresh.rgba[i]) << i;
    EXPECT_NEAR(mixed.error.rmse, fresh.error.rmse, 1e-4 * fresh.error.rmse);
    EXPECT_NEAR(mixed.error.relmse, fresh.error.relmse, 1e-4 * fresh.error.relmse);
}

TEST(LightMix, OfASceneWithoutLightsIsBlack) {
    Scene scene;
    scene.mix.grouping = Grouping::by_object;
    const Frame frame = render_frame(scene, settings_for(8, 8, 1));
    EXPECT_TRUE(frame.gains.empty());
    EXPECT_EQ(std::ranges::count_if(frame.rgba, [](float v) { return !(v == 0 || v == 1); }), 0);
}

struct MixEdit {
    const char* name;
    void (*edit)(Studio&);
};
const MixEdit mix_edits[] = {
    {"intensity", [](Studio& s) { s.change(s.bulb, [](Light& l) { l.intensity = 9; }); }},
    {"colour of a visible lamp", [](Studio& s) { s.change(s.panel, [](Light& l) {
                                                     l.color = {1, 0.2f, 0.4f};
                                                 }); }},
    {"temperature", [](Studio& s) { s.change(s.bulb, [](Light& l) { l.use_temperature = true, l.kelvin = 3000; }); }},
    {"a visible lamp off", [](Studio& s) { s.change(s.panel, [](Light& l) { l.enabled = false; }); }},
    {"sky",
     [](Studio& s) {
         s.scene.environment.color = {0.3f, 0.5f, 1}, s.scene.environment.intensity = 1;
     }},
    {"glow",
     [](Studio& s) {
         const Id<Material> id = s.scene.meshes.find(s.scene.nodes.find(s.ball)->mesh)->parts[0].material;
         Material m = *s.scene.materials.find(id);
         m.emissive = {1, 0.5f, 0.1f};
         s.scene.materials.set(id, m);
     }},
};

// The same image on average, in every block, for any dimmed, coloured or switched light.
TEST(LightMix, MatchesARenderOfTheEditedLights) {
    const RenderSettings settings = settings_for(32, 32, 96);
    const Studio before;
    Renderer renderer({.threads = 2, .planes = {}});
    renderer.update(before.scene, settings);
    renderer.render(0, 96);
    for (const MixEdit& edit : mix_edits) {
        Studio after = before;
        edit.edit(after);
        ASSERT_FALSE(renderer.update(after.scene, settings)) << edit.name;
        const RenderedImage mixed = image_of(renderer), fresh = render(after.scene, settings);
        EXPECT_TRUE(same_means(mixed.blocks(16, 16), fresh.blocks(16, 16), sidak(significance, int64_t(std::size(mix_edits)))))
            << edit.name;
        EXPECT_FALSE(same_mean(mixed.whole(), render(before.scene, settings).whole())) << edit.name << " shows nothing";
    }
    EXPECT_FALSE(renderer.update(before.scene, settings));
    EXPECT_EQ(renderer.resolve().rgba, render(before.scene, settings).frame.rgba) << "reverting restores the image exactly";
}

TEST(LightMix, ThinnedIsTheSameForFewerPixels) {
    RenderedStudio rendered;
    const Frame frame = rendered.renderer.resolve();
    Gains gains(frame.groups.size(), Vec3{0.5f, 2, 1});
    gains[0] = {};
    const std::vector<float> all = mixed_rgba(frame, gains);
    for (const int step : {1, 3, 4, 100}) {
        const SubsampledPlanes some = subsampled(planes_of(frame), frame.width, frame.height, step);
        std::vector<float> mixed(3 * size_t(some.width) * size_t(some.height));
        mix_rgb(some.spans(), gains, mixed);
        EXPECT_EQ(some.width, std::max(frame.width / step, 1));
        EXPECT_EQ(some.height, std::max(frame.height / step, 1));
        for (int y = 0; y < some.height; ++y)
            for (int x = 0; x < some.width; ++x)
                for (size_t c = 0; c < 3; ++c) {
                    const int from_x = std::min(x * step + step / 2, frame.width - 1),
                              from_y = std::min(y * step + step / 2, frame.height - 1);
                    EXPECT_EQ(mixed[3 * size_t(y * some.width + x) + c], all[4 * size_t(from_y * frame.width + from_x) + c]);
                }
    }
}

TEST(LightMix, ChannelsAreGains) {
    RenderedStudio rendered;
    auto& [studio, settings, renderer] = rendered;
    studio.change(studio.bulb, [](Light& l) { l.intensity *= 0.5f; });
    MixChannel& bulb = studio.channel("Bulb");
    bulb.intensity = 3;
    bulb.color = {1, 0.5f, 0.25f};
    studio.channel("Sun").enabled = false;
    EXPECT_FALSE(renderer.update(studio.scene, settings));
    const Frame frame = renderer.resolve();
    EXPECT_EQ(frame.gains, (Gains{{1, 1, 1}, {1.5f, 0.75f, 0.375f}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}}));
    expect_planes_sum_to_beauty(frame, 0x1p-20, "channels");
    const std::vector<float> remixed = mixed_rgba(frame, frame.gains);
    for (size_t i = 0; i < remixed.size(); ++i) ASSERT_NEAR(remixed[i], frame.rgba[i], 0x1p-20f * frame.rgba[i]);
    const Workers workers(2);
    std::vector<float> shared;
    mix_rgba(frame, frame.gains, shared, &workers);
    EXPECT_EQ(shared, remixed);
}

TEST(LightMix, ResetsIfNoGainExpressesTheChange) {
    const MixEdit edits[] = {
        {"moved",
         [](Studio& s) {
             Node n = *s.scene.nodes.find(s.bulb);
             n.local.translation.x += 1;
             s.scene.nodes.set(s.bulb, n);
         }},
        {"from black", [](Studio& s) { s.change(s.bulb, [](Light& l) {
                                           l.color = {1, 1, 1};
                                       }); }},
        {"switched on", [](Studio& s) { s.change(s.panel, [](Light& l) { l.enabled = true; }); }},
        {"cone", [](Studio& s) { s.change(s.panel, [](Light& l) { l.width = 2; }); }},
        {"grouping", [](Studio& s) { s.scene.mix.grouping = Grouping::by_object; }},
        {"sky turned", [](Studio& s) { s.scene.environment.rotation_degrees = 20; }},
    };
    for (const MixEdit& edit : edits) {
        Studio studio;
        studio.change(studio.bulb, [](Light& l) { l.color = {1, 0, 0}; });
        studio.change(studio.panel, [](Light& l) { l.enabled = false; });
        Renderer renderer({.threads = 1, .planes = {}});
        const RenderSettings settings = settings_for(16, 16, 2);
        renderer.update(studio.scene, settings);
        renderer.render(0, 2);
        edit.edit(studio);
        EXPECT_TRUE(renderer.update(studio.scene, settings)) << edit.name;
        renderer.render(0, 2);
        EXPECT_EQ(renderer.resolve().rgba, render_frame(studio.scene, settings).rgba) << edit.name;
    }
}

TEST(LightMix, ResetsIfMembersOfAGroupChangeDifferently) {
    Studio studio;
    studio.scene.mix.grouping = Grouping::by_hand;
    for (const Id<Node> node : {studio.bulb, studio.panel}) studio.change(node, [](Light& l) { l.group = "Both"; });
    const LightGroups groups = make_light_groups(studio.scene);
    studio.change(studio.bulb, [](Light& l) { l.intensity *= 2; });
    EXPECT_FALSE(compared_mixing(groups, studio.scene));
    studio.change(studio.panel, [](Light& l) { l.intensity *= 2; });
    ASSERT_TRUE(compared_mixing(groups, studio.scene));
    studio.change(studio.panel, [](Light& l) { l.group = "Other"; });
    EXPECT_FALSE(compared_mixing(groups, studio.scene));
}

TEST(LightMix, FollowsNames) {
    Studio studio;
    const LightGroups groups = make_light_groups(studio.scene);
    studio.change(studio.bulb, [](Light& l) { l.name = "Key"; });
    studio.channel("Key").intensity = 2;
    const std::optional<Mixing> mixing = compared_mixing(groups, studio.scene);
    ASSERT_TRUE(mixing);
    EXPECT_EQ(mixing->names[1], "Key");
    EXPECT_EQ(mixing->gains[1], (Vec3{2, 2, 2}));
}

// Light selection by the mix continues from the existing samples, and reduces noise where the mix needs it. Lights that the mix
// switched off are hardly sampled any more, without bias: among few lights, and among many.
class MixAim : public testing::TestWithParam<bool> {};
TEST_P(MixAim, SamplesByTheMixWithoutBias) {
    const RenderSettings settings = settings_for(64, 64, 96);
    Studio studio;
    const bool many = GetParam();
    if (!many) {
        Node hidden = *studio.scene.nodes.find(studio.ball); // its triangles are many lights
        hidden.visible = false;
        studio.scene.nodes.set(studio.ball, hidden);
    }
    Renderer follows({.threads = 2, .planes = {}}), scatter_share({.threads = 2, .planes = {}});
    for (Renderer* r : {&follows, &scatter_share}) {
        r->update(studio.scene, settings);
        r->render(0, 16);
    }
    for (const char* off : {"Environment", "Panel", "Sun"}) studio.channel(off).enabled = false;
    if (many) studio.channel("Node 6").enabled = false;
    for (Renderer* r : {&follows, &scatter_share}) EXPECT_FALSE(r->update(studio.scene, settings));
    follows.select_lights_by_mix();
    for (Renderer* r : {&follows, &scatter_share}) r->render(16, 80);
    const RenderedImage a = image_of(follows), b = image_of(scatter_share);
    EXPECT_TRUE(same_means(a.blocks(32, 32), b.blocks(32, 32)));
    EXPECT_LT(a.frame.error.rmse_high, b.frame.error.rmse_low) << "selection by the mix must reduce the error";
    expect_planes_sum_to_beauty(a.frame, 0x1p-20, "aimed");
}
INSTANTIATE_TEST_SUITE_P(Lights, MixAim, testing::Values(false, true),
                         [](const auto& light) { return light.param ? "AmongMany" : "AmongFew"; });

LightMix some_mix() {
    LightMix mix{.grouping = Grouping::by_light, .channels = {}};
    mix.channels.push_back({.group = "Bulb", .intensity = 3, .color = {1, 0.5f, 0.25f}});
    mix.channels.push_back({.group = "Panel", .enabled = false});
    mix.channels.push_back({.group = "Environment", .intensity = 0.5f, .use_temperature = true, .kelvin = 9000});
    mix.channels.push_back({.group = "Node 6", .intensity = 2});
    return mix;
}

// What two independent renders of one image say about the noise of a mix, as means over pixels and channels.
struct NoiseOfPair {
    double mix = 0, groups = 0; // variance of the mixed image; sum of the variances of its groups
};
NoiseOfPair noise_of_pair(const Frame& a, const Frame& b, const Gains& gains) {
    NoiseOfPair noise;
    const size_t pixels = a.groups[0].size();
    for (size_t i = 0; i < pixels; ++i) {
        Vec3d mix{0, 0, 0};
        for (size_t k = 0; k < gains.size(); ++k) {
            const Vec3d d = (to_double(a.groups[k][i]) - to_double(b.groups[k][i])) * to_double(gains[k]);
            mix = mix + d;
            noise.groups += dot(d, d);
        }
        noise.mix += dot(mix, mix);
    }
    // The variance of a difference is twice that of either.
    const double values = 2.0 * 3 * double(pixels);
    return {noise.mix / values, noise.groups / values};
}

// The error of a mix, estimated from the halves of the groups, is that of independent renders; the prediction is right about the
// variances of single groups, and close to the error although it ignores their correlation.
TEST(LightMix, PredictsItsNoise) {
    constexpr int pairs = 16;
    Studio studio;
    Studio mixed = studio;
    mixed.channel("Bulb").intensity = 4;
    mixed.channel("Environment").intensity = 0.2f;
    Moments own_error, of_groups, closeness; // one number for each pair
    int unknown = 0;                         // pairs without a prediction: a firefly carries the error of one render
    for (int pair = 0; pair < pairs; ++pair) {
        Frame before[2], after[2];
        double estimated = 0, growth = 0, close = 0; // means of the two renders
        for (const int i : {0, 1}) {
            RenderSettings settings = settings_for(48, 48, 64);
            settings.seed = uint32_t(2 * pair + i);
            Renderer renderer({.threads = 2, .planes = {}});
            renderer.update(studio.scene, settings);
            renderer.render(0, settings.spp);
            before[i] = renderer.resolve();
            EXPECT_FALSE(renderer.update(mixed.scene, settings)) << "the film is kept";
            after[i] = renderer.resolve();
            ASSERT_TRUE(after[i].error.rmse_known);
            const double predicted = predicted_rmse(before[i], after[i].gains);
            estimated += after[i].error.rmse * after[i].error.rmse / 2;
            growth += std::pow(predicted / before[i].error.rmse, 2) / 2;
            close += predicted / after[i].error.rmse / 2;
        }
        const NoiseOfPair then = noise_of_pair(before[0], before[1], before[0].gains),
                          now = noise_of_pair(after[0], after[1], after[0].gains);
        own_error.add(estimated - now.mix);
        if (!before[0].error.rmse_known || !before[1].error.rmse_known) {
            ++unknown;
            continue;
        }
        of_groups.add(growth * then.groups - now.groups);
        closeness.add(close);
    }
    EXPECT_LE(unknown, pairs / 8);
    EXPECT_TRUE(z_test(own_error, 0)) << "error of the mix";
    EXPECT_TRUE(z_test(of_groups, 0)) << "growth of the groups' variances";
    // For these lights the prediction is 10 % too low: groups share paths, so their errors are correlated.
    EXPECT_GT(closeness.mean - 3 * closeness.error(), 0.85);
    EXPECT_LT(closeness.mean + 3 * closeness.error(), 1);
}

TEST(LightMix, ReportsSharesThatSumToOne) {
    RenderedStudio rendered;
    auto& [studio, settings, renderer] = rendered;
    studio.scene.mix = some_mix();
    renderer.update(studio.scene, settings);
    const Frame frame = renderer.resolve();
    double energy = 0, noise = 0;
    for (const GroupReport& r : report_groups(frame, frame.group_names, frame.gains)) {
        energy += r.energy;
        ASSERT_TRUE(r.noise);
        noise += *r.noise;
    }
    EXPECT_NEAR(energy, 1, 1e-9);
    EXPECT_NEAR(noise, 1, 1e-9);
}

// One sample per pixel has no variance: the shares of the noise are unknown, not 0.
TEST(LightMix, KnowsNoNoiseOfOneSample) {
    RenderedStudio rendered;
    auto& [studio, settings, renderer] = rendered;
    RenderSettings one = settings;
    one.seed = settings.seed + 1;
    renderer.update(studio.scene, one);
    renderer.render(0, 1);
    const Frame frame = renderer.resolve();
    const std::vector<GroupReport> reports = report_groups(frame, frame.group_names, frame.gains);
    ASSERT_GT(reports.size(), 1u);
    for (const GroupReport& r : reports) {
        EXPECT_GE(r.energy, 0);
        EXPECT_FALSE(r.noise) << r.name;
    }
}

// ---- baking

TEST(BakeMix, KeepsTheImageAndTheFilm) {
    RenderedStudio rendered;
    auto& [studio, settings, renderer] = rendered;
    studio.scene.mix = some_mix();
    ASSERT_FALSE(renderer.update(studio.scene, settings));
    const Frame mixed = renderer.resolve();
    const Scene baked = bake_mix(studio.scene).scene;
    EXPECT_TRUE(baked.mix.channels.empty());
    EXPECT_NE(baked, studio.scene);
    EXPECT_FALSE(renderer.update(baked, settings)) << "the film is kept";
    const Frame after = renderer.resolve();
    for (size_t i = 0; i < mixed.rgba.size(); ++i) ASSERT_NEAR(after.rgba[i], mixed.rgba[i], 0x1p-20f * mixed.rgba[i]) << i;
    EXPECT_EQ(bake_mix(baked).scene, baked) << "baking twice changes nothing";
    // A fresh render of the baked scene equals the mix, which now has no channels.
    const RenderedImage fresh = render(baked, settings_for(32, 32, 96));
    Studio with_channels;
    with_channels.scene.mix = some_mix();
    EXPECT_TRUE(same_means(fresh.blocks(16, 16), render(with_channels.scene, settings_for(32, 32, 96)).blocks(16, 16)));
}

// Two lights sharing a record and two objects sharing an emissive
// material, separated by the mix, have separate records afterwards.
TEST(BakeMix, SplitsSharedRecords) {
    Studio studio;
    studio.scene.mix.grouping = Grouping::by_object;
    Node twin = *studio.scene.nodes.find(studio.bulb), ball = *studio.scene.nodes.find(studio.ball);
    twin.name = "Twin";
    twin.local.translation.x += 2;
    ball.name = "Other ball";
    ball.local.translation.x -= 2;
    const Id<Node> twin_id = studio.scene.nodes.add(twin), ball_id = studio.scene.nodes.add(ball);
    studio.channel("Twin").intensity = 3;
    studio.channel("Other ball").color = {0, 0, 1};
    const Scene baked = bake_mix(studio.scene).scene;
    const auto light = [&](Id<Node> id) { return *baked.lights.find(baked.nodes.find(id)->light); };
    EXPECT_EQ(light(studio.bulb), studio.light(studio.bulb));
    EXPECT_EQ(light(twin_id).intensity, 3 * studio.light(studio.bulb).intensity);
    const auto glow = [&](Id<Node> id) {
        return baked.materials.find(baked.meshes.find(baked.nodes.find(id)->mesh)->parts[0].material)->emissive;
    };
    EXPECT_EQ(glow(studio.ball), (Vec3{1, 1, 1}));
    EXPECT_EQ(glow(ball_id), (Vec3{0, 0, 1}));
    const RenderSettings settings = settings_for(32, 32, 64);
    EXPECT_TRUE(same_means(render(studio.scene, settings).blocks(16, 16), render(baked, settings).blocks(16, 16)));
}

TEST(BakeMix, DoesNothingWithoutGroups) {
    Studio studio;
    studio.scene.mix = some_mix();
    studio.scene.mix.grouping = Grouping::none;
    Scene cleared = studio.scene;
    cleared.mix.channels.clear();
    EXPECT_EQ(bake_mix(studio.scene).scene, cleared);
}

} // namespace
} // namespace blush::test::TEST_FILE
