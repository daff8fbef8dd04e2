// The state machine that decides what the viewport uploads and draws.
#include "ui/viewport/image_state.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using enum ImageState;
using namespace std::chrono_literals;

constexpr ImageState all_states[] = {current, drawing, drawing_new_look, preview, drawing_preview};

// An image is displayed, and nothing has changed.
ImageInputs unchanged() { return {.has_frame = true, .has_image = true, .since_mix_edit = 10s}; }

// The gains of the mix have changed, and every n-th pixel per axis can be shown in this UI frame.
ImageInputs mix_edit(int step) {
    ImageInputs in = unchanged();
    in.new_gains = in.edits_mix = true;
    in.preview_step = step;
    in.since_mix_edit = 0s;
    return in;
}

bool draws(const ImageStep& step) { return step.begins || step.restarts; }

TEST(ImageState, DrawsNothingWithoutAChange) {
    for (const ImageState state : {current, drawing, drawing_new_look}) {
        const ImageStep step = next(state, unchanged());
        EXPECT_EQ(step.state, state);
        EXPECT_FALSE(draws(step));
        EXPECT_FALSE(step.pause_in);
        EXPECT_EQ(step.awaited, state == drawing_new_look);
    }
}

TEST(ImageState, DrawsNothingBeforeTheFirstFrame) {
    ImageInputs in{.new_frame = true, .new_look = true, .new_shader = true};
    EXPECT_FALSE(draws(next(current, in)));
    in.has_frame = true;
    EXPECT_TRUE(next(current, in).begins);
}

TEST(ImageState, FinishesAnImageBeforeTheNextFrame) {
    ImageInputs in = unchanged();
    in.new_frame = true;
    EXPECT_FALSE(draws(next(drawing, in)));
    const ImageStep step = next(drawn(drawing), in);
    EXPECT_TRUE(step.begins && step.takes_frame);
    EXPECT_FALSE(step.takes_denoised || step.awaited);
    EXPECT_EQ(step.preview_step, 1);
    EXPECT_EQ(step.state, drawing);
}

TEST(ImageState, TakesADenoisedImageOnlyIfItIsShown) {
    ImageInputs in = unchanged();
    in.new_denoised = true;
    EXPECT_FALSE(draws(next(current, in)));
    in.shows_denoised = true;
    const ImageStep step = next(current, in);
    EXPECT_TRUE(step.begins && step.takes_denoised);
    EXPECT_FALSE(step.takes_frame);
}

TEST(ImageState, AChangedLookIsAwaitedUntilItIsDrawn) {
    ImageInputs in = unchanged();
    in.new_look = true;
    const ImageStep busy = next(drawing, in); // the image in progress is finished sooner
    EXPECT_FALSE(draws(busy));
    EXPECT_TRUE(busy.awaited);
    const ImageStep step = next(current, in);
    EXPECT_TRUE(step.begins && step.awaited);
    EXPECT_FALSE(step.takes_frame || step.takes_denoised); // the pixels are uploaded
    EXPECT_EQ(step.state, drawing_new_look);
    EXPECT_TRUE(next(step.state, unchanged()).awaited);
    EXPECT_EQ(drawn(step.state), current);
    EXPECT_FALSE(next(drawn(step.state), unchanged()).awaited);
}

TEST(ImageState, ASwitchBetweenRawAndDenoisedRestartsTheImage) {
    ImageInputs in = unchanged();
    in.new_look = in.switched_to_one = true;
    const ImageStep step = next(drawing, in);
    EXPECT_TRUE(step.restarts && step.awaited);
    EXPECT_FALSE(step.begins || step.takes_frame || step.takes_denoised);
    EXPECT_EQ(step.state, drawing_new_look);
    EXPECT_EQ(next(drawing_preview, in).state, drawing_preview);

    in.switched_to_one = false; // the blend slider
    EXPECT_FALSE(next(drawing, in).restarts);
    in.switched_to_one = in.shows_denoised = in.new_denoised = true; // its pixels must be uploaded first
    EXPECT_FALSE(next(drawing, in).restarts);
}

TEST(ImageState, AnEditOfTheMixInterruptsAFullImageButNotAPreview) {
    for (const ImageState state : {current, drawing, drawing_new_look, preview}) {
        const ImageStep step = next(state, mix_edit(4));
        EXPECT_TRUE(step.begins && step.takes_frame && step.awaited);
        EXPECT_EQ(step.preview_step, 4);
        EXPECT_EQ(step.state, drawing_preview);
    }
    EXPECT_FALSE(draws(next(drawing_preview, mix_edit(4))));
    EXPECT_EQ(drawn(drawing_preview), preview);
    // In full resolution it waits like every other image.
    EXPECT_FALSE(draws(next(drawing, mix_edit(1))));
    EXPECT_EQ(next(current, mix_edit(1)).state, drawing);
    EXPECT_EQ(next(preview, mix_edit(1)).state, drawing);
}

TEST(ImageState, FullResolutionFollowsWhenTheEditPauses) {
    ImageInputs in = unchanged();
    in.shows_denoised = in.new_frame = in.new_denoised = true; // new frames wait, too
    in.since_mix_edit = mix_pause_after - 1ms;
    const ImageStep early = next(preview, in);
    EXPECT_FALSE(draws(early));
    EXPECT_EQ(early.state, preview);
    ASSERT_TRUE(early.pause_in);
    EXPECT_EQ(*early.pause_in, 1ms);

    in = unchanged();
    in.shows_denoised = true;
    in.since_mix_edit = mix_pause_after;
    const ImageStep paused = next(preview, in);
    EXPECT_TRUE(paused.begins && paused.takes_frame && paused.takes_denoised);
    EXPECT_EQ(paused.preview_step, 1);
    EXPECT_EQ(paused.state, drawing);
    EXPECT_FALSE(paused.pause_in);
}

TEST(ImageState, ANewLookOfAPreviewKeepsItsPixels) {
    ImageInputs in = unchanged();
    in.new_look = true;
    in.since_mix_edit = 1ms;
    const ImageStep step = next(preview, in);
    EXPECT_TRUE(step.begins);
    EXPECT_FALSE(step.takes_frame || step.takes_denoised);
    EXPECT_EQ(step.state, drawing_preview);
}

TEST(ImageState, AskedAgainEveryImageEndsInFullResolution) {
    for (const ImageState from : all_states) {
        ImageState state = from;
        for (int i = 0; i < 3; ++i) {
            const ImageStep step = next(state, unchanged());
            state = drawn(step.state);
        }
        EXPECT_EQ(state, current);
    }
}

} // namespace
} // namespace blush::TEST_FILE
