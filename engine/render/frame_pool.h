// Memory of pictures, used again: a frame comes back when the last look at it ends, on whichever thread that is.
#pragma once

#include "render/frame.h"

#include <memory>
#include <mutex>
#include <vector>

namespace blush {

class FramePool {
public:
    // A frame that nobody else sees, holding whatever an earlier one held. May outlive the pool. Thread-safe.
    std::shared_ptr<Frame> take();

private:
    struct Shelf {
        std::mutex mutex;
        std::vector<std::unique_ptr<Frame>> frames;
    };
    std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

} // namespace blush
