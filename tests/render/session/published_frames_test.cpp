#include "render/session/published_frames.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

FramePtr frame() { return std::make_shared<const Frame>(); }
DenoisedPtr denoised() { return std::make_shared<const DenoisedImage>(); }

TEST(PublishedFrames, ADenoisedImageLivesAsLongAsItsImage) {
    PublishedFrames published;
    const FramePtr first = frame(), second = frame(), other = frame();
    const DenoisedPtr image = denoised();
    published.show(1, first);
    EXPECT_EQ(published.images().denoised, nullptr);
    published.answer(1, first, image);
    EXPECT_EQ(published.images().denoised, image);
    published.show(1, second);
    EXPECT_EQ(published.images().frame, second);
    EXPECT_EQ(published.images().denoised, image);
    published.answer(1, second, nullptr);
    EXPECT_EQ(published.images().denoised, image) << "a skipped frame keeps the denoised image";
    published.show(2, other);
    EXPECT_EQ(published.images().denoised, nullptr);
    published.answer(1, second, denoised());
    EXPECT_EQ(published.images().frame, other);
    EXPECT_EQ(published.images().denoised, nullptr) << "its image is no longer shown";
}

TEST(PublishedFrames, AWithheldFrameIsShownWithItsDenoisedVersion) {
    PublishedFrames published;
    const FramePtr old = frame(), next = frame();
    published.show(1, old);
    published.withhold(2, next);
    EXPECT_EQ(published.images().frame, old);
    const DenoisedPtr image = denoised();
    published.answer(2, next, image);
    EXPECT_EQ(published.images().frame, next);
    EXPECT_EQ(published.images().denoised, image);
}

TEST(PublishedFrames, AWithheldFrameIsShownIfDenoisingFails) {
    for (const bool answered : {true, false}) {
        PublishedFrames published;
        const FramePtr next = frame();
        published.withhold(1, next);
        if (answered)
            published.answer(1, next, nullptr);
        else
            published.release();
        EXPECT_EQ(published.images().frame, next);
        EXPECT_EQ(published.images().denoised, nullptr);
        published.release();
        EXPECT_EQ(published.images().frame, next) << "nothing is withheld any more";
    }
}

TEST(PublishedFrames, ALaterFrameIsShownAtOnce) {
    PublishedFrames published;
    const FramePtr coarse = frame(), fine = frame();
    const DenoisedPtr image = denoised();
    published.withhold(1, coarse);
    published.show(1, fine);
    EXPECT_EQ(published.images().frame, fine);
    published.answer(1, coarse, image);
    EXPECT_EQ(published.images().frame, fine);
    EXPECT_EQ(published.images().denoised, image) << "coarser, but of the same image";
}

TEST(PublishedFrames, ADragFasterThanTheDenoiserStillShowsSomething) {
    PublishedFrames published;
    const FramePtr second = frame(), third = frame();
    published.show(1, frame());
    published.withhold(2, second);
    published.withhold(3, third);
    const DenoisedPtr of_second = denoised(), of_third = denoised();
    published.answer(2, second, of_second);
    EXPECT_EQ(published.images().frame, second);
    EXPECT_EQ(published.images().denoised, of_second);
    published.answer(3, third, of_third);
    EXPECT_EQ(published.images().frame, third);
    EXPECT_EQ(published.images().denoised, of_third);
}

} // namespace
} // namespace blush::TEST_FILE
