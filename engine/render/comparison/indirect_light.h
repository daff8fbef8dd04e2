// What integrators for comparison put in the place of path tracing: of all of it behind the emission that the camera sees, or of the
// indirect light that reaches diffuse surfaces.
#pragma once

#include "core/parallel.h"
#include "render/comparison/diffuse_points.h"
#include "render/film/splat.h"
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

class PathReplacement {
public:
    virtual ~PathReplacement() = default;
    // Bounces that the path tracer still renders: with 0 the emission that the camera sees, with 1 direct light, too.
    virtual int traced_bounces() const = 0;
    // Before the first sample of an image. False if stopped.
    virtual bool prepare(const PreparationContext& context) = 0;
    // True if each sample needs a preparation of its own: samples are then rendered one after the other.
    virtual bool prepares_samples() const { return false; }
    virtual bool prepare_sample(int64_t /*sample*/, const PreparationContext& /*context*/) { return true; }
    // True if pixels of a sample share random numbers, so that their errors are correlated.
    virtual bool correlates_pixels() const { return false; }
    // Adds the radiance of the job's paths to `tile`. `context` has all bounces; `scratch` is memory. Thread-safe with one for each thread.
    virtual void add(const KernelContext& /*context*/, const TileJob& /*job*/, TileScratch& /*tile*/, TileScratch& /*scratch*/) const {}
    // True if each sample of the image has a pass that adds radiance to any of its pixels.
    virtual bool splats() const { return false; }
    // The splats of sample `sample`, in lists of a fixed order. False if stopped.
    virtual bool trace_pass(int64_t /*sample*/, const PreparationContext& /*context*/, std::vector<std::vector<Splat>>& /*tiles*/) {
        return true;
    }
    virtual size_t memory_bytes() const = 0;
};

class IndirectLight : public PathReplacement {
public:
    int traced_bounces() const final { return 1; }
    void add(const KernelContext& context, const TileJob& job, TileScratch& tile, TileScratch& scratch) const final;
    // Indirect irradiance at each point, RGB in lux, into `out`. Thread-safe with a scratch for each thread.
    virtual void irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                            std::span<Vec3d> out) const = 0;
};

} // namespace blush
