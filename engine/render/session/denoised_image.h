// A denoised image: made from a frame and kept in addition to it.
#pragma once

#include "render/denoise/denoiser.h"
#include "render/denoise/view_history.h"
#include "render/frame.h"
#include "render/light_mix/light_groups.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace blush {

class Workers;

// The planes of a frame's light groups, each denoised separately, so that they can be remixed: width * height * 3 values each.
struct DenoisedGroups {
    std::shared_ptr<const LightGroups> of;
    std::vector<std::vector<float>> planes;
};

// Never modified after publishing.
struct DenoisedImage {
    // Of the frame that it was made from.
    uint64_t revision = 0;
    int divider = 1;
    int64_t samples = 0;
    double rendered_seconds = 0;

    int width = 0, height = 0; // of the frame or, if enlarged, of its first hits
    bool is_enlarged = false;  // by first hits (joint_upsampling.h)
    DenoiseQuality quality = DenoiseQuality::fast;
    Denoised denoised;                            // of the whole image; with groups, the sum of the denoised groups, each times its gain
    std::shared_ptr<const DenoisedGroups> groups; // null: denoised as a whole
    Gains gains;                                  // of the groups

    // `denoised` mixed with denoised images of earlier views (view_history.h): only for display, never measured or saved.
    WithHistory with_history;
    bool has_history() const { return !with_history.rgb.empty(); }
    struct Displayed {
        int width, height;
        const std::vector<float>& rgb;
    };
    // With history, if it has any.
    Displayed displayed() const {
        if (has_history()) return {with_history.width, with_history.height, with_history.rgb};
        return {width, height, denoised.rgb};
    }
};
using DenoisedPtr = std::shared_ptr<const DenoisedImage>;

// The frame's planes as denoiser input: one of the whole image, or one
// for each light group before its gain. They point into the frame.
std::vector<DenoiseInput> denoise_inputs(const Frame& frame);

// Corrects the bias of one of these by its half differences (bias_correction.h), and what it says about itself. Null workers: on this
// thread.
void correct_bias_of(Denoised& denoised, const DenoiseInput& input, std::span<const Vec3> half_difference,
                     const Workers* workers = nullptr);

// Combines the results for denoise_inputs(), with their bias corrected if the frame has half differences (bias_correction.h); groups are
// mixed with the frame's gains. Enlarged by the frame's first hits, if it has them.
// Null workers: on this thread.
std::shared_ptr<DenoisedImage> denoised_image(const Frame& source, DenoiseQuality quality, std::vector<Denoised> denoised,
                                              const Workers* workers = nullptr);
// The same image with other gains.
DenoisedPtr remixed(const DenoisedImage& image, const Gains& gains);
// The same image, displayed as it is measured and saved.
DenoisedPtr without_history(const DenoisedImage& image);
// The groups, each denoised separately; it must have groups.
std::vector<std::span<const float>> planes_of(const DenoisedImage& image);
// The pixels with other gains, width * height * 3; it must have groups.
std::vector<float> mixed_rgb(const DenoisedImage& image, std::span<const Vec3> gains, const Workers* workers = nullptr);

// Relative change of the mean luminance by the denoiser, in per cent; 0 if the mean was 0.
double energy_change_percent(const Denoised& denoised);

std::string_view to_string(DenoiseQuality quality); // "fast", "base", "high"

} // namespace blush
