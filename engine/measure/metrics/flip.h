// FLIP: perceived difference of two images when a viewer alternates between them.
//
// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for Alternating Images" (HPG 2020),
// and Andersson, Nilsson, Shirley and Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images" (Eurographics 2021). The
// viewer is the papers' default: 0.7 m away from a screen 0.7 m and 3840 pixels wide, 67 pixels per degree.
#pragma once

#include "measure/metrics/rgb_image.h"

#include <span>
#include <vector>

namespace blush {

// One value in [0, 1] per pixel. Images of the same size, finite; sRGB-encoded, clamped to [0, 1].
std::vector<float> ldr_flip(const RgbImage& reference, const RgbImage& test);

// HDR-FLIP: maximum of LDR-FLIP over exposures at most a stop apart, from the one that maps the reference's maximum just below
// white to the one that does so for its median; tone mapped with the ACES curve. Images of the same size, finite, scene-linear;
// negative values count as 0.
std::vector<float> hdr_flip(const RgbImage& reference, const RgbImage& test);

// Statistics of a FLIP map, as printed by the reference tool: quartiles are weighted by value, so that pixels without a
// difference do not dominate.
struct FlipNumbers {
    static constexpr float noticeable = 0.1f;
    double mean = 0;
    double first_quartile = 0, median = 0, third_quartile = 0; // values up to this sum to 1/4, 1/2, 3/4 of the total
    double largest = 0;
    double share_noticeable = 0; // fraction of pixels above `noticeable`, 0 .. 1
};
FlipNumbers flip_numbers(std::span<const float> map);

// The exposures that hdr_flip uses, in stops.
struct ExposureRange {
    double start = 0, stop = 0;
    int count = 1;
};
ExposureRange hdr_flip_exposures(const RgbImage& reference);

} // namespace blush
