// All inputs of the displayed picture, as one value: the question for statistics of it.
#pragma once

#include "color/color_management.h"
#include "render/session/published_frames.h"
#include "scene/view_settings.h"
#include "ui/views/denoise_view.h"

namespace blush {

struct ShownPicture {
    FramePtr frame; // not null
    DenoisedPtr denoised;
    PictureMix mix;
    ViewSettings view;                      // with auto exposure applied
    const ColorManagement* color = nullptr; // not null; outlives all users
    bool operator==(const ShownPicture&) const = default;
};

} // namespace blush
