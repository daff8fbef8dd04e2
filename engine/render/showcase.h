// What the outside sees of a session: the newest frame, and the newest denoised picture of the same image.
#pragma once

#include "render/denoised_picture.h"
#include "render/frame.h"

#include <cstdint>

namespace blush {

struct Pictures {
    FramePtr frame;       // null before the first
    DenoisedPtr denoised; // of the same image as the frame, perhaps of fewer samples or coarser; null: none yet
};

// While somebody drags a slider, each image lives for a moment. If its first frame were shown before its denoised picture, the window
// would flicker between noise and no noise: so a frame may be withheld until it is answered. `image` counts images and never falls.
class Showcase {
public:
    const Pictures& pictures() const { return shown_; }

    void show(uint64_t image, FramePtr frame);
    // Shown when it is answered, unless another frame is shown before.
    void withhold(uint64_t image, FramePtr frame);
    // `denoised` was made from `source`; null if it was not to be.
    void answer(uint64_t image, const FramePtr& source, DenoisedPtr denoised);
    // Shows another version of a denoised picture, if that is still on show.
    void replace(const DenoisedPtr& shown, DenoisedPtr by);
    // No answer will come: shows what is withheld.
    void release();

private:
    Pictures shown_;
    uint64_t image_ = 0; // of what is shown
    FramePtr withheld_;
    uint64_t withheld_image_ = 0;
};

} // namespace blush
