// Progressive photon mapping (Hachisuka, Ogaki and Jensen 2008, "Progressive photon mapping"), in the form without memory of Knaus and
// Zwicker 2011, "Progressive photon mapping: a probabilistic approach": each sample has a photon map of its own, whose disks shrink from
// sample to sample, and the image is the mean of all. Consistent: the bias of the disks and the noise of the photons both vanish.
//
// A camera path goes on through mirrors and glass to the first surfaces that scatter, where the photons around give all light that
// arrives, direct light and caustics included. Nothing aims at lights.
#pragma once

#include "render/comparison/photons.h"

namespace blush {

class ProgressivePhotonMap : public PathReplacement {
public:
    explicit ProgressivePhotonMap(const ComparisonIntegrator& options) : options_(options) {}
    int traced_bounces() const override { return 0; }
    bool prepare(const PreparationContext& context) override;
    bool prepares_samples() const override { return true; }
    bool correlates_pixels() const override { return true; } // by photons
    bool prepare_sample(int64_t sample, const PreparationContext& context) override;
    void add(const KernelContext& context, const TileJob& job, TileScratch& tile, TileScratch& scratch) const override;
    size_t memory_bytes() const override { return photons_.memory_bytes(); }

private:
    // Radiance towards the camera, times the throughput of the path, from the photons around its hit.
    Vec3d reflected(const KernelContext& context, const Path<float>& path, const Hit<float>& hit, int bounce) const;

    ComparisonIntegrator options_;
    double first_radius_ = 1, radius_ = 1; // metres
    PhotonGrid photons_;                   // of the sample
};

// Radius for sample `sample` (0, 1, ...): r_1 at sample 0, and r_(i+1)^2 = r_i^2 (i + alpha) / (i + 1) (Knaus and Zwicker
// 2011). Variance grows slower than samples for alpha > 0, the radius falls for alpha < 1.
double progressive_radius(double first, double alpha, int64_t sample);

} // namespace blush
