// Shortcuts, gestures, toasts, statistics and background jobs.
#include "tests/support/eventually.h"
#include "tests/support/process.h"
#include "ui/jobs/background_job.h"
#include "ui/window/automation.h"
#include "ui/window/frame_budget.h"
#include "ui/window/frame_stats.h"
#include "ui/window/gestures.h"
#include "ui/window/probe.h"
#include "ui/window/shortcuts.h"
#include "ui/window/toasts.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace blush::TEST_FILE {
namespace {

using namespace std::chrono_literals;

TEST(Probe, FindsTheWatchedWidgetWithoutAFile) {
    Probe probe;
    probe.watch("Lesson/Next");
    probe.begin_frame();
    probe.record("Lesson/Back", {1, 2, 3, 4});
    EXPECT_FALSE(probe.watched_region());
    probe.record("Lesson/Next", {5, 6, 7, 8});
    EXPECT_EQ(probe.watched_region(), (Region{5, 6, 7, 8}));
    probe.begin_frame();
    EXPECT_FALSE(probe.watched_region()) << "it was not shown in this frame";
    probe.watch("");
    probe.record("", {1, 2, 3, 4});
    EXPECT_FALSE(probe.watched_region());
}

TEST(Shortcuts, KeysAreUnique) {
    for (const Shortcut& a : shortcuts()) {
        for (const KeyPress& press : {a.press, a.also}) {
            if (press.key == key::none) continue;
            EXPECT_EQ(std::ranges::count(shortcuts(), press, &Shortcut::press) + std::ranges::count(shortcuts(), press, &Shortcut::also), 1)
                << to_string(press);
        }
    }
}

TEST(Shortcuts, EveryCommandIsListedOnce) {
    for (int c = 0; c <= int(last_command); ++c) EXPECT_EQ(std::ranges::count(shortcuts(), Command(c), &Shortcut::command), 1) << c;
}

TEST(Shortcuts, AreFoundByTheirKeysOnly) {
    const Shortcut* undo = find_shortcut({'Z', true, false, false});
    ASSERT_TRUE(undo);
    EXPECT_EQ(undo->command, Command::undo);
    EXPECT_EQ(find_shortcut({'Z', true, true, false})->command, Command::redo);
    EXPECT_EQ(find_shortcut({'Y', true, false, false})->command, Command::redo);
    EXPECT_EQ(find_shortcut({'S', true, false, false})->command, Command::save_scene);
    EXPECT_EQ(find_shortcut({'S', true, true, false})->command, Command::save_scene_as);
    EXPECT_EQ(find_shortcut({key::enter, true, false, false})->command, Command::snapshot_exr);
    EXPECT_EQ(find_shortcut({'Y', false, false, false}), nullptr);
    EXPECT_EQ(find_shortcut({}), nullptr);
}

TEST(Shortcuts, AreFormatted) {
    EXPECT_EQ(to_string({'Z', true, true, false}), "Ctrl+Shift+Z");
    EXPECT_EQ(to_string({key::f1, false, false, false}), "F1");
    EXPECT_EQ(to_string({key::remove, false, false, false}), "Del");
    EXPECT_EQ(to_string(KeyPress{}), "");
    EXPECT_EQ(keys_of(shortcut(Command::snapshot_exr)), "F12 or Ctrl+Enter");
    EXPECT_EQ(keys_of(shortcut(Command::full_screen)), "Shift+F11");
    EXPECT_EQ(keys_of(shortcut(Command::presentation)), "F11");
}

// As Fields does for a widget that is grabbed, dragged and released.
TEST(Gestures, OneDragIsOneUndoStep) {
    Document document;
    GestureTracker gestures;
    const auto drag = [&](float from, float to) {
        gestures.begin();
        for (int i = 0; i <= 4; ++i) {
            ViewSettings v;
            v.exposure_ev = from + (to - from) * float(i) / 4;
            ASSERT_TRUE(document.apply(SetView{v}, gestures.current()));
        }
        gestures.end();
    };
    drag(0, 1);
    drag(1, 3);
    EXPECT_EQ(gestures.current(), no_gesture);
    EXPECT_EQ(document.undo_labels().size(), 2u);
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.project().view.exposure_ev, 1);
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.project().view.exposure_ev, 0);
    EXPECT_EQ(document.redo_labels().size(), 2u);
}

