#include "render/session/frame_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace blush::TEST_FILE {
namespace {

TEST(FramePool, AFrameIsRecycledWhenItsLastReferenceIsDropped) {
    FramePool pool;
    std::shared_ptr<Frame> first = pool.take();
    const Frame* const memory = first.get();
    FramePtr looking = first;
    first.reset();
    EXPECT_NE(pool.take().get(), memory);
    looking.reset();
    std::set<const Frame*> next;
    std::vector<std::shared_ptr<Frame>> held;
    for (int i = 0; i < 2; ++i) {
        held.push_back(pool.take());
        next.insert(held.back().get());
    }
    EXPECT_TRUE(next.contains(memory)) << "memory is reused";
}

TEST(FramePool, FramesMayOutliveIt) {
    FramePtr frame;
    {
        FramePool pool;
        const std::shared_ptr<Frame> taken = pool.take();
        taken->samples = 7;
        frame = taken;
    }
    EXPECT_EQ(frame->samples, 7);
}

TEST(FramePool, KeepsALimitedNumberOfFrames) {
    FramePool pool;
    std::vector<std::shared_ptr<Frame>> held;
    for (int i = 0; i < 20; ++i) {
        held.push_back(pool.take());
        held.back()->samples = 1;
    }
    held.clear();
    int kept = 0;
    for (int i = 0; i < 20; ++i) {
        held.push_back(pool.take());
        kept += held.back()->samples == 1;
    }
    EXPECT_GT(kept, 0);
    EXPECT_LT(kept, 5);
}

// For the race detector: one thread writes frames, another reads them and drops the last reference.
TEST(FramePool, ReadersFinishBeforeAFrameIsRewritten) {
    FramePool pool;
    std::mutex mutex; // of `shown`, as in the session
    FramePtr shown;
    std::atomic<bool> done{false};
    std::thread reader([&] {
        while (!done) {
            FramePtr frame;
            {
                const std::lock_guard lock(mutex);
                frame = shown;
            }
            if (!frame) continue;
            ASSERT_EQ(frame->rgba.size(), 64u);
            for (const float v : frame->rgba) ASSERT_EQ(v, frame->rgba[0]);
        }
    });
    for (int i = 0; i < 2000; ++i) {
        std::shared_ptr<Frame> frame = pool.take();
        frame->rgba.assign(64, float(i));
        const std::lock_guard lock(mutex);
        shown = std::move(frame);
    }
    done = true;
    reader.join();
}

} // namespace
} // namespace blush::TEST_FILE
