// Learns what paths are worth, for Russian roulette.
#pragma once

#include "render/lights/continuation_trial.h"
#include "scene/render_settings.h"
#include "shading/learned_adjoint.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// The image as a pilot sees it at a low resolution.
struct AdjointImage {
    int width = 0, height = 0, samples = 0;
    std::vector<float> luminance; // of each sample of each pixel, row by row: nits
    double rays = 0;              // of all samples; shadow rays count shadow_ray_cost
};

// The tables of the learned rules, from the trials of a pilot. With the throughput beta, the luminance I of the pixel, and in a cell the
// mean E[L], the second moment E[L^2] and the variance V[L] of the light that paths find behind it, for E[R] rays:
//
//   adjoint:    q = beta E[L] / I                               (Vorba and Krivanek 2016)
//   efficiency: q = beta / I sqrt(E[L^2] / E[R]) / sqrt(V / C)  (Rath et al. 2022)
//   splitting:  q of efficiency for paths that leave a vertex, and
//               n = beta / I sqrt(V[L] / E[W]) / sqrt(V / C)    copies of those that arrive at one
//
// where V is the relative variance of one sample of a pixel and C its rays, means over the image, and W the work of a copy: its rays, and
// the part of a vertex that copies do not share. Values hold all but beta / I.
//
// Where a cell has few trials, its moments are drawn towards those of the cell over all sides, of the 4x4x4 cells around, and of the whole
// scene. Pixels are means over their neighbours. The result does not depend on the order of the trials beyond rounding.
class AdjointField {
public:
    static constexpr int cells_along_longest = 16;

    AdjointField() = default;
    // `rule`: a learned one. `arrivals`: trials of paths that arrive at a surface, with the direction back along them as normal; read only
    // by splitting. Trials and samples that are not finite are ignored. Empty if no light was found.
    AdjointField(Roulette::Rule rule, std::span<const ContinuationTrial> trials, std::span<const ContinuationTrial> arrivals,
                 const AdjointImage& image);

    // For a film of this size; valid as long as this object.
    AdjointTables tables(int width, int height) const;
    bool empty() const { return values_.empty(); }
    bool splits() const { return !splits_.empty(); }
    int64_t memory_bytes() const { return int64_t((values_.capacity() + splits_.capacity() + importances_.capacity()) * sizeof(float)); }
    // Of the image of the pilot: mean over pixels of the relative variance of a sample, and its rays.
    double relative_variance() const { return relative_variance_; }
    double rays_per_sample() const { return rays_per_sample_; }
    bool operator==(const AdjointField&) const = default;

private:
    void measure_image(const AdjointImage& image);
    void learn_values(Roulette::Rule rule, std::span<const ContinuationTrial> trials);
    void learn_splits(std::span<const ContinuationTrial> arrivals);
    // sqrt(C / V), which turns the noise of a path over its work into a number of paths.
    double noise_scale() const;

    ReceiverGrid grid_;
    std::vector<float> values_, splits_, importances_;
    int across_ = 0, down_ = 0;
    double relative_variance_ = 0, rays_per_sample_ = 0;
};

} // namespace blush
