// The session as the window uses it. Tests rely on the order of announcements, never on durations.
#include "render/session/render_session.h"

#include "scene/reuse_setting.h"
#include "tests/render/session/recording_session.h"
#include "tests/render/session/rich_project.h"
#include "tests/support/eventually.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <thread>

namespace blush::TEST_FILE {
namespace {

using State = SessionStatus::State;
using test::checksum;
using test::Event;
using test::eventually;
using test::fresh_image;
using test::RecordingSession;
using test::same_pixels;

Project small_project(int width = 32, int height = 24, int64_t spp = 8) {
    Project project = test::sample_project().project;
    project.render.width = width;
    project.render.height = height;
    project.render.spp = spp;
    return project;
}

// Large enough for a coarse first image.
Project large_project(int64_t spp) { return small_project(256, 256, spp); }

// The same scene under different light.
Project lit_by(Project project, float intensity) {
    const auto [id, light] = project.scene.lights.entries()[0];
    Light brighter = light;
    brighter.intensity = intensity;
    project.scene.lights.set(id, brighter);
    return project;
}

Project with_spp(Project project, int64_t spp) {
    project.render.spp = spp;
    return project;
}

void submit(RenderSession& session, uint64_t revision, const Project& project) { session.submit(revision, project.scene, project.render); }
void submit(RecordingSession& session, uint64_t revision, const Project& project) {
    session->submit(revision, project.scene, project.render);
}

Frame fresh(const Project& project) { return fresh_image(project.scene, project.render, project.render.spp); }

// Revisions of published frames in order, each once.
std::vector<uint64_t> revisions_shown(const RecordingSession& session) {
    std::vector<uint64_t> revisions;
    for (const FramePtr& frame : session.frames())
        if (revisions.empty() || revisions.back() != frame->revision) revisions.push_back(frame->revision);
    return revisions;
}

// Runs an action at the first event that `when` accepts.
auto once(test::EventTest when, std::function<void(RenderSession&)> action) {
    return [when = std::move(when), action = std::move(action), done = false](RenderSession& session, const Event& event) mutable {
        if (done || !when(event)) return;
        done = true;
        action(session);
    };
}
test::EventTest is(uint64_t revision, State state) {
    return [=](const Event& e) { return e.status.revision == revision && e.status.state == state; };
}
// True if a frame of the revision was published.
test::EventTest shows(uint64_t revision) {
    return [=](const Event& e) { return e.frame && e.frame->revision == revision; };
}

TEST(RenderSession, BeginsIdle) {
    RecordingSession session;
    EXPECT_EQ(session->status().state, State::idle);
    EXPECT_EQ(session->latest(), nullptr);
    session.shut_down();
    EXPECT_TRUE(session.events().empty());
}

TEST(RenderSession, ReachesTheImageOfARendererAndCompletes) {
    const Project project = small_project();
    RecordingSession session;
    submit(session, 5, project);
    const Event last = session.wait_for(5, State::complete);
    ASSERT_TRUE(last.frame);
    EXPECT_TRUE(same_pixels(*last.frame, fresh(project)));
    EXPECT_TRUE(last.frame->complete);
    EXPECT_EQ(last.frame->revision, 5u);
    EXPECT_EQ(last.status.progress, 1);
    EXPECT_GT(last.frame->first_image_seconds, 0);
    session.shut_down();
    double progress = 0;
    int64_t samples = 0;
    for (const Event& e : session.events()) {
        EXPECT_GE(e.status.progress, progress);
        EXPECT_EQ(e.status.progress == 1, e.status.state == State::complete);
        progress = e.status.progress;
        if (!e.frame) continue;
        EXPECT_GE(e.frame->samples, samples);
        EXPECT_EQ(e.frame->complete, e.frame->samples == project.render.spp);
        samples = e.frame->samples;
    }
    EXPECT_EQ(session.events().front().status.state, State::updating);
}

// Not every frame's error is estimated; each frame has the latest estimate with its sample count.
TEST(RenderSession, ErrorsStateTheirSampleCount) {
    const Project project = small_project(64, 48, 64);
    RecordingSession session;
    submit(session, 1, project);
    session.wait_for(1, State::complete);
    session.shut_down();
    const std::vector<FramePtr> frames = session.frames();
    int64_t samples = 0;
    for (const FramePtr& f : frames) {
        EXPECT_LE(f->error_samples, f->samples);
        EXPECT_LE(f->error_at, f->seconds);
        EXPECT_GE(f->error_samples, samples) << "estimates are never lost";
        samples = f->error_samples;
    }
    EXPECT_EQ(frames.back()->error_samples, 64) << "the last frame is always estimated";
    EXPECT_EQ(frames.back()->error.relmse, fresh(project).error.relmse);
}

// The first image of an edit does not wait for the pilot, and the rest is as without a window.
TEST(RenderSession, PilotOfPathReuseRunsAfterTheFirstSample) {
    Project project = small_project(64, 48, 8);
    project.render.reuse = reuse_auto;
    const auto materials = project.scene.materials; // a copy, as the loop changes the scene's
    for (const auto& [id, material] : materials.entries()) {
        Material diffuse = material;
        diffuse.specular = 0;
        project.scene.materials.set(id, diffuse);
    }
    RecordingSession session;
    submit(session, 1, project);
    session.wait_for(1, State::complete);
    session.shut_down();
    const auto measured = [](const Frame& frame) {
        return std::ranges::any_of(*frame.feature_report, [](const FeatureUse& use) { return use.pilot.has_value(); });
    };
    const std::vector<FramePtr> frames = session.frames();
    EXPECT_EQ(frames.front()->samples, 1);
    EXPECT_FALSE(measured(*frames.front()));
    EXPECT_TRUE(measured(*frames.back()));
    EXPECT_TRUE(same_pixels(*frames.back(), fresh(project)));
}

TEST(RenderSession, CoarseImageFirstFullResolutionNext) {
    const Project project = large_project(2);
    RecordingSession session;
    submit(session, 1, project);
    session.wait_for(1, State::complete);
    session.shut_down();
    const std::vector<FramePtr> frames = session.frames();
    ASSERT_GE(frames.size(), 2u);
    EXPECT_GT(frames[0]->divider, 1);
    EXPECT_EQ(frames[0]->width, project.render.width / frames[0]->divider);
    for (size_t i = 1; i < frames.size(); ++i) EXPECT_LE(frames[i]->divider, frames[i - 1]->divider);
    EXPECT_TRUE(same_pixels(*frames.back(), fresh(project)));
}

TEST(RenderSession, LatestOfTenThousandWins) {
    RecordingSession session;
    const Project project = small_project(16, 12, 4);
    Project last;
    for (uint64_t revision = 1; revision <= 10000; ++revision) submit(session, revision, last = lit_by(project, float(revision)));
    const Event done = session.wait_for(10000, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(last)));
    session.shut_down();
    const std::vector<uint64_t> shown = revisions_shown(session);
    EXPECT_TRUE(std::is_sorted(shown.begin(), shown.end())) << "never back to an older revision";
    for (const Event& e : session.events()) EXPECT_EQ(e.status.progress == 1, e.status.state == State::complete) << "of any revision";
}

TEST(RenderSession, ManyThreadsMaySubmitAndRead) {
    const Project project = small_project(16, 12, 2);
    RecordingSession session;
    std::vector<std::thread> callers;
    for (uint64_t t = 0; t < 3; ++t)
        callers.emplace_back([&, t] {
            for (uint64_t i = 0; i < 200; ++i) {
                submit(session, 1 + 200 * t + i, lit_by(project, float(1 + i)));
                session->pause(i % 7 == 0);
                (void)session->status();
                if (const FramePtr frame = session->latest()) { EXPECT_EQ(checksum(*frame), checksum(*frame)); }
            }
        });
    for (std::thread& caller : callers) caller.join();
    session->pause(false);
    const Project last = lit_by(project, 77);
    submit(session, 1000, last);
    const Event done = session.wait_for(1000, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(last)));
}

