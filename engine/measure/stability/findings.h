// From pictures to findings.
#pragma once

#include "measure/stability/irradiance.h"
#include "measure/stability/picture.h"
#include "measure/stability/verdict.h"

namespace blush::stability {

// Of grey pictures: red stands for all.
Finding compare(const Measured& seen, double expected, double rounding = 0);
// The picture's mean.
Findings whole(const Picture& picture, double expected, double rounding = 0);
// Every pixel by itself, where nothing is random.
Findings every_pixel(const Picture& picture, double expected, double rounding = 0);
// The quarters of a photograph of the floor.
Findings quarters(const Scene& scene, const FloorIrradiance& irradiance, const RenderSettings& settings = settings_for(16, 16, 64));
// Two pictures of the same thing with independent seeds, block by block of half x half pixels.
Findings same_blocks(const Picture& a, const Picture& b, int block);
// How many numbers differ at all, which none should.
Finding count_of(double wrong, std::string where = {});

} // namespace blush::stability
