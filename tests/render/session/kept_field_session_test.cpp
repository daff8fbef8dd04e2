// Sessions begin trained after an edit (kept_field.h), and every image that is complete or saved is that of a fresh start.
#include "measure/stability/rendered_image.h"
#include "measure/stability/scenes.h"
#include "tests/render/scenes.h"
#include "tests/render/session/recording_session.h"
#include "tests/support/images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

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

} // namespace
} // namespace blush::TEST_FILE
