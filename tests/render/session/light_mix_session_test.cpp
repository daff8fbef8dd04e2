// The light mix in a running session: an edit of lights applies to the existing samples, denoised or not, without a restart.
#include "render/light_mix/light_mix.h"
#include "render/session/render_session.h"
#include "tests/render/session/recording_session.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using State = SessionStatus::State;
using test::Event;
using test::RecordingSession;

struct Lamps {
    test::Sample sample = test::sample_project();
    Project& project = sample.project;

    Lamps() {
        project.render.width = 32;
        project.render.height = 24;
        project.render.spp = 8;
        project.scene.mix.grouping = LightMix::Grouping::by_light;
    }
    void dim(float factor) {
        Light lamp = *project.scene.lights.find(sample.lamp);
        lamp.intensity *= factor;
        project.scene.lights.set(sample.lamp, lamp);
    }
};

FramePtr frame_of(RecordingSession& session, uint64_t revision) {
    return session.wait_for([&](const Event& e) { return e.frame && e.frame->revision == revision && e.frame->complete; }).frame;
}

TEST(SessionMix, AppliesToExistingSamples) {
    Lamps lamps;
    RecordingSession session;
    session->submit(1, lamps.project.scene, lamps.project.render);
    const FramePtr before = frame_of(session, 1);
    ASSERT_TRUE(before);
    ASSERT_EQ(before->groups.size(), 2u);

    lamps.dim(3);
    session->submit(2, lamps.project.scene, lamps.project.render);
    const FramePtr after = frame_of(session, 2);
    ASSERT_TRUE(after);
    EXPECT_EQ(after->samples, 8);
    EXPECT_EQ(after->groups, before->groups) << "not rendered again";
    EXPECT_EQ(after->gains, (Gains{{1, 1, 1}, {3, 3, 3}}));
    EXPECT_NE(after->rgba, before->rgba);
    EXPECT_NE(after->error.rmse, before->error.rmse);
    // The window's preview until then, mixed from the previous frame.
    const std::vector<float> meanwhile = mixed_rgba(*before, after->gains);
    for (size_t i = 0; i < meanwhile.size(); ++i) ASSERT_NEAR(meanwhile[i], after->rgba[i], 0x1p-20f * after->rgba[i]);

    lamps.dim(1.f / 3);
    lamps.project.scene.view.position.x += 0.1f;
    session->submit(3, lamps.project.scene, lamps.project.render);
    const FramePtr moved = frame_of(session, 3);
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->rgba, test::fresh_image(lamps.project.scene, lamps.project.render, 8).rgba);
}

// A mix submitted before its image was applied still uses planes with that image's own emission.
TEST(SessionMix, IsRelativeToTheSceneThatBeganTheImage) {
    Lamps lamps;
    const Scene first = lamps.project.scene;
    RecordingSession session;
    session->submit(1, lamps.project.scene, lamps.project.render);
    lamps.dim(0);
    session->submit(2, lamps.project.scene, lamps.project.render);
    lamps.project.scene = first;
    lamps.dim(2);
    session->submit(3, lamps.project.scene, lamps.project.render);
    const FramePtr frame = frame_of(session, 3);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->gains, (Gains{{1, 1, 1}, {2, 2, 2}}));
    EXPECT_EQ(frame->samples, 8);
}

TEST(SessionMix, SavesAFilmThatOthersCanContinue) {
    Lamps lamps;
    RecordingSession session;
    session->submit(1, lamps.project.scene, lamps.project.render);
    ASSERT_TRUE(frame_of(session, 1));
    lamps.dim(3);
    session->submit(2, lamps.project.scene, lamps.project.render);
    const FramePtr mixed = frame_of(session, 2);
    ASSERT_TRUE(mixed);
    session->request_film(2);
    std::optional<RequestedFilm> kept;
    session.wait_for([&](const Event&) {
        if (!kept) kept = session->take_requested_film();
        return kept.has_value();
    });
    ASSERT_TRUE(kept && kept->film) << (kept ? kept->why_none : "");

    RecordingSession other;
    other->submit(1, lamps.project.scene, lamps.project.render, {}, kept->film);
    const FramePtr restored = frame_of(other, 1);
    ASSERT_TRUE(restored);
    EXPECT_EQ(restored->gains, Gains(2, Vec3{1, 1, 1})) << "its lights include the mixed gains";
    for (size_t i = 0; i < mixed->rgba.size(); ++i) ASSERT_NEAR(restored->rgba[i], mixed->rgba[i], 0x1p-20f * mixed->rgba[i]);
}

// Fake networks: halve their input.
Result<std::optional<Denoised>> halved(const DenoiseInput& input, const DenoiseOptions&, const std::function<bool()>&) {
    Denoised denoised;
    for (size_t i = 0; i < size_t(input.width) * size_t(input.height); ++i)
        for (size_t c = 0; c < 3; ++c) denoised.rgb.push_back(input.color.values[i * size_t(input.color.stride) + c] / 2);
    return std::optional(std::move(denoised));
}

TEST(SessionMix, StaysDenoised) {
    Lamps lamps;
    RecordingSession session(2, {}, halved);
    session->want_denoised(true);
    session->submit(1, lamps.project.scene, lamps.project.render);
    // Earlier frames are denoised again with better quality.
    const auto is_done = [](const Event& e) {
        return e.frame && e.frame->complete && e.denoised && e.denoised->samples == 8 && e.denoised->quality == DenoiseQuality::high;
    };
    const Event before = session.wait_for(is_done);
    ASSERT_TRUE(before.denoised && before.denoised->groups);
    EXPECT_EQ(before.denoised->groups->planes.size(), 2u);

    lamps.dim(3);
    session->submit(2, lamps.project.scene, lamps.project.render);
    const Event after = session.wait_for([&](const Event& e) { return is_done(e) && e.frame->revision == 2; });
    ASSERT_TRUE(after.denoised);
    EXPECT_EQ(after.denoised->gains, after.frame->gains);
    EXPECT_EQ(after.denoised->groups, before.denoised->groups) << "not denoised again";
    const std::vector<float>& rgb = after.denoised->denoised.rgb;
    const auto planes = planes_of(*after.denoised);
    const Gains& gains = after.denoised->gains;
    for (size_t i = 0; i < rgb.size(); ++i) {
        const auto of = [&](const Vec3& gain) { return i % 3 == 0 ? gain.x : i % 3 == 1 ? gain.y : gain.z; };
        const float mixed = of(gains[0]) * planes[0][i] + of(gains[1]) * planes[1][i];
        ASSERT_NEAR(rgb[i], mixed, 0x1p-20f * mixed);
    }
}

} // namespace
} // namespace blush::TEST_FILE
