// Ways of looking at a frame: what they make of its planes, and that they say so.
#include "ui/bounces_view.h"

#include <gtest/gtest.h>

namespace blush {
namespace {

using Mode = BouncesView::Mode;
using Show = PictureView::Show;

Frame frame_with_bounces() {
    Frame f;
    f.width = 2;
    f.height = 1;
    f.rgba = {7, 7, 7, 1, 0, 0, 0, 1};
    f.bounces = {{{1, 1, 1}, {0, 0, 0}}, {{2, 2, 2}, {0, 0, 0}}, {{4, 4, 4}, {0, 0, 0}}};
    return f;
}
BouncesView view_of(Mode mode, int bounce = 1) {
    BouncesView v;
    v.open = true;
    v.mode = mode;
    v.bounce = bounce;
    return v;
}

TEST(BouncesView, MixesThePlanes) {
    const Frame f = frame_with_bounces();
    const auto first = [&](const BouncesView& v) { return pixels_of(f, picture_view(v, 3))[0]; };
    EXPECT_EQ(first(view_of(Mode::single, 2)), 4);
    EXPECT_EQ(first(view_of(Mode::cumulative, 1)), 3);
    EXPECT_EQ(first(view_of(Mode::direct)), 3);
    EXPECT_EQ(first(view_of(Mode::indirect)), 4);
    BouncesView gains = view_of(Mode::gains);
    gains.gains = {0, 0.5f, 2};
    EXPECT_EQ(first(gains), 9);
    EXPECT_EQ(pixels_of(f, picture_view(gains, 3)).size(), f.rgba.size());
}

TEST(BouncesView, ShowsThePictureWhenAllOfItIsThere) {
    const Frame f = frame_with_bounces();
    EXPECT_FALSE(is_special(f, picture_view(view_of(Mode::picture), 3)));
    EXPECT_FALSE(is_special(f, picture_view(view_of(Mode::cumulative, 2), 3)));
    EXPECT_FALSE(is_special(f, picture_view(view_of(Mode::gains), 3))) << "all gains are 1";
    EXPECT_TRUE(is_special(f, picture_view(view_of(Mode::single, 2), 3)));
    EXPECT_FALSE(is_special(Frame{}, picture_view(view_of(Mode::single, 2), 3))) << "no planes yet";
    BouncesView closed = view_of(Mode::single);
    closed.open = false;
    EXPECT_FALSE(is_special(f, picture_view(closed, 3)));
}

TEST(BouncesView, SaysThatItIsNotThePicture) {
    Frame f = frame_with_bounces();
    EXPECT_EQ(caption_of(f, picture_view(view_of(Mode::single, 1), 3)), "Bounce 1 alone: not the whole picture");
    EXPECT_EQ(caption_of(f, picture_view(view_of(Mode::indirect), 3)), "Bounce 2+ alone: not the whole picture");
    EXPECT_EQ(caption_of(f, picture_view(view_of(Mode::direct), 3)), "Bounces 0, 1 alone: not the whole picture");
    BouncesView gains = view_of(Mode::gains);
    gains.gains = {1, 1, 1.5f};
    EXPECT_EQ(caption_of(f, picture_view(gains, 3)), "Bounces with gains: not the picture");
    f.gains = {{1, 1, 1}, {1, 1, 1}};
    EXPECT_EQ(caption_of(f, picture_view(gains, 3)), "Bounces with gains: not the picture");
    f.gains[1] = {1, 0, 1};
    EXPECT_EQ(caption_of(f, picture_view(gains, 3)), "Bounces with gains: not the picture, in the light from before the light mix");
}

TEST(BouncesView, PlaysInSequenceAndStartsOver) {
    BouncesView v = view_of(Mode::single, 1);
    v.step_due = 10;
    EXPECT_NEAR(play(v, 9.5, 3), 0.5, 1e-9);
    EXPECT_EQ(v.bounce, 1);
    EXPECT_NEAR(play(v, 10, 3), BouncesView::seconds_each, 1e-9);
    EXPECT_EQ(v.bounce, 2);
    play(v, 11, 3);
    EXPECT_EQ(v.bounce, 0);
}

TEST(Maps, RunFromDarkToBright) {
    Frame f = frame_with_bounces();
    f.path_length = {1, 5};
    f.survival = {0.25f, 1};
    f.health.dropped_map = {0, 3};
    for (const Show show : {Show::path_length, Show::dropped}) {
        const std::vector<float> pixels = pixels_of(f, {show});
        EXPECT_EQ(pixels[1], 0);
        EXPECT_EQ(pixels[5], 1);
    }
    EXPECT_EQ(pixels_of(f, {Show::survival})[5], 1);
    EXPECT_NE(caption_of(f, {Show::path_length}).find("5.0"), std::string::npos);
    EXPECT_NE(caption_of(f, {Show::dropped}).find("3 in a pixel"), std::string::npos);
    // Nothing dropped is a black map, not none.
    EXPECT_TRUE(is_special(frame_with_bounces(), {Show::dropped}));
    EXPECT_EQ(pixels_of(frame_with_bounces(), {Show::dropped})[4], 0);
}

} // namespace
} // namespace blush
