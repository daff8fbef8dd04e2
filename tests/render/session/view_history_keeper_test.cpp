// Which frames the view history follows, without a session: each of one colour, before a wall that fills the image.
#include "render/session/view_history_keeper.h"

#include <gtest/gtest.h>

#include <memory>

namespace blush::TEST_FILE {
namespace {

constexpr int side = 32;

// Of a camera that faces the wall, `x` metres to the side.
std::shared_ptr<Frame> frame_at(double x, int divider, int64_t samples) {
    auto frame = std::make_shared<Frame>();
    frame->look = 1;
    frame->divider = divider;
    frame->samples = samples;
    frame->width = frame->height = side / divider;
    const size_t pixels = size_t(frame->width) * size_t(frame->height);
    frame->albedo.assign(pixels, {0.5f, 0.5f, 0.5f});
    frame->normal.assign(pixels, {0, 0, 1});
    frame->depth.assign(pixels, 2);
    frame->camera = WorldCamera{{x, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, true};
    return frame;
}

DenoisedImage denoised_of(const Frame& frame, float value) {
    DenoisedImage image;
    image.width = frame.width;
    image.height = frame.height;
    image.denoised.rgb.assign(3 * frame.depth.size(), value);
    return image;
}

// The share of history in the denoised image of a frame; 0: none.
float share_of(ViewHistoryKeeper& keeper, const FramePtr& frame, float value = 1) {
    DenoisedImage image = denoised_of(*frame, value);
    keeper.follow(frame, image, nullptr);
    EXPECT_EQ(image.denoised.rgb, denoised_of(*frame, value).denoised.rgb) << "what is measured and saved";
    return image.with_history.share;
}

TEST(ViewHistoryKeeper, MixesUntilSamplesHaveQuadrupled) {
    ViewHistoryKeeper keeper;
    EXPECT_EQ(share_of(keeper, frame_at(0, 1, 64)), 0) << "the first view";
    EXPECT_EQ(keeper.look(), 1u);
    EXPECT_GT(share_of(keeper, frame_at(0.1, 4, 1)), 0.8f);
    EXPECT_GT(share_of(keeper, frame_at(0.2, 4, 1)), 0.7f) << "coarse images are not kept";
    EXPECT_GT(share_of(keeper, frame_at(0.2, 1, 1)), 0.7f);
    EXPECT_EQ(share_of(keeper, frame_at(0.2, 1, 4)), 0) << "its own view";
    EXPECT_EQ(share_of(keeper, frame_at(0.3, 1, 4)), 0) << "it has enough samples of its own";
}

TEST(ViewHistoryKeeper, CompleteImagesShowTheirOwnSamples) {
    for (const bool complete : {false, true}) {
        ViewHistoryKeeper keeper;
        share_of(keeper, frame_at(0, 1, 64));
        const auto frame = frame_at(0.1, 1, 2);
        frame->complete = complete;
        EXPECT_EQ(share_of(keeper, frame) > 0, !complete);
    }
}

TEST(ViewHistoryKeeper, EndsWithAnotherLook) {
    ViewHistoryKeeper keeper;
    share_of(keeper, frame_at(0, 1, 64));
    const auto edited = frame_at(0.1, 4, 1);
    edited->look = 2;
    EXPECT_EQ(share_of(keeper, edited), 0);
    EXPECT_EQ(keeper.look(), 0u);
    EXPECT_EQ(share_of(keeper, frame_at(0.1, 4, 1)), 0) << "it does not come back";
}

TEST(ViewHistoryKeeper, DoesWithoutWhatItCannotReproject) {
    const auto follows = [](auto change) {
        ViewHistoryKeeper keeper;
        share_of(keeper, frame_at(0, 1, 64));
        const auto frame = frame_at(0.1, 4, 1);
        change(*frame);
        return share_of(keeper, frame) > 0;
    };
    EXPECT_TRUE(follows([](Frame&) {}));
    EXPECT_FALSE(follows([](Frame& f) { f.camera.reset(); })) << "an aperture, a transparent image or a region";
    EXPECT_FALSE(follows([](Frame& f) { f.groups.resize(2); })) << "a light mix";
    EXPECT_FALSE(follows([](Frame& f) { f.normal.clear(); })) << "no first hits";
}

TEST(ViewHistoryKeeper, MemoryIsBounded) {
    ViewHistoryKeeper small(side * side - 1), enough(side * side);
    for (ViewHistoryKeeper* keeper : {&small, &enough}) share_of(*keeper, frame_at(0, 1, 64));
    EXPECT_EQ(small.look(), 0u);
    EXPECT_EQ(share_of(small, frame_at(0.1, 4, 1)), 0);
    EXPECT_GT(share_of(enough, frame_at(0.1, 4, 1)), 0);
    enough.forget();
    EXPECT_EQ(share_of(enough, frame_at(0.1, 4, 1)), 0);
}

} // namespace
} // namespace blush::TEST_FILE
