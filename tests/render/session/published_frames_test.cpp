#include "render/session/published_frames.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

FramePtr frame() { return std::make_shared<const Frame>(); }
DenoisedPtr denoised() { return std::make_shared<const DenoisedImage>(); }

TEST(PublishedFrames, ADenoisedImageLivesAsLongAsItsImage) {
    PublishedFrames showcase;
    const FramePtr first = frame(), second = frame(), other = frame();
    const DenoisedPtr image = denoised();
    showcase.show(1, first);
    EXPECT_EQ(showcase.images().denoised, nullptr);
    showcase.answer(1, first, image);
    EXPECT_EQ(showcase.images().denoised, image);
    showcase.show(1, second);
    EXPECT_EQ(showcase.images().frame, second);
    EXPECT_EQ(showcase.images().denoised, image);
    showcase.answer(1, second, nullptr);
    EXPECT_EQ(showcase.images().denoised, image) << "a skipped frame keeps the denoised image";
    showcase.show(2, other);
    EXPECT_EQ(showcase.images().denoised, nullptr);
    showcase.answer(1, second, denoised());
    EXPECT_EQ(showcase.images().frame, other);
    EXPECT_EQ(showcase.images().denoised, nullptr) << "its image is no longer shown";
}

TEST(PublishedFrames, AWithheldFrameIsShownWithItsDenoisedVersion) {
    PublishedFrames showcase;
    const FramePtr old = frame(), next = frame();
    showcase.show(1, old);
    showcase.withhold(2, next);
    EXPECT_EQ(showcase.images().frame, old);
    const DenoisedPtr image = denoised();
    showcase.answer(2, next, image);
    EXPECT_EQ(showcase.images().frame, next);
    EXPECT_EQ(showcase.images().denoised, image);
}

TEST(PublishedFrames, AWithheldFrameIsShownIfDenoisingFails) {
    for (const bool answered : {true, false}) {
        PublishedFrames showcase;
        const FramePtr next = frame();
        showcase.withhold(1, next);
        if (answered)
            showcase.answer(1, next, nullptr);
        else
            showcase.release();
        EXPECT_EQ(showcase.images().frame, next);
        EXPECT_EQ(showcase.images().denoised, nullptr);
        showcase.release();
        EXPECT_EQ(showcase.images().frame, next) << "nothing is withheld any more";
    }
}

TEST(PublishedFrames, ALaterFrameIsShownAtOnce) {
    PublishedFrames showcase;
    const FramePtr coarse = frame(), fine = frame();
    const DenoisedPtr image = denoised();
    showcase.withhold(1, coarse);
    showcase.show(1, fine);
    EXPECT_EQ(showcase.images().frame, fine);
    showcase.answer(1, coarse, image);
    EXPECT_EQ(showcase.images().frame, fine);
    EXPECT_EQ(showcase.images().denoised, image) << "coarser, but of the same image";
}

TEST(PublishedFrames, ADragFasterThanTheDenoiserStillShowsSomething) {
    PublishedFrames showcase;
    const FramePtr second = frame(), third = frame();
    showcase.show(1, frame());
    showcase.withhold(2, second);
    showcase.withhold(3, third);
    const DenoisedPtr of_second = denoised(), of_third = denoised();
    showcase.answer(2, second, of_second);
    EXPECT_EQ(showcase.images().frame, second);
    EXPECT_EQ(showcase.images().denoised, of_second);
    showcase.answer(3, third, of_third);
    EXPECT_EQ(showcase.images().frame, third);
    EXPECT_EQ(showcase.images().denoised, of_third);
}

} // namespace
} // namespace blush::TEST_FILE
