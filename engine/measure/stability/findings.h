// Converts rendered images to findings.
#pragma once

#include "measure/stability/irradiance.h"
#include "measure/stability/rendered_image.h"
#include "measure/stability/verdict.h"

namespace blush::stability {

// For grey images: only the red channel is used.
Finding compare(const Measured& seen, double expected, double rounding = 0);
// Mean of the image.
Findings whole(const RenderedImage& image, double expected, double rounding = 0);
// Each pixel separately, for images without noise.
Findings every_pixel(const RenderedImage& image, double expected, double rounding = 0);
// The quarters of an image of the floor.
Findings quarters(const Scene& scene, const FloorIrradiance& irradiance, const RenderSettings& settings = settings_for(16, 16, 64));
// Two images of a scene with independent seeds, compared in blocks of half x half pixels.
Findings same_blocks(const RenderedImage& a, const RenderedImage& b, int block);
// Number of differing values, which must be 0.
Finding count_of(double wrong, std::string where = {});

} // namespace blush::stability
