// What biased integrators put in the place of the indirect light that reaches diffuse surfaces.
#pragma once

#include "core/parallel.h"
#include "render/biased/diffuse_points.h"
#include "render/kernels/kernel.h"
#include "shading/caustic_guiding.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace blush {

// What preparation needs of the renderer.
struct PreparationContext {
    KernelContext kernel; // of the whole image, with all bounces
    const Workers& workers;
    std::span<std::unique_ptr<TileScratch>> scratch; // one per worker, made when needed
    std::function<bool()> wanted;
    CasterSphere scene; // contains all surfaces

    TileScratch& scratch_of(unsigned worker) const;
};

class IndirectLight {
public:
    virtual ~IndirectLight() = default;
    // Before the first sample of an image. False if stopped.
    virtual bool prepare(const PreparationContext& context) = 0;
    // Indirect irradiance at each point, RGB in lux, into `out`. Thread-safe with a scratch for each thread.
    virtual void irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                            std::span<Vec3d> out) const = 0;
    virtual size_t memory_bytes() const = 0;
};

} // namespace blush
