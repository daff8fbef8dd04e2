// A frame at half of its size, for a denoised image that comes sooner.
#pragma once

#include "render/frame.h"

#include <memory>

namespace blush {

class Workers;

// What the denoiser reads of `frame`, each pixel the mean of up to four (box filter); sides are rounded up. The depth of a pixel is the
// mean of its hits, or a miss if these are fewer. `divider` is twice that of `frame`, whose planes of albedo, normal and depth, if it has
// all three, become `first_hits`: the denoised image is enlarged by them. Null workers: on this thread. The result does not depend on the
// number of threads.
std::shared_ptr<const Frame> halved(const FramePtr& frame, const Workers* workers = nullptr);

} // namespace blush
