// The lines of the path tool: their places, their colours, and that the view may move while they stay.
#include "tests/ui/imgui_test.h"
#include "ui/viewport/path_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush::TEST_FILE {
namespace {

constexpr ImageRect image{0, 0, 400, 400};

// From the eye at (0, 0, 5) to a point in the middle of the image, on to the right, with a shadow ray upwards.
RecordedPath path_with(bool blocked) {
    RecordedPath path;
    path.eye = {0, 0, 5};
    path.radiance = {1, 1, 1};
    PathVertex a, b;
    a.met = b.met = Met::surface;
    a.position = {0, 0, 0};
    a.arriving = a.beta = {1, 1, 1};
    b.position = {1, 0, 0};
    b.arriving = {0, 1, 0};
    b.end = PathEnd::roulette;
    b.survival = 0.25f;
    NextEvent e;
    e.to = {0, 1, 0};
    e.blocked = blocked;
    e.blocker = "shelf";
    e.arrived = blocked ? Vec3{0, 0, 0} : Vec3{0, 0, 1};
    a.next_event = e;
    path.vertices = {a, b};
    return path;
}

class PathLines : public test::ImGuiTest {
protected:
    struct Drawn {
        int blue = 0, red = 0, green = 0; // vertices of these hues
        float left = INFINITY, right = -INFINITY;
        size_t vertices = 0;
    };
    Drawn draw(const PathsView& view, const View& camera) {
        Drawn drawn;
        in_window([&] {
            ImDrawList& list = *ImGui::GetWindowDrawList();
            const int before = list.VtxBuffer.Size;
            draw_path_lines(list, image, Projection(camera, 1), view);
            drawn.vertices = size_t(list.VtxBuffer.Size - before);
            for (int i = before; i < list.VtxBuffer.Size; ++i) {
                const ImDrawVert& v = list.VtxBuffer[i];
                const int r = int(v.col & 255), g = int(v.col >> 8 & 255), b = int(v.col >> 16 & 255);
                drawn.blue += b > 200 && r < 50;
                drawn.red += r > 200 && g < 100 && b < 100;
                if (!(g > 200 && r < 50 && b < 50)) continue;
                ++drawn.green;
                drawn.left = std::min(drawn.left, v.pos.x);
                drawn.right = std::max(drawn.right, v.pos.x);
            }
        });
        return drawn;
    }
    static PathsView view_of(const std::vector<RecordedPath>& paths) {
        auto set = std::make_shared<PathSet>();
        for (const RecordedPath& path : paths) set->paths.push_back(std::make_shared<const RecordedPath>(path));
        PathsView view;
        view.open = true;
        view.state.output = set;
        return view;
    }
    static View camera_at(const Vec3& position) {
        View view;
        view.position = position;
        view.rotation = {0, 0, 0, 1};
        view.lens.yfov_radians = 1;
        return view;
    }
};

TEST_F(PathLines, ShadowRaysHaveTheColourOfWhatArrives) {
    const Drawn lit = draw(view_of({path_with(false)}), camera_at({0, 0, 5}));
    EXPECT_GT(lit.blue, 20); // dashes
    EXPECT_EQ(lit.red, 0);
    const Drawn blocked = draw(view_of({path_with(true)}), camera_at({0, 0, 5}));
    EXPECT_GT(blocked.red, 20);
    EXPECT_EQ(blocked.blue, 0);
}

// The segment to the right has the throughput's hue. A camera that moves to the right sees it further left.
TEST_F(PathLines, StayWhereTheyAre) {
    const PathsView view = view_of({path_with(false)});
    const Drawn here = draw(view, camera_at({0, 0, 5})), moved = draw(view, camera_at({1, 0, 5}));
    const float scale = 200 / (5 * std::tan(0.5f)); // pixels per metre
    EXPECT_NEAR(here.left, 200, 6);
    EXPECT_NEAR(here.right, 200 + scale, 6);
    EXPECT_NEAR(moved.right, 200, 6);
}

TEST_F(PathLines, ShowsTheVerticesThatAreChosen) {
    PathsView view = view_of({path_with(false)});
    view.steps = 1;
    const Drawn first = draw(view, camera_at({0, 0, 5}));
    EXPECT_EQ(first.green, 0);
    EXPECT_GT(first.blue, 0);
}

TEST_F(PathLines, DrawsOtherPathsUpToALimit) {
    const std::vector<RecordedPath> many(most_drawn_paths + 100, path_with(false));
    PathsView view = view_of(many);
    const size_t all = draw(view, camera_at({0, 0, 5})).vertices;
    view.others = false;
    const size_t one = draw(view, camera_at({0, 0, 5})).vertices;
    EXPECT_GT(all, 15 * one); // the shown path has shades and smooth edges
    view = view_of({many.begin(), many.begin() + most_drawn_paths});
    EXPECT_EQ(draw(view, camera_at({0, 0, 5})).vertices, all);
    view.open = false;
    EXPECT_EQ(draw(view, camera_at({0, 0, 5})).vertices, 0u);
}

// Shadow rays that leave the screen have no more dashes than fit on it.
TEST_F(PathLines, ClipsLongLines) {
    RecordedPath path = path_with(false);
    path.vertices[0].next_event->to = {0, 1e7, 0};
    EXPECT_LT(draw(view_of({path}), camera_at({0, 0, 5})).vertices, 4000u);
    EXPECT_EQ(draw(view_of({path}), camera_at({0, 0, -5})).green, 0); // behind the viewer
}

} // namespace
} // namespace blush::TEST_FILE
