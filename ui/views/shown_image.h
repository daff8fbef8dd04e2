// All inputs of the displayed image, as one value: the input of its statistics.
#pragma once

#include "color/color_management.h"
#include "render/session/published_frames.h"
#include "scene/view_settings.h"
#include "ui/views/denoise_view.h"

namespace blush {

struct ShownImage {
    FramePtr frame; // not null
    DenoisedPtr denoised;
    ImageMix mix;
    ViewSettings view;                      // with auto exposure applied
    const ColorManagement* color = nullptr; // not null; outlives all users
    bool operator==(const ShownImage&) const = default;
};

} // namespace blush
