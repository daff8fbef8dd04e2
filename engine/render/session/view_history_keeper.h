// The denoised image with which views of the same scene begin.
#pragma once

#include "render/denoise/view_history.h"
#include "render/frame.h"
#include "render/session/denoised_image.h"

#include <cstddef>
#include <cstdint>

namespace blush {

// Keeps the last denoised image of full size. Only one thread may use it.
class ViewHistoryKeeper {
public:
    // 3840 x 2160: 400 MB.
    static constexpr size_t default_most_pixels = size_t(1) << 23;
    static constexpr int64_t most_samples = 4; // of full size: from these on no history is mixed in
    // `most_pixels`: larger images are not kept, so that memory is bounded.
    explicit ViewHistoryKeeper(size_t most_pixels = default_most_pixels) : most_pixels_(most_pixels) {}

    // Mixes history into the denoised image of `frame`, if it has the same look (Submission::look) and another view, and is coarse, or
    // incomplete and of full size with fewer than `most_samples`. Keeps one of full size, as it was denoised. Not with light groups, an
    // aperture, a transparent image, or a region.
    void follow(const FramePtr& frame, DenoisedImage& denoised, const Workers* workers);
    // Of the image that is kept; 0: none.
    uint64_t look() const { return history_.empty() ? 0 : look_; }
    // Frees the image.
    void forget() { history_ = {}; }

private:
    size_t most_pixels_;
    ViewHistory history_;
    uint64_t look_ = 0; // of the last frame
};

} // namespace blush
