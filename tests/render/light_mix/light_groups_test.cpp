// Light groups and their film planes.
#include "render/light_mix/light_groups.h"

#include "render/materials/material_table.h"
#include "tests/render/studio.h"
#include "tests/support/images.h"

#include <algorithm>
#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

using Grouping = LightMix::Grouping;
using statistics::sidak;
using statistics::significance;

TEST(LightGroups, SumToTheBeauty) {
    const Studio studio;
    for (const int variant : {0, 1, 2, 3, 4}) {
        RenderSettings settings = settings_for(32, 32, 20);
        if (variant == 1) settings.reuse = 16;
        if (variant == 2) settings.adaptive = true;
        if (variant == 3) settings.clamp = {0.3f, true};
        if (variant == 4) settings.clamp = {0.02f, false};
        const Frame frame = render_frame(studio.scene, settings);
        EXPECT_EQ(frame.groups.size(), 5u);
        EXPECT_EQ(frame.clamp.samples > 0, variant >= 3) << "the test needs clamped samples";
        // A ray that hits two suns, or sun and sky, adds both in single precision.
        expect_planes_sum_to_beauty(frame, variant == 1 ? 0x1p-18 : 0x1p-20, std::to_string(variant));
    }
}

TEST(LightGroups, OfShippedScenesSumToTheBeauty) {
    for (const std::string& name : shipped_scene_names())
        for (const Grouping grouping : {Grouping::by_light, Grouping::by_object, Grouping::by_material, Grouping::by_hand}) {
            Scene scene = shipped_scene(name);
            scene.mix.grouping = grouping;
            const Frame frame = render_frame(scene, settings_for(16, 16, 4));
            expect_planes_sum_to_beauty(frame, 0x1p-20, name);
        }
}

TEST(LightGroups, DoNotChangeTheBeautyAndAreDeterministic) {
    Studio studio;
    const RenderSettings settings = settings_for(40, 24, 6);
    const Frame with = render_frame(studio.scene, settings);
    EXPECT_EQ(render_frame(studio.scene, settings, 3).groups, with.groups) << "threads";
    for_each_isa([&](const std::string& isa) { EXPECT_EQ(render_frame(studio.scene, settings).groups, with.groups) << isa; });

    Renderer split({.threads = 2, .planes = {}});
    split.update(studio.scene, settings);
    split.render(0, 1);
    split.render(1, 5);
    EXPECT_EQ(split.resolve().groups, with.groups) << "batches";

    studio.scene.mix.grouping = Grouping::none;
    const Frame without = render_frame(studio.scene, settings);
    EXPECT_TRUE(without.groups.empty());
    EXPECT_EQ(without.light_groups, nullptr);
    EXPECT_EQ(without.rgba, with.rgba);
}

TEST(LightGroups, HalfDifferencesSumToThatOfTheBeauty) {
    const Studio studio;
    for (const bool adaptive : {false, true}) {
        RenderSettings settings = settings_for(32, 32, 20);
        settings.adaptive = adaptive;
        Renderer renderer({.threads = 2, .planes = {.half_difference = true}});
        renderer.update(studio.scene, settings);
        renderer.render(0, 20);
        const Frame frame = renderer.resolve();
        ASSERT_EQ(frame.group_half_differences.size(), frame.groups.size());
        double largest = 0;
        for (size_t i = 0; i < frame.half_difference.size(); ++i) {
            double sum = 0;
            for (size_t k = 0; k < frame.groups.size(); ++k) sum += double(frame.gains[k].y) * double(frame.group_half_differences[k][i].y);
            const double size = std::abs(double(frame.rgba[4 * i + 1])) + std::abs(sum);
            ASSERT_NEAR(sum, double(frame.half_difference[i].y), 0x1p-18 * (1 + size)) << i;
            largest = std::max(largest, std::abs(sum));
        }
        EXPECT_GT(largest, 0);
    }
}

// The scene with only the lights of one group.
Scene alone(const Studio& studio, const LightGroup& group) {
    Scene scene = studio.scene;
    if (!group.environment) scene.environment.intensity = 0;
    for (auto [id, light] : studio.scene.lights) {
        light.enabled = std::ranges::find(group.lights, id) != group.lights.end();
        scene.lights.set(id, light);
    }
    for (auto [id, material] : studio.scene.materials) {
        if (std::ranges::find(group.materials, id) == group.materials.end()) material.emissive_strength = 0;
        scene.materials.set(id, material);
    }
    return scene;
}