TEST(Toasts, ExpireAndFailuresLast) {
    Toasts toasts;
    toasts.note("saved");
    toasts.fail("broken");
    const auto start = toasts.all().front().since;
    toasts.remove_expired(start + 6s);
    ASSERT_EQ(toasts.all().size(), 1u);
    EXPECT_EQ(toasts.all()[0].text, "broken");
    toasts.remove_expired(start + 60s);
    EXPECT_TRUE(toasts.all().empty());
}

TEST(Toasts, DuplicatesReplaceAndTheListIsLimited) {
    Toasts toasts;
    toasts.note("a");
    toasts.note("b");
    toasts.note("a");
    ASSERT_EQ(toasts.all().size(), 2u);
    EXPECT_EQ(toasts.all()[1].text, "a");
    for (int i = 0; i < 50; ++i) toasts.note(std::to_string(i));
    EXPECT_LE(toasts.all().size(), 5u);
}

TEST(FrameStats, PercentilesByNearestRank) {
    std::vector<double> values;
    for (int i = 1; i <= 100; ++i) values.push_back(101 - i);
    EXPECT_EQ(percentile(values, 0.5), 50);
    EXPECT_EQ(percentile(values, 0.95), 95);
    EXPECT_EQ(percentile(values, 1), 100);
    EXPECT_EQ(percentile({3}, 0.5), 3);
    EXPECT_EQ(percentile({}, 0.5), 0);
}

TEST(FrameBudget, ImageGetsTheRemainingTime) {
    FrameBudget pace;
    const FrameBudget::TimePoint start{};
    pace.begin(start);
    EXPECT_NEAR(pace.left(20, start + 3ms), 17, 1e-9) << "the rest of the frame is not measured yet";
    pace.begin_image(start + 3ms);
    pace.end_image(start + 5ms);
    const FrameTimes times = pace.end(start + 17ms, true);
    EXPECT_NEAR(times.before_image, 3, 1e-9);
    EXPECT_NEAR(times.image, 2, 1e-9);
    EXPECT_NEAR(times.after_image, 12, 1e-9);
    pace.begin(start + 100ms);
    EXPECT_NEAR(pace.left(20, start + 101ms), 7, 1e-9);
    EXPECT_GT(pace.left(20, start + 130ms), 0) << "a late frame still draws its image";
    pace.begin_image(start + 101ms);
    pace.end_image(start + 102ms);
    pace.end(start + 102ms, false);
    pace.begin(start + 110ms);
    EXPECT_NEAR(pace.left(20, start + 111ms), 7, 1e-9) << "a frame that is not drawn says nothing about drawing";
    pace.begin_image(start + 111ms);
    pace.end_image(start + 112ms);
    pace.end(start + 113ms, true);
    pace.begin(start + 200ms);
    const double later = pace.left(20, start + 200ms);
    EXPECT_GT(later, 8) << "one slow frame is forgotten";
    EXPECT_LT(later, 19) << "but not at once";
}

TEST(FrameStats, CountsEditsShownInTheSameFrame) {
    FrameStats stats;
    const FrameStats::Clock::time_point start{};
    stats.submitted(1, start);
    stats.shown(1, start + 10ms);
    stats.end_frame();
    stats.submitted(2, start + 20ms);
    stats.end_frame();
    stats.shown(2, start + 40ms);
    stats.end_frame();
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "stats.json";
    ASSERT_TRUE(stats.write(file));
    std::ifstream in(file);
    const auto json = nlohmann::json::parse(in);
    EXPECT_EQ(json["edits"], 2);
    EXPECT_EQ(json["edits_at_once"], 1);
}

