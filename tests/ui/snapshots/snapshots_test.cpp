// Snapshots in the window: list, comparison, thumbnails, differences and panels.
#include "ui/snapshots/snapshots_view.h"

#include "tests/support/sample_project.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/difference.h"
#include "ui/snapshots/snapshot_memory.h"
#include "ui/snapshots/snapshot_strip.h"

#include <cmath>

namespace blush::TEST_FILE {
namespace {

using Mode = Comparison::Mode;

FramePtr plain_frame(int width, int height, float value) {
    auto frame = std::make_shared<Frame>();
    frame->width = width;
    frame->height = height;
    frame->samples = 16;
    frame->rgba.assign(size_t(width) * size_t(height) * 4, value);
    return frame;
}

Snapshot snapshot(float value, int width = 32, int height = 20) {
    Snapshot s;
    s.images.frame = plain_frame(width, height, value);
    s.thumbnail = thumbnail_of(*s.images.frame);
    s.time = "12:34";
    return s;
}

TEST(Snapshots, AreNumberedAndNeverTheLiveImage) {
    SnapshotsView v;
    const uint64_t first = v.add(snapshot(1)), second = v.add(snapshot(2));
    EXPECT_NE(first, live_image);
    EXPECT_NE(first, second);
    EXPECT_EQ(v.find(second)->name, "Snapshot 2");
    v.remove(first);
    EXPECT_FALSE(v.find(first));
    EXPECT_NE(v.add(snapshot(3)), first) << "ids are not reused";
    EXPECT_EQ(v.find(second)->figures(), "16 spp, 12:34");
}

TEST(Snapshots, TheNewestIsComparedWithTheLiveImage) {
    SnapshotsView v;
    EXPECT_FALSE(v.toggle(Mode::wipe)) << "there is nothing to compare";
    v.add(snapshot(1));
    const uint64_t newest = v.add(snapshot(2));
    EXPECT_TRUE(v.toggle(Mode::wipe));
    EXPECT_EQ(v.compare.mode, Mode::wipe);
    EXPECT_EQ(v.compare.a, newest);
    EXPECT_EQ(v.compare.b, live_image);
    EXPECT_TRUE(v.toggle(Mode::wipe));
    EXPECT_EQ(v.compare.mode, Mode::off);
    EXPECT_TRUE(v.toggle(Mode::flicker));
    EXPECT_FALSE(v.compare.shows_b);
    EXPECT_TRUE(v.toggle(Mode::flicker));
    EXPECT_TRUE(v.compare.shows_b) << "the key toggles";
    v.remove(newest);
    EXPECT_EQ(v.compare.mode, Mode::off) << "the compared snapshot was deleted";
}

TEST(Snapshots, LastDeletedOneCanBeRestored) {
    SnapshotsView v;
    EXPECT_FALSE(v.can_put_back());
    const uint64_t first = v.add(snapshot(1)), second = v.add(snapshot(2));
    v.remove(first);
    ASSERT_TRUE(v.can_put_back());
    v.put_back();
    EXPECT_FALSE(v.can_put_back());
    ASSERT_EQ(v.list.size(), 2u);
    EXPECT_EQ(v.list[0]->id, first);
    EXPECT_EQ(v.list[1]->id, second);
}

TEST(Snapshots, NewerStatesOfAnImageTakeItsPlace) {
    SnapshotsView v;
    const uint64_t first = v.add(snapshot(1)), second = v.add(snapshot(2)), third = v.add(snapshot(3));
    v.compare = {.mode = Mode::wipe, .a = first, .b = second};
    v.details = first;
    v.remove(third);
    const uint64_t newer = v.add(snapshot(4));
    v.replace(first, newer);
    ASSERT_EQ(v.list.size(), 2u);
    EXPECT_EQ(v.list[0]->id, newer);
    EXPECT_EQ(v.list[1]->id, second);
    EXPECT_EQ(v.compare.a, newer);
    EXPECT_EQ(v.compare.b, second);
    EXPECT_EQ(v.details, newer);
    v.replace(first, second);
    EXPECT_EQ(v.list.size(), 2u) << "there is no such snapshot any more";
    v.put_back();
    EXPECT_EQ(v.list.size(), 3u) << "it does not take the place of the deleted one";
}

TEST(SnapshotMemory, CountsBytes) {
    Snapshot s = snapshot(1, 10, 10);
    EXPECT_EQ(bytes_of(s), 100 * 4 * sizeof(float));
    auto film = std::make_shared<FilmState>();
    film->planes = {{.name = "even.R", .sums = std::vector<double>(100)}, {.name = "depth", .words = std::vector<uint32_t>(100)}};
    s.film = film;
    auto denoised = std::make_shared<DenoisedImage>();
    denoised->denoised.rgb.resize(300);
    s.images.denoised = denoised;
    s.error.resize(100);
    EXPECT_EQ(bytes_of(s), 100 * (4 * sizeof(float) + sizeof(double) + sizeof(uint32_t) + 3 * sizeof(float) + sizeof(Vec3)));
    const std::string figures = s.figures();
    s.unload();
    EXPECT_EQ(bytes_of(s), 0u);
    EXPECT_EQ(s.figures(), figures) << "unloaded snapshots keep their figures";
}

TEST(SnapshotMemory, UnloadsLeastRecentlyUsedFirst) {
    SnapshotsView v;
    for (int i = 0; i < 4; ++i) v.add(snapshot(float(i)));
    const size_t each = bytes_of(*v.list[0]);
    const auto leaving = [&](size_t limit) {
        std::vector<uint64_t> ids;
        for (const SnapshotPtr& s : snapshots_to_unload(v, limit)) ids.push_back(s->id);
        return ids;
    };
    EXPECT_TRUE(leaving(4 * each).empty());
    EXPECT_EQ(leaving(4 * each - 1), (std::vector<uint64_t>{1}));
    v.use(*v.list[0]);
    EXPECT_EQ(leaving(2 * each), (std::vector<uint64_t>{2, 3}));
    v.list[1]->pinned = true;
    EXPECT_EQ(leaving(2 * each), (std::vector<uint64_t>{3, 4}));
    v.compare = {Mode::wipe, 3, live_image};
    EXPECT_EQ(leaving(0), (std::vector<uint64_t>{4})) << "pinned, compared and last used ones stay";
    v.list[3]->unload();
    EXPECT_TRUE(leaving(0).empty()) << "it has nothing more to unload";
}

TEST(Snapshots, ThumbnailsKeepAspectAndMean) {
    const auto wide = plain_frame(640, 100, 0.5f);
    const Thumbnail t = thumbnail_of(*wide);
    ASSERT_EQ(t.rgba.size(), size_t(Thumbnail::width * Thumbnail::height * 4));
    int filled = 0;
    for (size_t i = 0; i < t.rgba.size(); i += 4) filled += t.rgba[i] > 0;
    EXPECT_EQ(filled, Thumbnail::width * (Thumbnail::width * 100 / 640));
    EXPECT_FLOAT_EQ(t.rgba[4 * (size_t(Thumbnail::height / 2) * Thumbnail::width)], 0.5f);
    EXPECT_EQ(t.rgba[0], 0) << "bars above and below";
}

TEST(Differences, MatchTheirDefinition) {
    DifferenceInput q;
    q.a = plain_frame(16, 16, 3);
    q.b = plain_frame(16, 16, 1);
    const Difference absolute = difference_of(q);
    EXPECT_EQ(absolute.problem, "");
    EXPECT_FLOAT_EQ(absolute.rgba[0], 2);
    EXPECT_NEAR(absolute.numbers.relmse, 4 / 1.01, 1e-6);
    EXPECT_FALSE(absolute.has_flip);
    q.kind = DifferenceKind::flip;
    const Difference flip = difference_of(q);
    EXPECT_TRUE(flip.has_flip);
    EXPECT_GT(flip.numbers.flip.mean, 0.1);
    q.a = q.b;
    EXPECT_EQ(difference_of(q).numbers.flip.mean, 0);
    q.kind = DifferenceKind::relative;
    EXPECT_EQ(difference_of(q).rgba[0], 0) << "black where they are equal";
    q.a = plain_frame(16, 8, 3);
    EXPECT_NE(difference_of(q).problem, "") << "other sizes";
}

class SnapshotPanels : public test::ImGuiTest {
protected:
    void draw() {
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 640, 480};
            draw_snapshot_strip(c, {450, 400, 600, snapshot_strip_height(ui.snapshots)}, [](size_t) { return ThumbnailPart{}; });
            draw_comparison_panel(c);
            draw_snapshot_panel(c);
        });
    }
    // Position of a card, outside of its buttons.
    void click_first_card() {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = {550, 450};
        draw();
        draw();
        io.MouseDown[0] = true;
        draw();
        io.MouseDown[0] = false;
        draw();
    }

    const ColorManagement color = test::our_colors();
    Document document{test::sample_project().project};
    UiState ui;
    FramePtr frame = plain_frame(32, 20, 1);
};

