#include "render/session/frame_pool.h"

#include <utility>

namespace blush {
namespace {

// One is shown, one is being written, and a reader may still hold the previous one.
constexpr size_t max_kept = 3;

} // namespace

std::shared_ptr<Frame> FramePool::take() {
    std::unique_ptr<Frame> frame;
    {
        const std::lock_guard lock(shelf_->mutex);
        if (!shelf_->frames.empty()) {
            frame = std::move(shelf_->frames.back());
            shelf_->frames.pop_back();
        }
    }
    if (!frame) frame = std::make_unique<Frame>();
    // The mutex orders all reads of the old image before the first write of the new one.
    const auto give_back = [shelf = shelf_](Frame* done) {
        std::unique_ptr<Frame> returned(done);
        returned->first_hits.reset(); // they may keep another frame from being returned
        const std::lock_guard lock(shelf->mutex);
        if (shelf->frames.size() < max_kept) shelf->frames.push_back(std::move(returned));
    };
    return {frame.release(), give_back};
}

} // namespace blush
