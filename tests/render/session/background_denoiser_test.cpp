#include "render/session/background_denoiser.h"

#include "tests/support/eventually.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace blush::TEST_FILE {
namespace {

// Of light 1 everywhere, without noise.
FramePtr frame_of(int64_t samples, int width = 32) {
    auto frame = std::make_shared<Frame>();
    frame->width = width;
    frame->height = 3 * width / 4;
    frame->samples = samples;
    const size_t pixels = size_t(frame->width) * size_t(frame->height);
    frame->rgba.assign(4 * pixels, 1);
    frame->albedo.assign(pixels, Vec3{0.5f, 0.5f, 0.5f});
    frame->normal.assign(pixels, Vec3{0, 0, 1});
    frame->depth.assign(pixels, 2);
    if (samples > 1) frame->half_difference.assign(pixels, Vec3{0, 0, 0});
    return frame;
}

// The network halves its input and takes a second, so it does not run again within three more: it may use half of the time.
struct Bench {
    DenoiserMaker maker() {
        return [this]() -> DenoiseFunction {
            return [this](const DenoiseInput& input, const DenoiseOptions&, const std::function<bool()>&) {
                ++runs;
                last_width = input.width;
                std::this_thread::sleep_for(std::chrono::seconds(1));
                Denoised denoised;
                denoised.rgb.assign(3 * size_t(input.width) * size_t(input.height), 0.5f);
                return Result<std::optional<Denoised>>(std::optional(std::move(denoised)));
            };
        };
    }
    size_t answers() const {
        const std::lock_guard lock(mutex);
        return answered.size();
    }
    DenoisedPtr last() const {
        const std::lock_guard lock(mutex);
        return answered.back();
    }

    std::atomic<int> runs{0}, last_width{0}; // of the last input
    mutable std::mutex mutex;
    std::vector<DenoisedPtr> answered;
    PauseGate gate;
    BackgroundDenoiser denoiser{maker(),
                                1,
                                false,
                                60,
                                gate,
                                [this](uint64_t, const FramePtr&, DenoisedPtr denoised) {
                                    const std::lock_guard lock(mutex);
                                    answered.push_back(std::move(denoised));
                                },
                                [] {}};
};

TEST(BackgroundDenoiser, FramesWithMoreSamplesCorrectTheImageOfTheNetworkWithoutIt) {
    Bench bench;
    bench.denoiser.want(true);
    bench.denoiser.offer(1, frame_of(1));
    ASSERT_TRUE(test::eventually([&] { return bench.answers() == 1; }));
    ASSERT_TRUE(bench.last());
    EXPECT_FALSE(bench.last()->denoised.bias_corrected) << "one sample has no halves";
    EXPECT_EQ(bench.last()->denoised.rgb.front(), 0.5f);

    for (const int64_t samples : {2, 3}) {
        bench.denoiser.offer(1, frame_of(samples));
        ASSERT_TRUE(test::eventually([&] { return bench.answers() == size_t(samples); }));
        EXPECT_EQ(bench.runs, 1) << samples;
        EXPECT_TRUE(bench.last()->denoised.bias_corrected);
        EXPECT_EQ(bench.last()->samples, samples);
        for (const float v : bench.last()->denoised.rgb) ASSERT_NEAR(v, 1, 1e-5f);
    }
}

TEST(BackgroundDenoiser, AFirstSampleThatWouldTakeLongIsDenoisedAtHalfSizeAndEnlarged) {
    Bench bench;
    bench.denoiser.want(true);
    bench.denoiser.offer(1, frame_of(1, 1024)); // the first run is expected to take 0.25 s a megapixel
    ASSERT_TRUE(test::eventually([&] { return bench.answers() == 1; }));
    ASSERT_TRUE(bench.last());
    EXPECT_EQ(bench.last_width.load(), 512);
    EXPECT_EQ(bench.last()->divider, 2);
    EXPECT_TRUE(bench.last()->is_enlarged) << "by the first hits of the frame";
    EXPECT_EQ(bench.last()->width, 1024);
    EXPECT_EQ(bench.last()->height, 768);
    for (const float v : bench.last()->denoised.rgb) ASSERT_NEAR(v, 0.5f, 1e-5f);

    bench.denoiser.offer(1, frame_of(2, 1024));
    ASSERT_TRUE(test::eventually([&] { return bench.answers() == 2; }));
    EXPECT_EQ(bench.last_width.load(), 1024);
    EXPECT_EQ(bench.last()->divider, 1);
    EXPECT_FALSE(bench.last()->is_enlarged);
    EXPECT_TRUE(bench.last()->denoised.bias_corrected);
}

// A network that runs until it is cancelled, or let go.
struct EndlessBench {
    std::atomic<int> begun{0}, cancelled{0}, answers{0};
    std::atomic<bool> let_go{false};
    PauseGate gate;
    BackgroundDenoiser denoiser{[this]() -> DenoiseFunction {
                                    return [this](const DenoiseInput& input, const DenoiseOptions&, const std::function<bool()>& wanted) {
                                        ++begun;
                                        while (!let_go)
                                            if (!wanted()) {
                                                ++cancelled;
                                                return Result<std::optional<Denoised>>(std::optional<Denoised>());
                                            }
                                        Denoised denoised;
                                        denoised.rgb.assign(3 * size_t(input.width) * size_t(input.height), 0.5f);
                                        return Result<std::optional<Denoised>>(std::optional(std::move(denoised)));
                                    };
                                },
                                1,
                                false,
                                60,
                                gate,
                                [this](uint64_t, const FramePtr&, const DenoisedPtr& denoised) { answers += denoised != nullptr; },
                                [] {}};
};

TEST(BackgroundDenoiser, ANewerImageStopsTheRunBeforeItsFirstFrame) {
    EndlessBench bench;
    bench.denoiser.want(true);
    bench.denoiser.offer(1, frame_of(1));
    ASSERT_TRUE(test::eventually([&] { return bench.begun == 1; }));
    bench.denoiser.supersede(2);
    ASSERT_TRUE(test::eventually([&] { return bench.cancelled == 1; }));

    // One more frame of the old image, rendered when the newer one was submitted.
    bench.denoiser.offer(1, frame_of(2));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    bench.let_go = true;
    bench.denoiser.offer(2, frame_of(1));
    ASSERT_TRUE(test::eventually([&] { return bench.answers == 1; }));
    EXPECT_EQ(bench.begun, 2) << "the old image was denoised again";
}

} // namespace
} // namespace blush::TEST_FILE