TEST(RenderSession, AnAppliedSubmissionIsShownEvenIfTheNextIsPending) {
    // Each revision is submitted as soon as the previous one is being applied, as in a drag faster than the renderer.
    const Project project = large_project(2);
    constexpr uint64_t last = 6;
    uint64_t submitted = 1;
    RecordingSession session(2, [&](RenderSession& s, const Event& e) {
        if (e.status.state == State::updating && e.status.revision == submitted && submitted < last) {
            ++submitted;
            submit(s, submitted, lit_by(project, float(submitted)));
        }
    });
    submit(session, 1, project);
    const Event done = session.wait_for(last, State::complete);
    session.shut_down();
    EXPECT_EQ(revisions_shown(session), (std::vector<uint64_t>{1, 2, 3, 4, 5, 6}));
    std::map<uint64_t, int> images;
    for (const FramePtr& frame : session.frames()) ++images[frame->revision];
    for (uint64_t revision = 1; revision < last; ++revision) { EXPECT_EQ(images[revision], 1) << "only the coarse image"; }
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(lit_by(project, last))));
}

TEST(RenderSession, PausedItShowsTheFirstImageAndWaits) {
    const Project project = small_project(32, 24, 16);
    RecordingSession session;
    session->pause(true);
    submit(session, 1, project);
    const Event first = session.wait_for(1, State::paused);
    ASSERT_TRUE(first.frame);
    EXPECT_EQ(first.frame->revision, 1u);
    EXPECT_EQ(first.frame->samples, 1);
    EXPECT_FALSE(first.frame->complete);

    const Project edited = lit_by(project, 5);
    submit(session, 2, edited);
    EXPECT_EQ(session.wait_for(2, State::updating).status.progress, 0);
    const Event second = session.wait_for(2, State::paused);
    ASSERT_TRUE(second.frame);
    EXPECT_EQ(second.frame->revision, 2u);
    EXPECT_EQ(second.frame->samples, 1);
    const size_t before = session.events().size();

    session->pause(false);
    const Event done = session.wait_for(2, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(edited)));
    EXPECT_EQ(session.events()[before].status.state, State::rendering) << "nothing is announced before it resumes";
}

