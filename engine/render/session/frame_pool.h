// Recycles the memory of frames: a frame returns when its last reference is dropped, on any thread.
#pragma once

#include "render/frame.h"

#include <memory>
#include <mutex>
#include <vector>

namespace blush {

class FramePool {
public:
    // Returns an exclusive frame with arbitrary old contents. It may outlive the pool. Thread-safe.
    std::shared_ptr<Frame> take();

private:
    struct Shelf {
        std::mutex mutex;
        std::vector<std::unique_ptr<Frame>> frames;
    };
    std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

} // namespace blush
