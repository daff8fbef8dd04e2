// The irradiance cache: indirect irradiance at a few points, interpolated between them (Ward, Rubinstein and Clear 1988, "A ray tracing
// solution for diffuse interreflection"), with its gradients (Ward and Heckbert 1992). The records are made before the first
// sample, level by level over the picture, so that they do not depend on threads; where none is near, paths are traced.
#pragma once

#include "render/comparison/comparison_integrator.h"
#include "render/comparison/indirect_light.h"

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>

namespace blush {

struct IrradianceRecord {
    Vec3d position, normal;
    double radius = 1;               // harmonic mean of the distances that its paths see, metres
    std::array<Vec3d, 3> flux{};     // RGB; the irradiance for a normal n nearby is its product with n
    std::array<Vec3d, 3> gradient{}; // RGB; change of the irradiance per metre, by irradiance_gradient.h
    // Extrapolated to another point and normal; never negative.
    Vec3d irradiance(const Vec3d& at, const Vec3d& n) const;
    // Inverse of Ward's estimate of the error at another point; 0 if that lies behind.
    double weight(const Vec3d& at, const Vec3d& n) const;
};

class IrradianceCache : public IndirectLight {
public:
    explicit IrradianceCache(const ComparisonIntegrator& options) : options_(options) {}
    bool prepare(const PreparationContext& context) override;
    void irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                    std::span<Vec3d> out) const override;
    size_t memory_bytes() const override { return records_.capacity() * sizeof(IrradianceRecord); }
    size_t size() const { return records_.size(); }

private:
    // Records of similar size, by cells at least as large as twice their reach: those that reach a point are in eight cells.
    using Cells = std::unordered_map<uint64_t, std::vector<uint32_t>>;
    bool is_covered(const DiffusePoint& point) const;
    // Sums over all records that reach a point: weights, and irradiances times weights.
    struct Interpolated {
        double weight = 0;
        Vec3d sum{0, 0, 0};
    };
    Interpolated interpolate(const DiffusePoint& point) const;
    IrradianceRecord measure(const KernelContext& context, const DiffusePoint& point, uint32_t replicate, TileScratch& scratch) const;
    void insert(const IrradianceRecord& record);
    bool add_records(const PreparationContext& context, const std::vector<DiffusePoint>& points);

    ComparisonIntegrator options_;
    double extent_ = 1; // radius of the scene
    std::vector<IrradianceRecord> records_;
    std::map<int, Cells> levels_; // by the exponent of the cell's size
    uint32_t measured_ = 0;
};

} // namespace blush
