// Temporarily requested film planes: requesting them restarts the image, releasing them does not.
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

constexpr PlaneSet bounces{.bounces = 4};

Project small_project() {
    Project project = test::sample_project().project;
    project.render.width = 32;
    project.render.height = 24;
    project.render.spp = 8;
    return project;
}

TEST(SessionPlanes, RestartTheImageWhenAddedButNotWhenRemoved) {
    const Project p = small_project();
    RecordingSession session;
    session->submit(1, p.scene, p.render);
    const FramePtr plain = session.wait_for(1, State::complete).frame;
    ASSERT_TRUE(plain);
    EXPECT_TRUE(plain->bounces.empty());

    session->submit(2, p.scene, p.render, bounces);
    const FramePtr with = session.wait_for(2, State::complete).frame;
    ASSERT_TRUE(with);
    EXPECT_EQ(with->bounces.size(), 4u);
    EXPECT_EQ(with->rgba, plain->rgba) << "the image is the same";
    EXPECT_FALSE(with->albedo.empty()) << "first-hit planes are kept";

    session->submit(3, p.scene, p.render);
    const FramePtr without = session.wait_for([](const Event& e) { return e.frame && e.frame->revision == 3; }).frame;
    ASSERT_TRUE(without);
    EXPECT_TRUE(without->bounces.empty());
    EXPECT_EQ(without->samples, 8) << "not rendered again";
    EXPECT_EQ(without->rgba, plain->rgba);
}

TEST(SessionPlanes, SurviveEdits) {
    Project p = small_project();
    RecordingSession session;
    session->submit(1, p.scene, p.render, bounces);
    session.wait_for(1, State::complete);
    p.render.seed = 5;
    session->submit(2, p.scene, p.render, bounces);
    EXPECT_EQ(session.wait_for(2, State::complete).frame->bounces.size(), 4u);
}

TEST(PlaneSet, CoversItsSubsets) {
    const PlaneSet all{true, true, true, true, 6, true, false, true};
    EXPECT_TRUE(all.covers(PlaneSet{}));
    EXPECT_TRUE(all.covers(all));
    EXPECT_TRUE(all.covers({.depth = true}));
    EXPECT_FALSE(all.covers({.bounces = 4})) << "another number of bounce planes differs";
    EXPECT_FALSE(PlaneSet{}.covers({.roulette = true}));
    EXPECT_FALSE(PlaneSet{}.covers({.bounces = 4}));
    EXPECT_FALSE(PlaneSet{}.covers({.strategies = true}));
}

} // namespace
} // namespace blush::TEST_FILE
