// Flat ambient light with ambient occlusion: the fake of a rasteriser (Zhukov, Iones and Kronin 1998, "An ambient light illumination
// model").
#pragma once

#include "render/comparison/comparison_integrator.h"
#include "render/comparison/indirect_light.h"

namespace blush {

class AmbientLight : public IndirectLight {
public:
    explicit AmbientLight(const ComparisonIntegrator& options) : options_(options), color_(options.color) {}
    bool prepare(const PreparationContext& context) override;
    // One occlusion ray for each point.
    void irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                    std::span<Vec3d> out) const override;
    size_t memory_bytes() const override { return sizeof *this; }

private:
    ComparisonIntegrator options_;
    Vec3 color_;
};

} // namespace blush
