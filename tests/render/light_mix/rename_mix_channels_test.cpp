// Channels of the light mix stay attached to their light, however an edit renames the groups.
#include "render/light_mix/rename_mix_channels.h"

#include "render/light_mix/light_groups.h"
#include "tests/render/studio.h"

#include <array>

namespace blush::test::TEST_FILE {
namespace {

struct Carried : Studio {
    // The names of the mix's channels after an edit.
    std::vector<std::string> after(const Edit& edit) const {
        const LightMix mix = rename_mix_channels({scene, {}, {}}, {&edit, 1}).value_or(scene.mix);
        std::vector<std::string> names;
        for (const MixChannel& c : mix.channels) names.push_back(c.group);
        return names;
    }
    template <class With> Edit changed(Id<Node> node, With&& with) const {
        Light l = light(node);
        with(l);
        return SetLight{light_of(node), l};
    }
};
using Names = std::vector<std::string>;

TEST(RenameMixChannels, FollowsARenamedLight) {
    Carried s;
    s.channel("Bulb").intensity = 3;
    s.channel("Sun");
    EXPECT_EQ(s.after(s.changed(s.bulb, [](Light& l) { l.name = "Lamp"; })), (Names{"Lamp", "Sun"}));
    EXPECT_EQ(s.after(s.changed(s.bulb, [](Light& l) { l.intensity = 9; })), (Names{"Bulb", "Sun"}));
    EXPECT_EQ(s.after(s.changed(s.bulb, [](Light& l) { l.name = "Panel"; })), (Names{"Panel", "Sun"}))
        << "the other light becomes the second of this name";
    LightMix mix = s.scene.mix;
    mix.channels.pop_back();
    EXPECT_EQ(rename_mix_channels({s.scene, {}, {}}, std::array<Edit, 1>{SetMix{mix}}), std::nullopt)
        << "edits of the mix itself are unchanged";
}

TEST(RenameMixChannels, FollowsARenamedObjectAndMaterial) {
    Carried s;
    Node ball = *s.scene.nodes.find(s.ball);
    s.scene.mix.grouping = LightMix::Grouping::by_object;
    const LightGroups by_object = make_light_groups(s.scene);
    s.channel(by_object.groups[size_t(by_object.of_surface(s.ball, s.scene.meshes.find(ball.mesh)->parts[0].material))].name.c_str());
    ball.name = "Moon";
    EXPECT_EQ(s.after(SetNode{s.ball, ball}), Names{"Moon"});

    Carried m;
    m.scene.mix.grouping = LightMix::Grouping::by_material;
    const Id<Material> id = m.scene.meshes.find(m.scene.nodes.find(m.ball)->mesh)->parts[0].material;
    Material material = *m.scene.materials.find(id);
    const LightGroups by_material = make_light_groups(m.scene);
    m.channel(by_material.groups[size_t(by_material.of_surface(m.ball, id))].name.c_str());
    material.name = "Glow";
    EXPECT_EQ(m.after(SetMaterial{id, material}), Names{"Glow"});
}

TEST(RenameMixChannels, RemovesChannelsOfLightsWhoseNameIsReused) {
    Carried s;
    const Id<Node> second = place_light(s.scene, lamp("Bulb", Light::Kind::point, 1, {1, 1, 1}), at({1, 1, 1}));
    s.channel("Bulb").intensity = 2;
    s.channel("Bulb 2").intensity = 5;
    const LightMix mix = rename_mix_channels({s.scene, {}, {}}, std::array<Edit, 1>{RemoveNode{s.bulb}}).value_or(s.scene.mix);
    ASSERT_EQ(mix.channels.size(), 1u);
    EXPECT_EQ(mix.channels[0].group, "Bulb");
    EXPECT_EQ(mix.channels[0].intensity, 5);
    EXPECT_EQ(s.after(RemoveNode{second}), (Names{"Bulb", "Bulb 2"}))
        << "its name is unused: undo, or showing the light again, restores it";
}

TEST(RenameMixChannels, KeepsChannelsOfRemainingMembersOfAManualGroup) {
    Carried s;
    s.scene.mix.grouping = LightMix::Grouping::by_hand;
    for (const Id<Node> node : {s.bulb, s.panel}) s.change(node, [](Light& l) { l.group = "Warm"; });
    s.channel("Warm").intensity = 0.5f;
    EXPECT_EQ(s.after(s.changed(s.bulb, [](Light& l) { l.group = "Cool"; })), Names{"Warm"});
    s.change(s.panel, [](Light& l) { l.group.clear(); });
    EXPECT_EQ(s.after(s.changed(s.bulb, [](Light& l) { l.group = "Cool"; })), Names{"Cool"});
}

// Beyond sixteen groups only those with a channel have their own plane: the renamed group keeps its plane.
TEST(RenameMixChannels, KnowsGroupsThatShareAPlane) {
    Carried s;
    for (int i = 0; i < 20; ++i) place_light(s.scene, lamp("Extra", Light::Kind::point, 1, {1, 1, 1}), at({0, 1, 0}));
    const Id<Node> late = place_light(s.scene, lamp("Late", Light::Kind::point, 1, {1, 1, 1}), at({0, 1, 0}));
    s.channel("Late");
    EXPECT_EQ(s.after(s.changed(late, [](Light& l) { l.name = "Later"; })), Names{"Later"});
}

} // namespace
} // namespace blush::test::TEST_FILE
