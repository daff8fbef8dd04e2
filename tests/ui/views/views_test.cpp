// Special views of a frame (bounces, AOVs, heat maps) and their captions.
#include "core/srgb.h"
#include "ui/snapshots/aov_pixels.h"
#include "ui/snapshots/aov_view.h"
#include "ui/snapshots/heat_map.h"
#include "ui/snapshots/image_pixels.h"
#include "ui/views/bounces_view.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using Mode = BouncesView::Mode;
using Show = ImageView::Show;

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
    const auto first = [&](const BouncesView& v) { return pixels_of(f, image_view(v, 3))[0]; };
    EXPECT_EQ(first(view_of(Mode::single, 2)), 4);
    EXPECT_EQ(first(view_of(Mode::cumulative, 1)), 3);
    EXPECT_EQ(first(view_of(Mode::direct)), 3);
    EXPECT_EQ(first(view_of(Mode::indirect)), 4);
    BouncesView gains = view_of(Mode::gains);
    gains.gains = {0, 0.5f, 2};
    EXPECT_EQ(first(gains), 9);
    EXPECT_EQ(pixels_of(f, image_view(gains, 3)).size(), f.rgba.size());
}

TEST(BouncesView, AllGainsOneIsTheImage) {
    const Frame f = frame_with_bounces();
    EXPECT_FALSE(is_special(f, image_view(view_of(Mode::image), 3)));
    EXPECT_FALSE(is_special(f, image_view(view_of(Mode::cumulative, 2), 3)));
    EXPECT_FALSE(is_special(f, image_view(view_of(Mode::gains), 3))) << "all gains are 1";
    EXPECT_TRUE(is_special(f, image_view(view_of(Mode::single, 2), 3)));
    EXPECT_FALSE(is_special(Frame{}, image_view(view_of(Mode::single, 2), 3))) << "no planes yet";
    BouncesView closed = view_of(Mode::single);
    closed.open = false;
    EXPECT_FALSE(is_special(f, image_view(closed, 3)));
}

TEST(BouncesView, CaptionSaysNotTheWholeImage) {
    Frame f = frame_with_bounces();
    EXPECT_EQ(caption_of(f, image_view(view_of(Mode::single, 1), 3)), "Bounce 1 only: not the whole image");
    EXPECT_EQ(caption_of(f, image_view(view_of(Mode::indirect), 3)), "Bounce 2+ only: not the whole image");
    EXPECT_EQ(caption_of(f, image_view(view_of(Mode::direct), 3)), "Bounces 0, 1 only: not the whole image");
    BouncesView gains = view_of(Mode::gains);
    gains.gains = {1, 1, 1.5f};
    EXPECT_EQ(caption_of(f, image_view(gains, 3)), "Bounces with gains: not the physical image");
    f.gains = {{1, 1, 1}, {1, 1, 1}};
    EXPECT_EQ(caption_of(f, image_view(gains, 3)), "Bounces with gains: not the physical image");
    f.gains[1] = {1, 0, 1};
    EXPECT_EQ(caption_of(f, image_view(gains, 3)), "Bounces with gains: not the physical image, without the light mix");
}

TEST(BouncesView, PlaysInALoop) {
    BouncesView v = view_of(Mode::single, 1);
    v.step_due = 10;
    EXPECT_NEAR(play(v, 9.5, 3), 0.5, 1e-9);
    EXPECT_EQ(v.bounce, 1);
    EXPECT_NEAR(play(v, 10, 3), BouncesView::seconds_each, 1e-9);
    EXPECT_EQ(v.bounce, 2);
    play(v, 11, 3);
    EXPECT_EQ(v.bounce, 0);
}

TEST(Maps, LuminanceIncreases) {
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
    EXPECT_NE(caption_of(f, {Show::dropped}).find("3 per pixel"), std::string::npos);
    // No dropped samples: a black map.
    EXPECT_TRUE(is_special(frame_with_bounces(), {Show::dropped}));
    EXPECT_EQ(pixels_of(frame_with_bounces(), {Show::dropped})[4], 0);
}

