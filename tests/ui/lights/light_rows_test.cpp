// Rows and groups of the light table.
#include "ui/lights/light_rows.h"

#include "scene/document/document.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush::TEST_FILE {
namespace {

struct Studio {
    Scene scene;
    Id<Node> key, fill;
    Id<Material> neon;

    Studio() {
        key = lamp("Key", "Warm");
        fill = lamp("Fill", "");
        Material glow;
        glow.name = "Neon";
        glow.emissive = {1, 0, 0};
        glow.emissive_strength = 40;
        neon = scene.materials.add(glow);
        Node sign;
        sign.mesh = scene.meshes.add({"Sign", {{nullptr, neon}, {nullptr, scene.materials.add(Material{})}, {nullptr, neon}}});
        scene.nodes.add(sign);
        scene.environment.kind = Environment::Kind::constant;
    }
    Id<Node> lamp(const char* name, const char* group) {
        Light light;
        light.group = group;
        Node node;
        node.name = name;
        node.light = scene.lights.add(light);
        return scene.nodes.add(node);
    }
    Light light(Id<Node> id) const { return *scene.lights.find(scene.nodes.find(id)->light); }
    void set(Id<Node> id, const Light& light) { scene.lights.set(scene.nodes.find(id)->light, light); }
    void apply(const std::vector<Edit>& edits) {
        Document document(Project{scene, {}, {}});
        ASSERT_TRUE(document.apply(edits, "edit"));
        scene = document.project().scene;
    }
};

std::vector<std::string> names(const LightRows& rows) {
    std::vector<std::string> all;
    for (const LightRow& row : rows.rows) all.push_back(row.name);
    return all;
}

TEST(LightRows, ListAllLightsByGroup) {
    const Studio s;
    const auto groups = light_rows(s.scene);
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].group, "Warm");
    EXPECT_EQ(names(groups[0]), (std::vector<std::string>{"Key"}));
    EXPECT_EQ(names(groups[1]), (std::vector<std::string>{"Fill", "Neon", "Environment"})) << "an emissive material once, others not";
    EXPECT_EQ(groups[1].rows[1].material, s.neon);
    EXPECT_EQ(groups[1].rows[1].intensity, 40);
    EXPECT_TRUE(groups[1].rows[2].environment);
    EXPECT_TRUE(light_rows(Scene()).empty());
}

TEST(LightRows, TellWhichLightsAreOn) {
    Studio s;
    Light key = s.light(s.key);
    key.solo = true;
    s.set(s.key, key);
    for (const LightRows& group : light_rows(s.scene))
        for (const LightRow& row : group.rows) EXPECT_EQ(row.enabled, row.name == "Key") << row.name;
    key.enabled = false;
    s.set(s.key, key);
    EXPECT_FALSE(light_rows(s.scene)[0].rows[0].enabled) << "mute wins";
}

TEST(LightRows, MuteAndSoloWorkForAllRows) {
    for (const char* name : {"Key", "Neon", "Environment"}) {
        Studio s;
        const auto row_called = [&](const std::string& wanted) {
            for (const LightRows& group : light_rows(s.scene))
                for (const LightRow& row : group.rows)
                    if (row.name == wanted) return row;
            return LightRow();
        };
        s.apply({with_switches(s.scene, row_called(name), true, true)});
        for (const char* other : {"Key", "Fill", "Neon", "Environment"})
            EXPECT_EQ(row_called(other).enabled, std::string(other) == name) << name << " solo, " << other;
        s.apply({with_switches(s.scene, row_called(name), false, true)});
        EXPECT_FALSE(row_called(name).enabled) << name << ": mute wins";
        EXPECT_FALSE(row_called("Fill").enabled);
        s.apply({with_switches(s.scene, row_called(name), true, false)});
        EXPECT_TRUE(row_called("Fill").enabled);
    }
}

TEST(LightRows, HiddenLightIsListedAsOff) {
    Studio s;
    Node key = *s.scene.nodes.find(s.key);
    key.visible = false;
    s.scene.nodes.set(s.key, key);
    const auto groups = light_rows(s.scene);
    EXPECT_EQ(groups[0].rows[0].name, "Key");
    EXPECT_FALSE(groups[0].rows[0].enabled);
}

TEST(LightRows, SharesAreThoseOfTheGroup) {
    Studio s;
    s.scene.mix.grouping = LightMix::Grouping::by_light;
    const LightGroups groups = make_light_groups(s.scene);
    std::vector<GroupReport> reports;
    for (size_t k = 0; k < groups.groups.size(); ++k) reports.push_back({groups.groups[k].name, double(k), 10.0 + double(k)});
    const auto rows = light_rows(s.scene);
    const auto key = share_of(rows[0].rows[0], groups, reports), fill = share_of(rows[1].rows[0], groups, reports);
    ASSERT_TRUE(key && fill);
    EXPECT_TRUE(key->alone);
    EXPECT_EQ(key->energy, groups.of_light(s.key));
    EXPECT_EQ(fill->noise, 10 + groups.of_light(s.fill));
    s.lamp("Late", "");
    EXPECT_FALSE(share_of(light_rows(s.scene)[1].rows[1], groups, reports)) << "it is not in the frame";

    s.lamp("Rim", "Warm");
    s.scene.mix.grouping = LightMix::Grouping::by_hand;
    const LightGroups by_hand = make_light_groups(s.scene);
    reports.resize(by_hand.groups.size());
    const auto together = share_of(light_rows(s.scene)[0].rows[0], by_hand, reports);
    ASSERT_TRUE(together);
    EXPECT_FALSE(together->alone);
}

TEST(LightRows, GroupsCanBeJoinedLeftAndRenamed) {
    Studio s;
    s.apply(put_into_group(s.scene, std::vector{s.scene.nodes.find(s.fill)->light}, true, "Warm"));
    EXPECT_EQ(s.light(s.fill).group, "Warm");
    EXPECT_EQ(s.scene.environment.group, "Warm");
    s.apply(rename_group(s.scene, "Warm", "Lamps"));
    EXPECT_EQ(s.light(s.key).group, "Lamps");
    EXPECT_EQ(s.light(s.fill).group, "Lamps");
    EXPECT_EQ(s.scene.environment.group, "Lamps");
    s.apply(put_into_group(s.scene, std::vector{s.scene.nodes.find(s.key)->light}, false, ""));
    EXPECT_EQ(s.light(s.key).group, "");
}

} // namespace
} // namespace blush::TEST_FILE
