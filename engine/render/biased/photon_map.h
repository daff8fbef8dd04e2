// The photon map (Jensen 1996, "Global illumination using photon maps"): flux of light paths that arrives at surfaces, and its density over
// a disk around a point as the indirect irradiance there or, with a final gather, at the surfaces that reflect the indirect light to it.
// Consistent: right in the limit of many photons and small disks.
#pragma once

#include "render/biased/biased_integrator.h"
#include "render/biased/indirect_light.h"

#include <cstdint>
#include <unordered_map>

namespace blush {

struct Photon {
    Vec3 position, towards; // towards: unit, against the flight
    Vec3 flux;              // lm, RGB
    bool direct = false;    // no surface has scattered it
};

class PhotonMap : public IndirectLight {
public:
    explicit PhotonMap(const BiasedIntegrator& options) : options_(options) {}
    bool prepare(const PreparationContext& context) override;
    void irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                    std::span<Vec3d> out) const override;
    size_t memory_bytes() const override { return photons_.capacity() * sizeof(Photon); }
    size_t size() const { return photons_.size(); }

private:
    struct Range {
        size_t begin = 0, end = 0;
    };
    void sort_by_cells();
    // Irradiance at a point by its photons, with or without those that come from a light directly.
    Vec3d density(const Vec3d& at, const Vec3d& normal, bool with_direct) const;
    // Final gather: the mean of what the map finds along rays.
    Vec3d gather(const KernelContext& context, const DiffusePoint& point, TileScratch& scratch) const;

    BiasedIntegrator options_;
    double radius_ = 1;           // metres
    std::vector<Photon> photons_; // by cell
    std::unordered_map<uint64_t, Range> cells_;
};

} // namespace blush
