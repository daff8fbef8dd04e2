// Sessions begin trained after an edit (kept_field.h), and every image that is complete or saved is that of a fresh start.
#include "measure/stability/rendered_image.h"
#include "measure/stability/scenes.h"
#include "tests/render/scenes.h"
#include "tests/render/session/recording_session.h"
#include "tests/support/images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace blush::TEST_FILE {
namespace {

using namespace stability;
using test::RecordingSession;
using test::same_pixels;
using State = SessionStatus::State;

RenderSettings guided(int64_t samples) {
    RenderSettings settings = settings_for(80, 48, samples);
    settings.caustics = CausticStrategy::guiding;
    return settings;
}

bool begins_trained(const Frame& frame) {
    const auto use = std::ranges::find(*frame.feature_report, "path guiding", &FeatureUse::name);
    return use != frame.feature_report->end() && use->why.starts_with("directions learned 1 edit ago");
}

TEST(KeptFieldSession, CompleteAndSavedImagesAreThoseOfAFreshStart) {
    const Scene before = test::glass_ball_in_sun();
    Scene after = before;
    for (const auto& [id, light] : before.lights) {
        Light brighter = light;
        brighter.intensity = 5;
        after.lights.set(id, brighter);
    }
    for (const int64_t samples : {1, 4}) {
        RecordingSession session;
        session->submit(1, before, guided(4));
        session.wait_for(1, State::complete);
        const RenderSettings settings = guided(samples);
        session->submit(2, after, settings);
        const auto last = session.wait_for(2, State::complete);
        ASSERT_TRUE(last.frame);
        RecordingSession fresh;
        fresh->submit(1, after, settings);
        EXPECT_TRUE(same_pixels(*last.frame, *fresh.wait_for(1, State::complete).frame)) << samples;
        session->request_film(2);
        std::optional<RequestedFilm> saved;
        session.wait_for([&](const auto&) { return saved || (saved = session->take_requested_film()); });
        ASSERT_TRUE(saved && saved->film) << (saved ? saved->why_none : "");
        EXPECT_EQ(saved->film->samples, samples);
        session.shut_down();
        const auto frames = session.frames();
        // A complete image is shown settled.
        EXPECT_EQ(std::ranges::any_of(frames, [](const FramePtr& f) { return f->revision == 2 && begins_trained(*f); }), samples > 1);
    }
}

// A glass ball around a small lamp: light paths alone find its light, many for each camera path.
Scene lamp_in_glass() {
    Scene scene;
    test::place(scene, test::floor_quad(2), test::lambert(0.6f));
    test::place(scene, test::sphere(false), test::glass(0, 1.5f), test::at({0, 0.6f, 0}, 0.5f));
    Light light;
    light.kind = Light::Kind::point;
    light.radius = 0.001f;
    light.intensity = 5;
    test::place_light(scene, light, test::at({0.1f, 0.7f, 0}));
    scene.view = test::looking({0, 1.5f, 4}, {0, 0.4f, 0}, 0.6f);
    return scene;
}

TEST(KeptFieldSession, ShowsTheFirstSamplePartByPart) {
    Scene before = lamp_in_glass(), after = before;
    for (const auto& [id, light] : before.lights) {
        Light brighter = light;
        brighter.intensity = 9;
        after.lights.set(id, brighter);
    }
    RenderSettings settings = settings_for(192, 108, 4);
    RecordingSession session;
    session->submit(1, before, settings);
    session.wait_for(1, State::complete);
    session->submit(2, after, settings);
    const auto last = session.wait_for(2, State::complete);
    ASSERT_TRUE(last.frame);
    RecordingSession fresh;
    fresh->submit(1, after, settings);
    EXPECT_TRUE(same_pixels(*last.frame, *fresh.wait_for(1, State::complete).frame));
    session.shut_down();

    const auto first_samples = [&](uint64_t revision) {
        std::vector<FramePtr> found = session.frames();
        std::erase_if(found, [&](const FramePtr& f) { return f->revision != revision || f->divider > 1 || f->samples > 1; });
        return found;
    };
    EXPECT_EQ(first_samples(1).size(), 1) << "nothing was kept";
    const std::vector<FramePtr> parts = first_samples(2);
    EXPECT_GT(parts.size(), 4);
    for (size_t k = 1; k < parts.size(); ++k) {
        EXPECT_FALSE(same_pixels(*parts[k], *parts[k - 1])) << k;
        EXPECT_GT(parts[k]->seconds, parts[k - 1]->seconds) << k;
    }
}

} // namespace
} // namespace blush::TEST_FILE