TEST_F(SnapshotPanels, DrawingRequestsNothing) {
    draw();
    const uint64_t id = ui.snapshots.add(snapshot(1));
    ui.snapshots.add(snapshot(2));
    ui.snapshots.details = id;
    for (const Mode mode : {Mode::off, Mode::wipe, Mode::flicker, Mode::difference}) {
        ui.snapshots.compare = {mode, id, live_image};
        for (int i = 0; i < 3; ++i) draw();
    }
    ui.difference = std::make_shared<const Difference>(
        difference_of({plain_frame(8, 8, 1), plain_frame(8, 8, 2), nullptr, nullptr, {}, DifferenceKind::absolute}));
    draw();
    EXPECT_TRUE(ui.snapshots.requests.empty());
    EXPECT_TRUE(ui.commands.empty());
    EXPECT_FALSE(document.can_undo());
    EXPECT_EQ(ui.snapshots.list.size(), 2u);
}

TEST_F(SnapshotPanels, ClickRequestsARestore) {
    const uint64_t id = ui.snapshots.add(snapshot(1));
    click_first_card();
    ASSERT_EQ(ui.snapshots.requests.size(), 1u);
    EXPECT_EQ(ui.snapshots.requests[0].id, id);
    EXPECT_EQ(ui.snapshots.requests[0].what, SnapshotRequest::What::restore);
    ui.snapshots.requests.clear();
    ui.snapshots.open = false;
    click_first_card();
    EXPECT_TRUE(ui.snapshots.requests.empty()) << "a closed strip";
}

TEST(RestoreEdit, IsOneUndoStep) {
    const Project before = test::sample_project().project;
    Project kept = before;
    kept.scene.environment.intensity = 7;
    kept.scene.view.position = {9, 8, 7};
    kept.view.exposure_ev = 2;
    kept.render.spp = 99;
    Document document(before);
    ASSERT_TRUE(document.apply(Restore{kept, "Key only"}));
    EXPECT_TRUE(document.project() == kept);
    EXPECT_EQ(document.undo_label(), "Restore Key only");
    document.undo();
    EXPECT_TRUE(document.project() == before);
    kept.view.exposure_ev = 1e30f;
    EXPECT_FALSE(document.apply(Restore{kept, "broken"}));
}

} // namespace
} // namespace blush::TEST_FILE