TEST(LightGroups, HoldOnlyTheirOwnLight) {
    const Studio studio;
    const RenderSettings settings = settings_for(32, 32, 64);
    const Frame frame = render_frame(studio.scene, settings);
    for (size_t k = 0; k < frame.groups.size(); ++k) {
        // With a light mix, meshes of disabled lights remain: nothing else differs.
        const Measured whole = render(alone(studio, frame.light_groups->groups[k]), settings).whole();
        const GroupShare& share = frame.group_shares[k];
        EXPECT_GT(share.mean.y, 0) << frame.group_names[k];
        const double error = std::hypot(std::sqrt(share.variance.y / (32 * 32)), whole.error.y);
        EXPECT_TRUE(statistics::z_verdict("plane differs", share.mean.y - whole.mean.y, error, whole.mean.y, sidak(significance, 5)))
            << frame.group_names[k];
    }
}

std::vector<std::string> names_by(Grouping grouping, Scene scene) {
    scene.mix.grouping = grouping;
    std::vector<std::string> names;
    for (const LightGroup& group : make_light_groups(scene).groups) names.push_back(group.name);
    return names;
}

TEST(LightGroups, AreMadeByLightObjectMaterialOrHand) {
    using Names = std::vector<std::string>;
    Studio studio;
    for (auto [id, node] : studio.scene.nodes) {
        if (id == studio.ball) node.name = "Ball";
        if (id == studio.panel) node.name = "Softbox";
        studio.scene.nodes.set(id, node);
    }
    for (auto [id, material] : studio.scene.materials) {
        if (!is_black(material.emissive)) material.name = "Glow";
        studio.scene.materials.set(id, material);
    }
    EXPECT_EQ(names_by(Grouping::by_light, studio.scene), (Names{"Environment", "Bulb", "Softbox", "Sun", "Ball"}))
        << "the name that the outliner shows: of the node, if it has one";
    EXPECT_EQ(names_by(Grouping::by_object, studio.scene), (Names{"Environment", "Bulb", "Softbox", "Sun", "Ball"}));
    EXPECT_EQ(names_by(Grouping::by_material, studio.scene), (Names{"Environment", "Bulb", "Softbox", "Sun", "Glow"}));
    studio.change(studio.bulb, [](Light& l) { l.group = "Warm"; });
    studio.scene.environment.group = "Glow";
    EXPECT_EQ(names_by(Grouping::by_hand, studio.scene), (Names{"Glow", "Warm", "Softbox", "Sun"})) << "by the material's name";
    Node bulb = *studio.scene.nodes.find(studio.bulb);
    bulb.name = "Softbox";
    studio.scene.nodes.set(studio.bulb, bulb);
    EXPECT_EQ(names_by(Grouping::by_light, studio.scene), (Names{"Environment", "Softbox", "Softbox 2", "Sun", "Ball"}))
        << "duplicate names get numbers";
}

TEST(LightGroups, OfALightOnSeveralNodesHasTheNameOfTheLight) {
    Studio studio;
    Node first = *studio.scene.nodes.find(studio.bulb);
    first.name = "Left";
    studio.scene.nodes.set(studio.bulb, first);
    EXPECT_EQ(names_by(Grouping::by_light, studio.scene)[1], "Left");
    Node second = first;
    second.name = "Right";
    studio.scene.nodes.add(second);
    EXPECT_EQ(names_by(Grouping::by_light, studio.scene)[1], "Bulb");
    EXPECT_EQ(names_by(Grouping::by_light, studio.scene).size(), 5u);
    studio.change(studio.bulb, [](Light& l) { l.name.clear(); });
    EXPECT_EQ(names_by(Grouping::by_light, studio.scene)[1], "Left");
}

TEST(LightGroups, ShareTheLastPlaneIfThereAreTooMany) {
    Studio studio;
    for (int i = 0; i < 20; ++i) place_light(studio.scene, lamp("More", Light::Kind::point, 0.1f, {1, 1, 1}), at({float(i), 1, 0}));
    const LightGroups groups = make_light_groups(studio.scene);
    ASSERT_EQ(groups.groups.size(), size_t(max_light_groups));
    EXPECT_EQ(groups.sharing, 25 - 15);
    EXPECT_EQ(groups.groups.back().lights.size(), 10u);
    const Frame frame = render_frame(studio.scene, settings_for(16, 16, 4));
    expect_planes_sum_to_beauty(frame, 0x1p-20, "shared");
    // Groups with a channel keep their own plane.
    studio.channel("More 20").intensity = 2;
    EXPECT_EQ(make_light_groups(studio.scene).groups.front().name, "More 20");
}

} // namespace
} // namespace blush::test::TEST_FILE