TEST(RenderSession, PausingKeepsTheSamples) {
    const Project project = small_project(32, 24, 64);
    RecordingSession session(
        2, once([](const Event& e) { return e.frame && e.frame->samples >= 4; }, [](RenderSession& s) { s.pause(true); }));
    submit(session, 1, project);
    const Event paused = session.wait_for(1, State::paused);
    ASSERT_TRUE(paused.frame);
    EXPECT_LT(paused.frame->samples, 64);
    session->pause(false);
    const Event done = session.wait_for(1, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(project)));
}

TEST(RenderSession, CanBeDestroyedDuringAPass) {
    // Rendering is endless: the destructor returns because it interrupts a pass.
    const Project project = small_project(2048, 2048, 0);
    for (int i = 0; i < 3; ++i) {
        RecordingSession session;
        submit(session, 1, project);
        session.wait_for(shows(1));
        session.shut_down();
        EXPECT_FALSE(session.frames().back()->complete);
    }
}

TEST(RenderSession, CanBeDestroyedBeforeAndDuringTheFirstImage) {
    // Rendering is endless here as well.
    const Project project = small_project(2048, 2048, 0);
    for (int i = 0; i < 20; ++i) {
        RecordingSession session;
        submit(session, 1, project);
        if (i % 2) session.wait_for(is(1, State::updating));
        session.shut_down();
        for (const Event& e : session.events()) {
            EXPECT_EQ(e.status.revision, 1u);
            EXPECT_NE(e.status.state, State::complete);
        }
    }
}

