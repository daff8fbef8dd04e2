#include "render/session/published_frames.h"

#include <utility>

namespace blush {

void PublishedFrames::show(uint64_t image, FramePtr frame) {
    if (image != image_) shown_.denoised.reset();
    image_ = image;
    shown_.frame = std::move(frame);
    withheld_.reset();
}

void PublishedFrames::withhold(uint64_t image, FramePtr frame) {
    withheld_image_ = image;
    withheld_ = std::move(frame);
}

void PublishedFrames::release() {
    if (withheld_) show(withheld_image_, std::move(withheld_));
}

void PublishedFrames::replace(const DenoisedPtr& shown, DenoisedPtr by) {
    if (shown_.denoised == shown) shown_.denoised = std::move(by);
}

void PublishedFrames::answer(uint64_t image, const FramePtr& source, DenoisedPtr denoised) {
    if (withheld_ == source) {
        show(image, source);
    } else if (denoised && image > image_) {
        // The drag is faster than the denoiser: show the previous withheld frame, because otherwise nothing would appear.
        FramePtr newer = std::move(withheld_);
        show(image, source);
        withheld_ = std::move(newer);
    }
    if (denoised && image == image_) shown_.denoised = std::move(denoised);
}

} // namespace blush
