// Difference of two images: an image and numbers. Takes longer than one UI frame.
#pragma once

#include "measure/metrics/metrics.h"
#include "render/session/published_frames.h"
#include "ui/snapshots/snapshots_view.h"
#include "ui/views/denoise_view.h"

#include <string>
#include <vector>

namespace blush {

// B is the reference.
struct DifferenceInput {
    FramePtr a, b;
    DenoisedPtr denoised_a, denoised_b; // null: use the raw image
    DenoiseView view;
    DifferenceKind kind = DifferenceKind::absolute;
    bool operator==(const DifferenceInput&) const = default;
};

struct Difference {
    std::string problem = {}; // why there is no difference; empty: there is one
    DifferenceKind kind = DifferenceKind::absolute;
    bool has_flip = false; // numbers.flip is set
    Metrics numbers = {};
    int width = 0, height = 0;
    // Scene-linear, 4 values per pixel. absolute: |a - b| per channel. relative: mean over the channels of |a - b| / sqrt(b^2 +
    // 0.01), whose mean square is relMSE. flip: HDR-FLIP. The last two are maps from black at 0 to white at 1.
    std::vector<float> rgba = {};
};
Difference difference_of(const DifferenceInput& input);

// Caption of the image: "|A - B|", ...
std::string caption_of(DifferenceKind kind);

} // namespace blush
