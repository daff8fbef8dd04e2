// The pause gate, and a session that yields to the UI.
#include "render/session/pause_gate.h"

#include "tests/render/session/recording_session.h"
#include "tests/support/eventually.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace blush::TEST_FILE {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using State = SessionStatus::State;
using test::Event;
using test::eventually;
using test::HangGuard;
using test::RecordingSession;

const auto at_leisure = [] { return false; };

TEST(PauseGate, BlocksUntilItOpens) {
    const HangGuard guard("waiting at an open gate");
    PauseGate gate;
    gate.wait_while_closed(at_leisure);
    gate.close();
    std::atomic<bool> opened{false}, early{false};
    std::thread worker([&] {
        gate.wait_while_closed(at_leisure);
        early = !opened;
    });
    EXPECT_TRUE(eventually([&] { return gate.has_waiting_threads(); })) << "the thread does not wait";
    opened = true;
    gate.open();
    worker.join();
    EXPECT_FALSE(early);
    EXPECT_FALSE(gate.has_waiting_threads());
}

TEST(PauseGate, LetsInterruptedThreadsPass) {
    const HangGuard guard("waiting of an interrupted thread");
    PauseGate gate;
    gate.close();
    gate.wait_while_closed([] { return true; });
    std::atomic<bool> interrupted{false};
    std::thread worker([&] { gate.wait_while_closed([&] { return interrupted.load(); }); });
    EXPECT_TRUE(eventually([&] { return gate.has_waiting_threads(); })) << "the thread does not wait";
    interrupted = true;
    gate.notify();
    worker.join();
    EXPECT_FALSE(gate.has_waiting_threads());
    EXPECT_TRUE(gate.is_closed());
}

TEST(PauseGate, MeasuresItsClosedTime) {
    PauseGate gate;
    EXPECT_EQ(gate.closed_seconds(), 0);
    gate.close();
    gate.close();
    std::this_thread::sleep_for(20ms);
    EXPECT_GE(gate.closed_seconds(), 0.02);
    gate.open();
    gate.open();
    const double close = gate.closed_seconds();
    std::this_thread::sleep_for(5ms);
    EXPECT_EQ(gate.closed_seconds(), close);
}

Project project_of(int width, int height, int64_t spp) {
    Project project = test::sample_project().project;
    project.render.width = width;
    project.render.height = height;
    project.render.spp = spp;
    return project;
}

// Yields at the first frame with so many samples.
auto yields_after(int64_t samples) {
    return [samples, done = false](RenderSession& session, const Event& event) mutable {
        if (done || !event.frame || event.frame->samples < samples) return;
        done = true;
        session.yield_to_ui(true);
    };
}

TEST(YieldToUi, ContinuesFromTheSameSamples) {
    Project project = project_of(32, 24, 64);
    RecordingSession session(2, yields_after(4));
    session->submit(1, project.scene, project.render);
    const Event yielding = session.wait_for(1, State::yielding);
    ASSERT_TRUE(yielding.frame);
    EXPECT_LT(yielding.frame->samples, 64);
    // More samples of the same image wait as well.
    project.render.spp = 80;
    EXPECT_TRUE(session->submit(2, project.scene, project.render)->continues_image);
    const size_t before = session.events().size();
    EXPECT_EQ(session->status().state, State::yielding);
    session->yield_to_ui(false);
    const Event done = session.wait_for(2, State::complete);
    ASSERT_TRUE(done.frame);
    EXPECT_EQ(done.frame->samples, 80);
    EXPECT_EQ(done.frame->rgba, test::fresh_image(project.scene, project.render, 80).rgba);
    EXPECT_NE(session.events()[before].status.state, State::yielding) << "nothing is announced before it resumes";
}

TEST(YieldToUi, DoesNotDelayAnotherImage) {
    Project project = project_of(32, 24, 8);
    RecordingSession session(2, yields_after(1));
    session->submit(1, project.scene, project.render);
    session.wait_for(1, State::yielding);
    project.scene.view.position.x += 0.1f;
    session->submit(2, project.scene, project.render);
    const Event other = session.wait_for([](const Event& e) { return e.frame && e.frame->revision == 2; });
    EXPECT_TRUE(other.frame) << "its first image is rendered nevertheless";
}

TEST(YieldToUi, StillSavesFilms) {
    const Project project = project_of(32, 24, 64);
    RecordingSession session(2, yields_after(4));
    session->submit(1, project.scene, project.render);
    session.wait_for(1, State::yielding);
    session->request_film(1);
    std::optional<RequestedFilm> kept;
    session.wait_for([&](const Event&) {
        if (!kept) kept = session->take_requested_film();
        return kept.has_value();
    });
    ASSERT_TRUE(kept);
    EXPECT_TRUE(kept->film) << kept->why_none;
}

TEST(YieldToUi, DoesNotCountAsRendering) {
    const Project project = project_of(480, 360, 12);
    RecordingSession session;
    const auto begin = Clock::now();
    session->submit(1, project.scene, project.render);
    session.wait_for([](const Event& e) { return e.frame && e.frame->divider == 1; });
    session->yield_to_ui(true);
    const auto close = Clock::now();
    std::this_thread::sleep_for(1500ms);
    const std::chrono::duration<double> yielding = Clock::now() - close;
    session->yield_to_ui(false);
    const Event done = session.wait_for(1, State::complete);
    const std::chrono::duration<double> whole = Clock::now() - begin;
    ASSERT_TRUE(done.frame);
    EXPECT_LT(done.frame->seconds, whole.count() - yielding.count());
}

TEST(YieldToUi, CanBeDestroyed) {
    const Project project = project_of(480, 360, 1 << 20);
    RecordingSession session;
    session->submit(1, project.scene, project.render);
    session.wait_for([](const Event& e) { return e.frame && e.frame->divider == 1; });
    session->yield_to_ui(true);
    EXPECT_TRUE(eventually([&] { return session->status().state == State::yielding; })) << "it does not yield";
    session.shut_down();
    EXPECT_FALSE(session.frames().back()->complete) << "it is destroyed in the middle of its image";
}

} // namespace
} // namespace blush::TEST_FILE
