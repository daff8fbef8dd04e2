// Looking at a raw picture and its denoised one: either, between them, or how they differ. Nothing is rendered again for it.
#pragma once

#include "render/denoised_picture.h"
#include "render/frame.h"

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

// What is shown of two pictures, in scene-linear values: |raw_weight raw + denoised_weight denoised|.
struct PictureMix {
    float raw_weight = 1, denoised_weight = 0;
    bool operator==(const PictureMix&) const = default;
};
// Without a denoised picture it is the raw one, whatever is asked for.
PictureMix mix_of(const DenoiseView& view, bool has_denoised);

// The pixel of a denoised picture, perhaps a coarser one, that answers pixel (x, y) of the frame.
Vec3 denoised_pixel(const Frame& frame, const DenoisedPicture& denoised, int x, int y);
Vec3 mixed_pixel(const Frame& frame, const DenoisedPicture* denoised, const PictureMix& mix, int x, int y);
// width * height * 3: all of them.
std::vector<float> mixed_picture(const Frame& frame, const DenoisedPicture* denoised, const PictureMix& mix);

// "denoised", "blend 40 %, 16 spp and 1.2 s behind", "raw, denoising": which picture is shown, and how far it is behind the raw one.
std::string shown_text(const DenoiseView& view, const Frame& frame, const DenoisedPicture* denoised);

} // namespace blush
