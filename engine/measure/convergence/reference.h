// Reference images: renders or extends an approximation of the converged image. Callers store it.
#pragma once

#include "measure/statistics/bias_test.h"
#include "render/renderer.h"

#include <cstdint>
#include <functional>
#include <span>

namespace blush {

struct Reference {
    MeasuredImage measured;
    int64_t first_sample = 0; // sample indices [first_sample, first_sample + measured.samples) of `seed`
    uint32_t seed = 0;
    double seconds = 0; // render time
};

// Settings of the image that all render options should converge to: size, filter and maximum bounces of `settings`, with a
// strategy and Russian roulette that are known to be unbiased.
RenderSettings reference_settings(const RenderSettings& settings);

// A seed that differs from those compared: shared samples would make the compared images look better than they are.
uint32_t reference_seed(std::span<const uint32_t> compared);

// The renderer's current image with its standard errors.
MeasuredImage measured_image(Renderer& renderer);

// Budget of a reference; the first limit that is reached ends it. 0 means no limit.
struct ReferenceBudget {
    int64_t samples = 0; // per pixel
    double seconds = 0;  // render time, including earlier runs
};

// Adds samples to `reference` until the budget is used up, with reference_settings and the reference's seed. Existing samples are
// kept and counted. Stops when `wanted` returns false; reports `progress` 0 .. 1.
void extend_reference(Reference& reference, Renderer& renderer, const Scene& scene, const RenderSettings& settings,
                      const ReferenceBudget& budget, const std::function<bool()>& wanted, const std::function<void(double)>& progress);

// Mean square of the standard errors of the pixels: estimate of the image's own MSE.
double mean_square_error(const MeasuredImage& image);

// True if the reference's MSE is at most a tenth of the image's.
bool clearly_better(double reference_mse, double image_mse);

} // namespace blush
