// All that makes the picture on the screen what it is, as one value: what figures about it are asked of.
#pragma once

#include "color/color_management.h"
#include "render/showcase.h"
#include "scene/view_settings.h"
#include "ui/denoise_view.h"

namespace blush {

struct ShownPicture {
    FramePtr frame; // not null
    DenoisedPtr denoised;
    PictureMix mix;
    ViewSettings view;                      // with auto exposure settled
    const ColorManagement* color = nullptr; // not null; outlives all who ask
    bool operator==(const ShownPicture&) const = default;
};

} // namespace blush
