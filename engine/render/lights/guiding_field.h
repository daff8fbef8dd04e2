// Learns from photons in which directions caustics arrive at each region of the scene (shading/path_guiding.h).
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/lights/guiding_trial.h"
#include "shading/path_guiding.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace blush {

// The grid has up to 192 cells along its longest side: as many as make no more than 64^3 in all, so the grid of a floor is finer than
// that of a room. A region is a cell with one of six sides; where few photons arrived, a cube of 2^3, 4^3 or 8^3 cells instead. A quadrant
// of its quadtree has a probability in proportion to the flux of its photons, and is split while it has enough of them.
//
// Let a caustic of irradiance E have the learned density p over directions, and the other light the second moment m. With directions of
// density q, which has the learned part s p, the second moment of an estimate is about m (1 - c) / (1 - s) + E^2 <p / q>, the mean over
// photons, where c is the share that caustic casters guide without a field. Photons estimate it without the heavy tail of paths, which
// seldom meet a caustic. The share s is about that of the least sum: s / (1 - s) = k E / sqrt(m).
//
// The result does not depend on the number of threads, and scales exactly with powers of two.
class GuidingField {
public:
    GuidingField() = default;
    // `photons`: the sum of their flux is `emitted` times the flux that arrives. `paths`: their values estimate the irradiance from
    // other surfaces, sampled with `casters`. Nothing if `wanted` returned false meanwhile; an empty `wanted` never does.
    static std::optional<GuidingField> learn(std::span<const GuidingTrial> photons, int64_t emitted, std::span<const GuidingTrial> paths,
                                             const CausticCasterTables& casters, const Workers& workers,
                                             const std::function<bool()>& wanted);

    // Valid as long as this object. Without roots if no region has learned anything.
    GuidingTables tables() const;
    // Expected variance of path vertices in the regions, with over without the field. Empty if no path met a region.
    const std::optional<PilotFigures>& figures() const { return figures_; }
    bool operator==(const GuidingField&) const = default;
    // True if no region has learned anything.
    bool empty() const { return regions_ == 0; }
    // For a scene that has changed since: multiplies the shares of learned directions by `factor`, in [0, 1]. Regions with a small rest
    // forget what they have learned: caustic casters are of more use there.
    void weaken(double factor);
    // Forgets what the regions have learned in cells that this box meets; coordinates as those of the photons.
    void forget(const Vec3& low, const Vec3& high);
    // Forgets all of it, but for its figures, and frees the memory.
    void release();
    int64_t memory_bytes() const {
        return int64_t((roots_.capacity() + nodes_.capacity()) * sizeof(int32_t) +
                       (shares_.capacity() + guided_.capacity()) * sizeof(float));
    }

private:
    // False if `wanted` returned false.
    bool build(std::span<const GuidingTrial> photons, int64_t emitted, std::span<const GuidingTrial> paths,
               const CausticCasterTables& casters, const Workers& workers, const std::function<bool()>& wanted);
    void forget_cell(size_t cell);

    ReceiverGrid grid_;
    std::vector<int32_t> roots_, nodes_;
    std::vector<float> shares_, guided_;
    std::optional<PilotFigures> figures_;
    int64_t regions_ = 0; // cells and sides that have learned something
};

} // namespace blush