TEST(RenderSession, MoreSamplesContinueTheImage) {
    const Project project = small_project(32, 24, 4);
    RecordingSession session;
    submit(session, 1, project);
    session.wait_for(1, State::complete);
    submit(session, 2, with_spp(project, 16));
    const Event done = session.wait_for(2, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(with_spp(project, 16))));
    session.shut_down();
    int64_t samples = 0;
    for (const FramePtr& frame : session.frames()) {
        EXPECT_GE(frame->samples, samples);
        samples = frame->samples;
    }
}

TEST(RenderSession, StopRulesMayChangeInTheMiddle) {
    const Project project = small_project(32, 24, 0);
    RecordingSession session(2, once([](const Event& e) { return e.frame && e.frame->samples >= 4; },
                                     [&](RenderSession& s) { submit(s, 2, with_spp(project, 50)); }));
    submit(session, 1, project);
    const Event done = session.wait_for(2, State::complete);
    ASSERT_TRUE(done.frame);
    // Rendering may already be further: then that frame is shown.
    EXPECT_GE(done.frame->samples, 50);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(with_spp(project, done.frame->samples))));
}

TEST(RenderSession, AdaptiveSamplingShowsTheImageThatARendererMakes) {
    Project project = small_project(48, 32, 48);
    project.render.adaptive = true;
    RecordingSession session;
    submit(session, 1, project);
    const Event done = session.wait_for(1, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_EQ(done.frame->samples, 48);
    EXPECT_EQ(done.frame->pixel_samples.size(), size_t(48 * 32));
    EXPECT_TRUE(same_pixels(*done.frame, fresh(project)));
    // More samples continue from there.
    submit(session, 2, with_spp(project, 80));
    const Event more = session.wait_for(2, State::complete);
    ASSERT_TRUE(more.frame);
    EXPECT_TRUE(same_pixels(*more.frame, fresh(with_spp(project, 80))));
}

TEST(RenderSession, FewerSamplesThanRenderedCompleteAtOnce) {
    const Project project = small_project(32, 24, 16);
    RecordingSession session;
    submit(session, 1, project);
    session.wait_for(1, State::complete);
    submit(session, 2, with_spp(project, 8));
    const Event done = session.wait_for(2, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_EQ(done.frame->revision, 2u) << "the frame states its revision";
    EXPECT_TRUE(done.frame->complete);
    EXPECT_TRUE(same_pixels(*done.frame, fresh(project)));
}

TEST(RenderSession, ARenameDoesNotRestart) {
    const Project project = small_project(32, 24, 8);
    RecordingSession session;
    submit(session, 1, project);
    session.wait_for(1, State::complete);
    Project renamed = project;
    auto [id, node] = renamed.scene.nodes.entries()[0];
    node.name = "Renamed";
    renamed.scene.nodes.set(id, node);
    submit(session, 2, renamed);
    session.wait_for(2, State::complete);
    session.shut_down();
    EXPECT_EQ(session.frames().back()->samples, 8);
    for (const Event& e : session.events()) EXPECT_FALSE(e.status.revision == 2 && e.status.state != State::complete);
}

TEST(RenderSession, OnlyChangesAreSubmitted) {
    Project project = small_project(32, 24, 8);
    RecordingSession session;
    const auto submit_changes = [&](uint64_t revision) { return session->submit_changes(revision, project.scene, project.render); };
    const SubmissionPtr first = submit_changes(1);
    ASSERT_TRUE(first);
    auto [id, node] = project.scene.nodes.entries()[0];
    node.name = "Renamed";
    project.scene.nodes.set(id, node);
    for (int frame = 0; frame < 2; ++frame) EXPECT_FALSE(submit_changes(2)) << "a name";
    project = lit_by(project, 3);
    const SubmissionPtr second = submit_changes(2);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->changes.lights.size(), 1u);
    EXPECT_TRUE(second->changes.structure.empty() && second->changes.transforms.empty());
    EXPECT_EQ(second->image, first->image + 1);
    EXPECT_FALSE(submit_changes(3));
    session.wait_for(2, State::complete);
    EXPECT_TRUE(same_pixels(*session->latest(), fresh(project)));
}

TEST(RenderSession, SleepsWhenComplete) {
    const Project project = small_project();
    RecordingSession session;
    submit(session, 1, project);
    session.wait_for(1, State::complete);
    for (int i = 0; i < 100; ++i) session->pause(i % 2 == 0); // wakes it unnecessarily
    submit(session, 2, project);
    session.wait_for(2, State::complete);
    session.shut_down();
    const std::vector<Event> events = session.events();
    const auto complete = std::find_if(events.begin(), events.end(), is(1, State::complete));
    ASSERT_NE(complete, events.end());
    EXPECT_EQ((complete + 1)->status.revision, 2u) << "no announcement between completion and the next submission";
    EXPECT_EQ(events.end() - complete, 2);
}

TEST(RenderSession, ReportsFailuresAndRecovers) {
    const Project project = small_project();
    Project impossible = project;
    impossible.render.width = impossible.render.height = 65536;
    RecordingSession session;
    submit(session, 1, impossible);
    const Event failed = session.wait_for(1, State::failed);
    EXPECT_FALSE(failed.status.message.empty());
    EXPECT_EQ(failed.frame, nullptr);
    submit(session, 2, project);
    const Event done = session.wait_for(2, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(done.status.message.empty());
    EXPECT_TRUE(same_pixels(*done.frame, fresh(project)));

    submit(session, 3, impossible);
    EXPECT_EQ(session.wait_for(3, State::updating).status.progress, 0) << "the completed image is outdated";
    EXPECT_EQ(session.wait_for(3, State::failed).frame, done.frame) << "the last image stays";
    submit(session, 4, impossible);
    session.wait_for(4, State::failed);
    submit(session, 5, project);
    EXPECT_TRUE(same_pixels(*session.wait_for(5, State::complete).frame, *done.frame));
}

TEST(RenderSession, PublishedFramesNeverChange) {
    const Project project = small_project(32, 24, 32);
    constexpr uint64_t last = 8;
    std::map<FramePtr, uint64_t> held; // every second frame: the others return to the pool
    bool hold = false;
    std::atomic<bool> done{false};
    RenderSession* watched = nullptr;
    {
        RenderSession session({2, false, true}, [&] {
            const FramePtr frame = watched->latest();
            if (frame && !held.contains(frame) && (hold = !hold)) held.emplace(frame, checksum(*frame));
            const SessionStatus status = watched->status();
            if (status.state != State::complete) return;
            if (status.revision < last)
                submit(*watched, status.revision + 1, lit_by(project, float(status.revision)));
            else
                done = true;
        });
        watched = &session;
        submit(session, 1, project);
        EXPECT_TRUE(eventually([&] { return done.load(); })) << "the last revision is not completed";
    }
    EXPECT_GE(held.size(), last);
    for (const auto& [frame, sum] : held) EXPECT_EQ(checksum(*frame), sum);
}

TEST(RenderSession, FramesOutliveTheSession) {
    const Project project = small_project();
    FramePtr frame;
    {
        RecordingSession session;
        submit(session, 1, project);
        frame = session.wait_for(1, State::complete).frame;
    }
    ASSERT_TRUE(frame);
    EXPECT_TRUE(same_pixels(*frame, fresh(project)));
}

TEST(RenderSession, ThreadsDoNotChangeABit) {
    Project project = test::rich_project();
    project.render.spp = 5;
    for (const unsigned threads : {1u, 2u, 5u}) {
        RecordingSession session(threads);
        submit(session, 1, project);
        const Event done = session.wait_for(1, State::complete);
        ASSERT_TRUE(done.frame);
        EXPECT_TRUE(same_pixels(*done.frame, fresh(project))) << threads << " threads";
    }
}

TEST(RenderSession, TheResolutionScaleMultipliesTheSize) {
    Project project = small_project(40, 20, 2);
    project.render.resolution_scale = 0.5f;
    RecordingSession session;
    submit(session, 1, project);
    const Event done = session.wait_for(1, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_EQ(done.frame->width, 20);
    EXPECT_EQ(done.frame->height, 10);
}

} // namespace
} // namespace blush::TEST_FILE
