// A grid of light probes: the radiance around each grid point in spherical harmonics of 2nd order (Ramamoorthi and Hanrahan 2001, "An
// efficient representation for irradiance environment maps"), interpolated between the eight nearest. Probes do not know of walls
// between them and a surface, nor of objects that move after they were made.
#pragma once

#include "render/comparison/comparison_integrator.h"
#include "render/comparison/indirect_light.h"

#include <array>

namespace blush {

// The nine real spherical harmonics up to order 2 in a unit direction: Y_00, Y_1-1, Y_10, Y_11, Y_2-2, Y_2-1, Y_20, Y_21, Y_22.
std::array<double, 9> spherical_harmonics(const Vec3d& direction);

struct LightProbe {
    std::array<Vec3d, 9> radiance{}; // coefficients, in nits
    // Equation 7 of the paper; not negative.
    Vec3d irradiance(const Vec3d& normal) const;
};

class LightProbes : public IndirectLight {
public:
    explicit LightProbes(const ComparisonIntegrator& options) : options_(options) {}
    bool prepare(const PreparationContext& context) override;
    void irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                    std::span<Vec3d> out) const override;
    size_t memory_bytes() const override { return probes_.capacity() * sizeof(LightProbe); }

private:
    int side() const { return options_.grid + 1; }
    LightProbe measure(const KernelContext& context, int64_t index, TileScratch& scratch) const;

    ComparisonIntegrator options_;
    Vec3d corner_{0, 0, 0};
    double cell_ = 1; // metres
    std::vector<LightProbe> probes_;
};

} // namespace blush
