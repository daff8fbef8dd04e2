// Identity of the image of each submission: which edits begin an image, continue it, or only remix it.
#include "render/session/submission.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

class Submissions : public ::testing::Test {
protected:
    void SetUp() override {
        scene.mix.grouping = LightMix::Grouping::by_light;
        submit();
    }
    const Submission& submit(const PlaneSet& planes = {}, bool has_loaded_samples = false) {
        const SubmissionContent content{scene, settings, planes};
        before = last;
        last = next_submission(before.get(), before ? before->revision + 1 : 1, content, changes_since(before.get(), content),
                               has_loaded_samples);
        return *last;
    }
    template <class Edit> void edit_lamp(Edit edit) {
        Light lamp = *scene.lights.find(sample.lamp);
        edit(lamp);
        scene.lights.set(sample.lamp, lamp);
    }

    test::Sample sample = test::sample_project();
    Scene& scene = sample.project.scene;
    RenderSettings& settings = sample.project.render;
    SubmissionPtr before, last;
};

TEST_F(Submissions, TheFirstBeginsAnImage) {
    EXPECT_EQ(last->image, 1u);
    EXPECT_FALSE(last->continues_image);
    EXPECT_FALSE(last->changes.any());
    ASSERT_TRUE(last->groups);
    EXPECT_EQ(last->mixing.gains.size(), last->groups->groups.size());
    EXPECT_EQ(&last->base(), &last->groups->base);
}

TEST_F(Submissions, StopRulesAndNamesContinueIt) {
    settings.spp += 8;
    EXPECT_TRUE(submit().continues_image);
    EXPECT_TRUE(last->changes.stop_rules);
    scene.mix = {};
    submit();
    EXPECT_FALSE(last->continues_image) << "other groups";
    EXPECT_FALSE(last->groups);
    edit_lamp([](Light& lamp) { lamp.name = "Key"; });
    EXPECT_TRUE(submit().continues_image) << "names reach the image only through groups";
    EXPECT_FALSE(last->changes.any());
    EXPECT_EQ(last->image, before->image);
}

TEST_F(Submissions, TheLookIsTheSameFromAnyView) {
    const uint64_t look = last->look;
    scene.view.position.x += 1;
    EXPECT_FALSE(submit().continues_image);
    EXPECT_EQ(last->look, look);
    settings.spp += 8;
    EXPECT_EQ(submit().look, look);
    scene.view.position.x += 1;
    edit_lamp([](Light& lamp) { lamp.radius += 0.1f; });
    EXPECT_NE(submit().look, look) << "the light changed with the view";
    const uint64_t other = last->look;
    settings.width += 8;
    EXPECT_NE(submit().look, other) << "images of another size";
}

TEST_F(Submissions, EmissionOfMixedLightsContinuesIt) {
    edit_lamp([](Light& lamp) { lamp.intensity *= 3; });
    EXPECT_TRUE(submit().continues_image);
    EXPECT_EQ(last->groups, before->groups);
    EXPECT_NE(last->mixing.gains, before->mixing.gains);
    const Gains brightened = last->mixing.gains;
    settings.spp += 8;
    EXPECT_EQ(submit().mixing.gains, brightened) << "a later submission keeps the mix";
    scene.mix = {};
    submit();
    edit_lamp([](Light& lamp) { lamp.intensity *= 3; });
    EXPECT_FALSE(submit().continues_image) << "without a mix the samples hold the old emission";
}

TEST_F(Submissions, OtherEditsBeginAnImage) {
    const uint64_t first = last->image;
    scene.view.position.x += 1;
    EXPECT_EQ(submit().image, first + 1);
    EXPECT_NE(last->groups, before->groups) << "based on the new scene";
    settings.seed += 1;
    EXPECT_EQ(submit().image, first + 2);
    edit_lamp([](Light& lamp) { lamp.kind = Light::Kind::spot; });
    EXPECT_EQ(submit().image, first + 3);
}

