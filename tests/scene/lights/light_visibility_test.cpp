// Mute and solo.
#include "scene/lights/light_visibility.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

struct TwoLamps {
    Scene scene;
    Id<Light> key = add("Key"), fill = add("Fill");

    Id<Light> add(const char* name) {
        Light light;
        light.name = name;
        const Id<Light> id = scene.lights.add(light);
        Node node;
        node.light = id;
        scene.nodes.add(node);
        return id;
    }
    void set(Id<Light> id, bool enabled, bool solo) {
        Light light = *scene.lights.find(id);
        light.enabled = enabled;
        light.solo = solo;
        scene.lights.set(id, light);
    }
    bool place_light(Id<Light> id) const { return emits_light(*scene.lights.find(id), any_solo(scene)); }
};

TEST(LightVisibility, SoloMutesOthersAndMuteTakesPrecedence) {
    for (const bool key_on : {false, true})
        for (const bool key_solo : {false, true})
            for (const bool fill_on : {false, true})
                for (const bool fill_solo : {false, true}) {
                    TwoLamps s;
                    s.set(s.key, key_on, key_solo);
                    s.set(s.fill, fill_on, fill_solo);
                    EXPECT_EQ(s.place_light(s.key), key_on && (key_solo || !fill_solo)) << key_on << key_solo << fill_on << fill_solo;
                }
}

TEST(LightVisibility, ADeletedSoloLightIsIgnored) {
    TwoLamps s;
    s.set(s.key, true, true);
    s.scene.nodes.remove(s.scene.nodes.begin()->id);
    ASSERT_TRUE(s.scene.lights.contains(s.key)) << "the record stays";
    EXPECT_TRUE(s.place_light(s.fill));
}

TEST(LightVisibility, WithoutSoloTheSceneIsTheSame) {
    TwoLamps s;
    s.set(s.key, false, false);
    EXPECT_TRUE(with_solo_applied(s.scene) == s.scene);
}

TEST(LightVisibility, AppliedSoloUsesOnlyEnabled) {
    TwoLamps s;
    s.set(s.key, true, true);
    Material glow;
    glow.emissive = {1, 2, 3};
    const Id<Material> glowing = s.scene.materials.add(glow);
    s.scene.environment.kind = Environment::Kind::constant;
    const Scene applied = with_solo_applied(s.scene);
    EXPECT_FALSE(any_solo(applied));
    EXPECT_TRUE(applied.lights.find(s.key)->enabled);
    EXPECT_FALSE(applied.lights.find(s.fill)->enabled);
    EXPECT_EQ(applied.materials.find(glowing)->emissive_strength, 0);
    EXPECT_EQ(applied.environment.intensity, 0);
    EXPECT_TRUE(with_solo_applied(applied) == applied);
}

// A light, an emissive surface and an environment.
struct AllKinds : TwoLamps {
    Id<Material> glowing;
    AllKinds() {
        Material glow;
        glow.emissive = {1, 2, 3};
        glowing = scene.materials.add(glow);
        Node sign;
        sign.mesh = scene.meshes.add({"Sign", {{nullptr, glowing}}});
        scene.nodes.add(sign);
        scene.environment.kind = Environment::Kind::constant;
    }
    void set_glow(bool emits, bool solo) {
        Material glow = *scene.materials.find(glowing);
        glow.emits = emits;
        glow.solo = solo;
        scene.materials.set(glowing, glow);
    }
    float glow_applied() const { return with_solo_applied(scene).materials.find(glowing)->emissive_strength; }
    float environment_applied() const { return with_solo_applied(scene).environment.intensity; }
};

TEST(LightVisibility, ASurfaceMayBeSoloAndMuted) {
    AllKinds s;
    s.set_glow(false, false);
    EXPECT_EQ(s.glow_applied(), 0);
    EXPECT_EQ(s.environment_applied(), 1) << "a muted surface does not mute others";
    EXPECT_TRUE(s.place_light(s.key));
    s.set_glow(true, true);
    EXPECT_EQ(s.glow_applied(), 1);
    EXPECT_EQ(s.environment_applied(), 0);
    EXPECT_FALSE(s.place_light(s.key));
    s.set_glow(false, true);
    EXPECT_EQ(s.glow_applied(), 0) << "mute wins over solo";
    EXPECT_FALSE(s.place_light(s.key));
    EXPECT_TRUE(with_solo_applied(with_solo_applied(s.scene)) == with_solo_applied(s.scene));
}

TEST(LightVisibility, TheEnvironmentMayBeSolo) {
    AllKinds s;
    s.scene.environment.solo = true;
    EXPECT_EQ(s.environment_applied(), 1);
    EXPECT_EQ(s.glow_applied(), 0);
    EXPECT_FALSE(s.place_light(s.key));
    EXPECT_FALSE(any_solo(with_solo_applied(s.scene)));
    s.scene.environment.lights_scene = false;
    EXPECT_FALSE(emits_light(s.scene.environment, any_solo(s.scene))) << "mute wins over solo";
    EXPECT_FALSE(s.place_light(s.key));
    s.scene.environment.kind = Environment::Kind::none;
    EXPECT_TRUE(s.place_light(s.key)) << "what is not there is not solo";
}

} // namespace
} // namespace blush::TEST_FILE
