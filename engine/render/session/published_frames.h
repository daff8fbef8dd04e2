// The published frame and its denoised version.
#pragma once

#include "render/frame.h"
#include "render/session/denoised_image.h"

#include <cstdint>

namespace blush {

struct Images {
    FramePtr frame;       // null before the first
    DenoisedPtr denoised; // of the same image as the frame, possibly with fewer samples or lower resolution; null: none yet
};

// During a slider drag, images change constantly. Showing each first frame before its denoised version would flicker between
// noisy and clean, so a frame may be withheld until it is denoised. `image` counts images and never decreases.
class PublishedFrames {
public:
    const Images& images() const { return shown_; }

    void show(uint64_t image, FramePtr frame);
    // Shows the frame when its denoised version arrives, unless another frame is shown before.
    void withhold(uint64_t image, FramePtr frame);
    // `denoised` was made from `source`; null if it was skipped.
    void answer(uint64_t image, const FramePtr& source, DenoisedPtr denoised);
    // Replaces a denoised image if it is still shown.
    void replace(const DenoisedPtr& shown, DenoisedPtr by);
    // Shows the withheld frame: its denoised version will not come.
    void release();

private:
    Images shown_;
    uint64_t image_ = 0; // of the shown frame
    FramePtr withheld_;
    uint64_t withheld_image_ = 0;
};

} // namespace blush
