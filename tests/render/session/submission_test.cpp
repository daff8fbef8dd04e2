// Identity of the image of each submission: which edits begin an image, continue it, or only remix it.
#include "render/session/submission.h"
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
