// A denoised picture: made from a frame, kept beside it, never in its place.
#pragma once

#include "render/denoiser.h"
#include "render/frame.h"

#include <cstdint>
#include <memory>

namespace blush {

// Never modified after publishing.
struct DenoisedPicture {
    // Of the frame that it was made from.
    uint64_t revision = 0;
    int width = 0, height = 0, divider = 1;
    int64_t samples = 0;
    double rendered_seconds = 0;

    DenoiseQuality quality = DenoiseQuality::fast;
    Denoised denoised;
};
using DenoisedPtr = std::shared_ptr<const DenoisedPicture>;

// The frame's planes as the denoiser reads them. Points into the frame.
DenoiseInput denoise_input(const Frame& frame);

DenoisedPtr denoised_picture(const Frame& source, DenoiseQuality quality, Denoised denoised);

// By how many per cent the denoiser changed the mean luminance; 0 where there was none.
double energy_change_percent(const Denoised& denoised);

std::string_view to_string(DenoiseQuality quality); // "fast", "base", "high"

} // namespace blush
