// How raw and denoised image are shown: either, a blend, or their difference. Does not restart the render.
#pragma once

#include "render/frame.h"
#include "render/session/denoised_image.h"

#include <string>
#include <vector>

namespace blush {

struct DenoiseView {
    enum class Show { raw, denoised, blend, difference };
    Show show = Show::raw;
    float blend = 0.5f; // 0 raw, 1 denoised

    bool wants_denoised() const { return show != Show::raw; }
    void toggle() { show = wants_denoised() ? Show::raw : Show::denoised; }
    bool operator==(const DenoiseView&) const = default;
};

// Weights of the displayed combination, in scene-linear values: |raw_weight raw + denoised_weight denoised|.
struct ImageMix {
    float raw_weight = 1, denoised_weight = 0;
    bool operator==(const ImageMix&) const = default;
};
// Without a denoised image the raw one is shown.
ImageMix mix_of(const DenoiseView& view, bool has_denoised);

// The pixel of the (possibly coarser) denoised image at pixel (x, y) of the frame.
Vec3 denoised_pixel(const Frame& frame, const DenoisedImage& denoised, int x, int y);
Vec3 mixed_pixel(const Frame& frame, const DenoisedImage* denoised, const ImageMix& mix, int x, int y);
// All pixels: width * height * 3.
std::vector<float> mixed_image(const Frame& frame, const DenoisedImage* denoised, const ImageMix& mix);

// "denoised", "blend 40 %, 16 spp and 1.2 s behind", "raw, denoising": which image is shown, and how far it is behind the raw
// one.
std::string shown_text(const DenoiseView& view, const Frame& frame, const DenoisedImage* denoised);

} // namespace blush
