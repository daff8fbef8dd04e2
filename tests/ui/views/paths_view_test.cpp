// Which pixels and vertices the path tool shows, and its playback.
#include "ui/views/paths_view.h"

#include <gtest/gtest.h>

#include <set>

namespace blush::TEST_FILE {
namespace {

PathsView view_of(const std::vector<size_t>& lengths) {
    auto set = std::make_shared<PathSet>();
    for (const size_t length : lengths) {
        auto path = std::make_shared<RecordedPath>();
        path->vertices.resize(length);
        set->paths.push_back(path);
    }
    PathsView view;
    view.state.output = set;
    return view;
}

TEST(PathsView, TracesOnePixelOrUpTo64OfARectangle) {
    EXPECT_EQ(traced_pixels({0.5f, 0.25f, 0, 0}, 100, 80), (std::vector<TracedPixel>{{50, 20}}));
    EXPECT_EQ(traced_pixels({0.999f, 0.999f, 0, 0}, 100, 80), (std::vector<TracedPixel>{{99, 79}}));
    EXPECT_EQ(traced_pixels({0.1f, 0.1f, 0.02f, 0.025f}, 100, 80), (std::vector<TracedPixel>{{10, 8}, {11, 8}, {10, 9}, {11, 9}}));
    const std::vector<TracedPixel> many = traced_pixels({}, 100, 80);
    EXPECT_EQ(many.size(), 64u);
    std::set<std::pair<int, int>> different;
    for (const TracedPixel& p : many) {
        EXPECT_TRUE(p.x >= 0 && p.x < 100 && p.y >= 0 && p.y < 80);
        different.insert({p.x, p.y});
    }
    EXPECT_EQ(different.size(), 64u);
}

TEST(PathsView, ShowsAllVerticesOrTheFirst) {
    PathsView view = view_of({3, 5});
    EXPECT_EQ(view.shown_vertices(), 3u);
    view.path = 7; // there are fewer now
    EXPECT_EQ(view.shown(), view.set()->paths[1].get());
    view.steps = 2;
    EXPECT_EQ(view.shown_vertices(), 2u);
    view.steps = 9;
    EXPECT_EQ(view.shown_vertices(), 5u);
    view.state.output.reset();
    EXPECT_EQ(view.shown(), nullptr);
    EXPECT_EQ(view.shown_vertices(), 0u);
}

TEST(PathsView, PlaysVertexByVertexAndPathByPath) {
    PathsView view = view_of({2, 3});
    view.speed = 2; // vertices per second
    std::vector<std::pair<int64_t, int64_t>> seen;
    for (double now = 10; now < 13.9; now += 0.25) {
        const double left = play(view, now);
        EXPECT_GT(left, 0);
        EXPECT_LE(left, 0.5);
        if (seen.empty() || seen.back() != std::pair{view.path, view.steps}) seen.emplace_back(view.path, view.steps);
    }
    // It begins behind the path that is shown whole, and begins again behind the last one.
    EXPECT_EQ(seen, (std::vector<std::pair<int64_t, int64_t>>{{1, 1}, {1, 2}, {1, 3}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {1, 3}}));
}

TEST(PathsView, ShowsTheBrightestChannelUnlessOneIsChosen) {
    PathsView view;
    RecordedPath path;
    path.radiance = {1, 2, 3};
    EXPECT_EQ(view.channel_of(path), RgbChannel::blue);
    view.channel = PathsView::ShownChannel::green;
    EXPECT_EQ(view.channel_of(path), RgbChannel::green);
}

} // namespace
} // namespace blush::TEST_FILE