// An edit of emission, which mostly continues the image.
void change_emission(test::Rng& rng, Scene& scene) {
    const auto below = [&](size_t n) { return size_t(rng() % n); };
    const auto light = scene.lights.empty() ? Table<Light>::Entry{} : scene.lights.entries()[below(scene.lights.size())];
    const auto material = scene.materials.empty() ? Table<Material>::Entry{} : scene.materials.entries()[below(scene.materials.size())];
    Light l = light.value;
    Material m = material.value;
    switch (below(9)) {
    case 0: l.intensity = float(below(4)); break;
    case 1: l.color = {float(below(2)), 1, 0.5f}; break;
    case 2: l.enabled = !l.enabled; break;
    case 3: l.solo = !l.solo; break;
    case 4: l.name = "Key"; break;
    case 5: m.emissive = {float(below(2)), float(below(2)), 1}; break;
    case 6: m.emissive_strength = float(below(4)); break;
    case 7: m.emits = !m.emits; break;
    default: scene.environment.intensity = float(1 + below(3)); break;
    }
    if (light.id) scene.lights.set(light.id, l);
    if (material.id) scene.materials.set(material.id, m);
}

// The changes of each edit, taken one after the other, decide as a comparison with the scene that began the image.
TEST_F(Submissions, RandomEditsContinueItAsAComparisonWithItsBaseDecides) {
    size_t mixed = 0, begun = 0;
    for (uint32_t seed = 0; seed < 200; ++seed) {
        test::Rng rng(seed);
        last = nullptr;
        sample = test::sample_project();
        scene.mix.grouping = LightMix::Grouping(1 + seed % 4);
        submit();
        for (int i = 0; i < 40; ++i) {
            if (rng() % 8)
                change_emission(rng, scene);
            else if (auto edited = blush::apply(sample.project, test::random_edit(rng, sample.project)))
                sample.project = *std::move(edited);
            submit();
            const std::optional<Mixing> mixing = before->groups ? compared_mixing(*before->groups, scene) : std::nullopt;
            const Changes& changes = last->changes;
            ASSERT_EQ(last->continues_image, !changes.affects_image() || (changes.only_light() && mixing)) << seed << " " << i;
            if (!last->continues_image) ++begun;
            if (!last->continues_image || !last->groups) continue;
            ASSERT_TRUE(mixing) << seed << " " << i;
            ASSERT_EQ(last->mixing.gains, mixing->gains) << seed << " " << i;
            ASSERT_EQ(last->mixing.names, mixing->names) << seed << " " << i;
            mixed += changes.affects_image();
        }
    }
    EXPECT_GT(mixed, 1000u);
    EXPECT_GT(begun, 1000u);
}

// What an edit that does not reach the image leaves behind is compared once, however often the window asks.
TEST_F(Submissions, ContentIsComparedWithTheContentBefore) {
    scene.mix = {};
    LastContent last_content;
    const auto changes = [&] {
        const SubmissionContent content{scene, settings};
        Changes differences = last_content.changes_to(content);
        last_content.keep(content);
        return differences;
    };
    EXPECT_FALSE(changes().any());
    edit_lamp([](Light& lamp) { lamp.name = "Key"; });
    EXPECT_FALSE(changes().any());
    EXPECT_TRUE(last_content.scene().lights.shares_storage(scene.lights));
    edit_lamp([](Light& lamp) { lamp.intensity *= 2; });
    EXPECT_EQ(changes().lights, std::vector{sample.lamp});
    settings.spp += 8;
    EXPECT_TRUE(changes().stop_rules);
    EXPECT_FALSE(changes().any());
}

TEST_F(Submissions, MorePlanesBeginAnImageFewerDoNot) {
    EXPECT_FALSE(submit({.bounces = 4}).continues_image);
    EXPECT_TRUE(submit().continues_image);
}

TEST_F(Submissions, LoadedSamplesBeginAnImage) {
    EXPECT_FALSE(submit({}, true).continues_image);
    EXPECT_EQ(last->image, before->image + 1);
}

} // namespace
} // namespace blush::TEST_FILE
