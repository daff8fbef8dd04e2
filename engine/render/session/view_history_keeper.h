// The denoised image with which views of the same scene begin.
#pragma once

#include "render/denoise/view_history.h"
#include "render/frame.h"
#include "render/session/denoised_image.h"

#include <cstdint>

namespace blush {

// Keeps the last denoised image of full size. Only one thread may use it.
class ViewHistoryKeeper {
public:
    // Mixes history into the denoised image of `frame`, if it has the same look (Submission::look) and another view, and is coarse or the
    // first one of full size, before its samples have quadrupled (DenoiseCadence). Keeps one of full size, as it was denoised. Not with
    // light groups, an aperture, a transparent image, or a region.
    void follow(const FramePtr& frame, DenoisedImage& denoised, const Workers* workers);
    // Of the image that is kept; 0: none.
    uint64_t look() const { return history_.empty() ? 0 : look_; }
    // Frees the image.
    void forget() { *this = {}; }

private:
    ViewHistory history_;
    uint64_t look_ = 0;
};

} // namespace blush
