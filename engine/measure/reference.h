// What an endless rendering would give, as nearly as it is known: made or extended here, kept on disk by whoever asks.
#pragma once

#include "measure/bias_test.h"
#include "render/renderer.h"

#include <cstdint>
#include <functional>
#include <span>

namespace blush {

struct Reference {
    MeasuredImage measured;
    int64_t first_sample = 0; // sample indices [first_sample, first_sample + measured.samples) of `seed`
    uint32_t seed = 0;
    double seconds = 0; // of rendering
};

// The settings of the picture that all ways to render `settings` should converge to: its size, filter and length of paths, with the
// strategy and the roulette that are known to be right.
RenderSettings reference_settings(const RenderSettings& settings);

// A seed that is none of those compared: their pictures would share its samples, and the reference would flatter them.
uint32_t reference_seed(std::span<const uint32_t> compared);

// The renderer's picture so far with its standard errors.
MeasuredImage measured_image(const Renderer& renderer);

// How good a reference shall be, whichever comes first; 0 means no limit.
struct ReferenceBudget {
    int64_t samples = 0; // per pixel
    double seconds = 0;  // of rendering, those of earlier runs included
};

// Adds samples to `reference` until the budget is used up, with the settings of reference_settings and the reference's own seed. What is
// there stays and counts. While `wanted`; `progress` is told of 0 .. 1.
void extend_reference(Reference& reference, Renderer& renderer, const Scene& scene, const RenderSettings& settings,
                      const ReferenceBudget& budget, const std::function<bool()>& wanted, const std::function<void(double)>& progress);

// Mean square of the standard errors of its pixels: what it may itself be off.
double mean_square_error(const MeasuredImage& image);

// A reference is clearly better than a picture if its mean squared error is a tenth or less.
bool clearly_better(double reference_mse, double image_mse);

} // namespace blush
