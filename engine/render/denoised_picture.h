// A denoised picture: made from a frame, kept beside it, never in its place.
#pragma once

#include "render/denoiser.h"
#include "render/frame.h"
#include "render/light_groups.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace blush {

class Workers;

// The planes of a frame's light groups, each denoised by itself, so that they can be mixed anew: width * height * 3 values each.
struct DenoisedGroups {
    std::shared_ptr<const LightGroups> of;
    std::vector<std::vector<float>> planes;
};

// Never modified after publishing.
struct DenoisedPicture {
    // Of the frame that it was made from.
    uint64_t revision = 0;
    int width = 0, height = 0, divider = 1;
    int64_t samples = 0;
    double rendered_seconds = 0;

    DenoiseQuality quality = DenoiseQuality::fast;
    Denoised denoised; // of the whole picture; of groups, the sum of what they were denoised to, each times its gain
    std::shared_ptr<const DenoisedGroups> groups; // null: it was denoised as a whole
    Gains gains;                                  // of the groups
};
using DenoisedPtr = std::shared_ptr<const DenoisedPicture>;

// The frame's planes as the denoiser reads them: of the whole picture, or, if there are groups of lights, of each of them before its gain.
// They point into the frame.
std::vector<DenoiseInput> denoise_inputs(const Frame& frame);

// Of what denoise_inputs() were denoised to; groups are mixed with the frame's gains.
DenoisedPtr denoised_picture(const Frame& source, DenoiseQuality quality, std::vector<Denoised> denoised);
// The same with other gains.
DenoisedPtr remixed(const DenoisedPicture& picture, const Gains& gains);
// Its groups, each denoised alone; it must have some.
std::vector<std::span<const float>> planes_of(const DenoisedPicture& picture);
// Its pixels with other gains, width * height * 3; it must have groups.
std::vector<float> mixed_rgb(const DenoisedPicture& picture, std::span<const Vec3> gains, const Workers* workers = nullptr);

// By how many per cent the denoiser changed the mean luminance; 0 where there was none.
double energy_change_percent(const Denoised& denoised);

std::string_view to_string(DenoiseQuality quality); // "fast", "base", "high"

} // namespace blush
