// How two pictures differ: a picture of it, and numbers. Takes longer than a frame of the window.
#pragma once

#include "measure/metrics.h"
#include "render/showcase.h"
#include "ui/denoise_view.h"
#include "ui/snapshots_view.h"

#include <string>
#include <vector>

namespace blush {

// B is the reference.
struct DifferenceQuestion {
    FramePtr a, b;
    DenoisedPtr denoised_a, denoised_b; // null: the raw picture is meant
    DenoiseView view;
    DifferenceKind kind = DifferenceKind::absolute;
    bool operator==(const DifferenceQuestion&) const = default;
};

struct Difference {
    std::string problem = {}; // why there is none; empty: there is
    DifferenceKind kind = DifferenceKind::absolute;
    bool has_flip = false; // numbers.flip is filled in
    Metrics numbers = {};
    int width = 0, height = 0;
    // Scene-linear, 4 values a pixel. absolute: |a - b| per channel. relative: the mean over channels of |a - b| / sqrt(b^2 + 0.01), whose
    // mean square is relmse; flip: HDR-FLIP; these two as a map from black at 0 to white at 1.
    std::vector<float> rgba = {};
};
Difference difference_of(const DifferenceQuestion& question);

// "|A - B|", ...: what the picture shows.
std::string caption_of(DifferenceKind kind);

} // namespace blush