TEST(FrameStats, ListsLateFramesWithTheirTimes) {
    FrameStats stats;
    const FrameStats::Clock::time_point start{};
    stats.add_frame({5, 6, 7}, start + 20ms);
    stats.add_frame({10, 20, 9}, start + 520ms);
    stats.add_frame({1, 30, 3}, start + 600ms);
    stats.add_unchanged_frame();
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "stats.json";
    ASSERT_TRUE(stats.write(file));
    std::ifstream in(file);
    const auto json = nlohmann::json::parse(in);
    EXPECT_EQ(json["frames"], 3);
    EXPECT_EQ(json["unchanged_frames"], 1);
    EXPECT_EQ(json["late"], 2);
    EXPECT_EQ(json["max_ms"], 39.0);
    ASSERT_EQ(json["late_frames"].size(), 2u);
    EXPECT_EQ(json["late_frames"][0]["at_s"], 0.5);
    EXPECT_EQ(json["late_frames"][0]["before_image_ms"], 10.0);
    EXPECT_EQ(json["late_frames"][1]["image_ms"], 30.0);
    EXPECT_EQ(json["late_frames"][1]["after_image_ms"], 3.0);
}

TEST(FrameStats, ViewChangesCountWhenDisplayed) {
    FrameStats stats;
    const FrameStats::Clock::time_point start{};
    stats.view_change_shown(start);
    EXPECT_TRUE(stats.looks().empty()) << "no view change was requested";
    stats.view_changed(start + 10ms);
    stats.view_change_shown(start + 42ms);
    stats.view_change_shown(start + 99ms);
    EXPECT_EQ(stats.looks(), std::vector<double>{32});
}

TEST(FrameStats, ImageAnswersItsSubmitAndClearsOlderOnes) {
    FrameStats stats;
    const FrameStats::Clock::time_point start{};
    stats.submitted(1, start);
    stats.submitted(2, start + 10ms);
    stats.submitted(3, start + 20ms);
    stats.shown(2, start + 40ms);
    stats.shown(2, start + 90ms); // more samples of the same revision are no answer
    stats.shown(3, start + 100ms);
    ASSERT_EQ(stats.latencies().size(), 2u);
    EXPECT_NEAR(stats.latencies()[0], 30, 1e-9);
    EXPECT_NEAR(stats.latencies()[1], 80, 1e-9);
    ASSERT_EQ(stats.answers().size(), 3u) << "the superseded one is answered as well";
    EXPECT_NEAR(stats.answers()[0], 40, 1e-9);
    EXPECT_NEAR(stats.answers()[1], 30, 1e-9);
    EXPECT_NEAR(stats.answers()[2], 80, 1e-9);
}

TEST(BackgroundJob, ReturnsItsResultOnceAndWakes) {
    std::atomic<bool> woken = false;
    BackgroundJob<int> job(
        "work",
        [](JobProgress& p) {
            p.report(0.5, "half");
            return 42;
        },
        [&] { woken = true; });
    EXPECT_TRUE(test::eventually([&] { return woken.load(); })) << "the job does not wake the window";
    EXPECT_EQ(job.take(), 42);
    EXPECT_FALSE(job.take());
    EXPECT_EQ(job.progress().read(), (std::pair<double, std::string>(0.5, "half")));
}

TEST(BackgroundJob, DestructionCancelsAndWaits) {
    std::atomic<bool> ended = false;
    {
        const BackgroundJob<int> job(
            "endless",
            [&](JobProgress& p) {
                EXPECT_TRUE(test::eventually([&] { return p.cancel.load(); })) << "the job is not cancelled";
                ended = true;
                return 0;
            },
            [] {});
    }
    EXPECT_TRUE(ended);
}

TEST(Automation, RejectsPartiallyValidSizes) {
    int w = 1, h = 2;
    EXPECT_TRUE(parse_size("800x600", w, h));
    EXPECT_EQ(w, 800);
    EXPECT_EQ(h, 600);
    for (const char* text : {"", "800", "800x", "x600", "800x600x", "-5x5", "0x10", "99999999999x1", "axb"})
        EXPECT_FALSE(parse_size(text, w, h)) << text;
    EXPECT_EQ(w, 800);
}

} // namespace
} // namespace blush::TEST_FILE
