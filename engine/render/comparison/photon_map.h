// The photon map (Jensen 1996, "Global illumination using photon maps"): the density of photons over a disk around a point as the indirect
// irradiance there or, with a final gather, at the surfaces that reflect the indirect light to it. Consistent: right in the limit of many
// photons and small disks.
#pragma once

#include "render/comparison/photons.h"

namespace blush {

class PhotonMap : public IndirectLight {
public:
    explicit PhotonMap(const ComparisonIntegrator& options) : options_(options) {}
    bool prepare(const PreparationContext& context) override;
    void irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                    std::span<Vec3d> out) const override;
    size_t memory_bytes() const override { return photons_.memory_bytes(); }
    size_t size() const { return photons_.size(); }

private:
    // Irradiance at a point by its photons.
    Vec3d density(const Vec3d& at, const Vec3d& normal) const;
    // Final gather: the mean of what the map finds along rays.
    Vec3d gather(const KernelContext& context, const DiffusePoint& point, TileScratch& scratch) const;

    ComparisonIntegrator options_;
    double radius_ = 1; // metres
    PhotonGrid photons_;
};

} // namespace blush