// ---- AOVs

Frame frame_with_planes() {
    Frame f;
    f.width = 4;
    f.height = 1;
    f.samples = 16;
    f.rgba = {1, 1, 1, 1, 2, 2, 2, 1, 0, 0, 0, 1, 4, 4, 4, 1};
    f.albedo = {{0.2f, 0.4f, 0.6f}, {1, 1, 1}, {0, 0, 0}, {0.5f, 0.5f, 0.5f}};
    f.normal = {{1, 0, 0}, {0, 0, -1}, {0, 0, 0}, {0, 1, 0}};
    f.depth = {2, 4, 0, 3};
    f.object_id = {7, 7, 0, 8};
    f.material_id = {1, 2, 0, 1};
    f.standard_error = {{0.1f, 0.1f, 0.1f}, {0, 0, 0}, {0.001f, 0.001f, 0.001f}, {8, 8, 8}};
    f.pixel_samples = {8, 8, 16, 32};
    f.group_names = {"Key", "Fill"};
    f.groups = {{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, {4, 4, 4}}, {{0, 0, 0}, {2, 2, 2}, {0, 0, 0}, {0, 0, 0}}};
    f.gains = {{1, 1, 1}, {0.5f, 0.5f, 0.5f}};
    return f;
}
Vec3 shown_at(const Frame& f, const ImageView& view, size_t pixel) {
    const std::vector<float> p = pixels_of(f, view);
    return {p[4 * pixel], p[4 * pixel + 1], p[4 * pixel + 2]};
}
float encoded(float linear) { return srgb_from_linear(linear); }

TEST(AovView, DataAovsAreDisplayValues) {
    const Frame f = frame_with_planes();
    EXPECT_EQ(shown_at(f, {Show::albedo}, 0), (Vec3{0.2f, 0.4f, 0.6f}));
    const Vec3 normal = shown_at(f, {Show::normal}, 1);
    EXPECT_NEAR(double(encoded(normal.x)), 0.5, 1e-4);
    EXPECT_NEAR(double(encoded(normal.z)), 0, 1e-4);
    EXPECT_EQ(shown_at(f, {Show::normal}, 2), (Vec3{0, 0, 0})) << "no hit";
    EXPECT_NEAR(double(encoded(shown_at(f, {Show::depth}, 0).x)), 0, 1e-4) << "the nearest";
    EXPECT_NEAR(double(encoded(shown_at(f, {Show::depth}, 3).x)), 0.5, 1e-4);
    EXPECT_NEAR(double(encoded(shown_at(f, {Show::depth}, 1).x)), 1, 1e-4) << "the furthest";
    EXPECT_GT(shown_at(f, {Show::depth}, 2).z, shown_at(f, {Show::depth}, 2).x) << "nothing hit is no depth";
    for (const Show show : {Show::albedo, Show::normal, Show::depth, Show::object_id, Show::material_id, Show::error, Show::samples}) {
        EXPECT_TRUE(is_special(f, {show}));
        EXPECT_TRUE(is_data({show}));
        EXPECT_EQ(pixels_of(f, {show})[3], 0) << "only the sRGB curve is applied";
        EXPECT_FALSE(caption_of(f, {show}).empty());
    }
    EXPECT_FALSE(is_special(Frame{}, {Show::depth}));
    EXPECT_FALSE(is_data({Show::group}));
}

TEST(AovView, IdsHaveFixedColours) {
    Frame f = frame_with_planes();
    const Vec3 seven = shown_at(f, {Show::object_id}, 0), eight = shown_at(f, {Show::object_id}, 3);
    EXPECT_EQ(shown_at(f, {Show::object_id}, 1), seven);
    EXPECT_NE(seven, eight);
    EXPECT_EQ(shown_at(f, {Show::object_id}, 2), (Vec3{0, 0, 0}));
    f.object_id = {8, 1, 2, 7};
    EXPECT_EQ(shown_at(f, {Show::object_id}, 3), seven);
    for (uint32_t a = 1; a < 64; ++a)
        for (uint32_t b = 1; b < a; ++b) EXPECT_NE(id_color(a), id_color(b)) << a << ' ' << b;
}

