// What biased integrators put in the place of the indirect light that reaches diffuse surfaces.
#pragma once

#include "core/parallel.h"
#include "core/sampler.h"
#include "render/biased/biased_integrator.h"
#include "render/integrator/irradiance.h"
#include "render/kernels/kernel.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace blush {

// The first surface of a camera path, if it is diffuse.
struct DiffusePoint {
    MeterPoint receiver;
    Vec3 reflects; // radiance towards the camera per irradiance: throughput times albedo / pi, per sr
    Sampler<float> sampler;
    int slot = 0; // of the tile
};

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
// Null for path tracing.
std::unique_ptr<IndirectLight> make_indirect_light(const BiasedIntegrator& integrator);

// The diffuse points among the first hits of a tile's paths. Overwrites `scratch`.
void find_diffuse_points(const KernelContext& context, const TileJob& job, TileScratch& scratch, std::vector<DiffusePoint>& points);

// Adds what the tile's diffuse surfaces reflect. `context` has all bounces; `points` and `scratch` are memory.
void add_indirect_light(const KernelContext& context, const IndirectLight& light, const TileJob& job, TileScratch& tile,
                        TileScratch& scratch);

} // namespace blush