TEST(AovView, MapsErrorAndSamplesWithAScale) {
    const Frame f = frame_with_planes();
    EXPECT_EQ(shown_at(f, {Show::error}, 1), heat_map_color(0)) << "no error";
    EXPECT_EQ(shown_at(f, {Show::error}, 3), heat_map_color(1)) << "larger than the value";
    EXPECT_NEAR(double(relative_error(f, 2)), 0.01, 1e-4) << "of black, as relMSE weighs it";
    EXPECT_EQ(shown_at(f, {Show::samples}, 3), heat_map_color(1));
    EXPECT_EQ(shown_at(f, {Show::samples}, 0), heat_map_color(0.25f));
    EXPECT_EQ(map_scale(f, Show::depth)->low, "2 m");
    EXPECT_EQ(map_scale(f, Show::depth)->high, "4 m");
    EXPECT_EQ(map_scale(f, Show::samples)->high, "32");
    EXPECT_TRUE(map_scale(f, Show::error));
    EXPECT_FALSE(map_scale(f, Show::albedo));
}

TEST(AovView, ListsAovsAndWhatTheyNeed) {
    const Frame f = frame_with_planes();
    const auto find = [](const std::vector<AovEntry>& list, const AovView& v) { return *std::ranges::find(list, v, &AovEntry::view); };
    const Frame bounced = frame_with_bounces();
    const std::vector<AovEntry> list = aov_list(&f);
    EXPECT_EQ(find(list, {Show::group, 1}).name, "Group Fill");
    EXPECT_EQ(shown_at(f, image_view(AovView{Show::group, 1}, 0), 1), (Vec3{1, 1, 1})) << "in the current mix";
    EXPECT_FALSE(find(list, {Show::bounces, 2}).needs.empty());
    EXPECT_FALSE(find(aov_list(nullptr), {Show::group}).possible);
    EXPECT_TRUE(find(aov_list(&bounced), {Show::bounces, 2}).needs.empty());

    EXPECT_EQ(planes_of(AovView{}), PlaneSet{}) << "the beauty needs no extra planes";
    EXPECT_EQ(planes_of(AovView{Show::depth}), PlaneSet{});
    EXPECT_EQ(planes_of(AovView{Show::bounces, 3}).bounces, default_bounce_planes);
    EXPECT_TRUE(planes_of(AovView{Show::error}).error);
    EXPECT_FALSE(find(list, {Show::strategy, 2}).needs.empty());
    EXPECT_TRUE(planes_of(AovView{Show::strategy, 2}).strategies);
    Frame by_strategy = f;
    by_strategy.strategies.assign(size_t(found_by_count), std::vector<Vec3>(f.rgba.size() / 4, Vec3{0, 0, 0}));
    by_strategy.strategies[size_t(FoundBy::nee)][1] = {1, 2, 3};
    EXPECT_TRUE(find(aov_list(&by_strategy), {Show::strategy, 2}).needs.empty());
    EXPECT_EQ(find(list, {Show::strategy, 2}).name, "Next event estimation");
    EXPECT_EQ(shown_at(by_strategy, image_view(AovView{Show::strategy, 2}, 0), 1), (Vec3{1, 2, 3}));
    EXPECT_TRUE(PlaneSet{}.covers(planes_of(AovView{Show::error}))) << "the error needs no new image";

    AovView at;
    for (size_t i = 0; i < list.size(); ++i) at = stepped(at, &f, 1);
    EXPECT_EQ(at, AovView{}) << "cyclic";
    EXPECT_EQ(stepped(AovView{}, &f, -1), list.back().view);
    for (size_t i = 0; i < 100; ++i) EXPECT_NE(at = stepped(at, nullptr, 1), (AovView{Show::group, 0})) << "impossible ones are skipped";
}

} // namespace
} // namespace blush::TEST_FILE
