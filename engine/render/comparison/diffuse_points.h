// The first surfaces of camera paths that reflect diffusely: where biased integrators need the indirect light.
#pragma once

#include "core/sampler.h"
#include "render/integrator/irradiance.h"
#include "render/kernels/kernel.h"

#include <vector>

namespace blush {

// The first surface of a camera path, if it is diffuse.
struct DiffusePoint {
    MeterPoint receiver;
    Vec3 reflects; // radiance towards the camera per irradiance: throughput times albedo / pi, per sr
    Sampler<float> sampler;
    int slot = 0; // of the tile
};

// The diffuse points among the first hits of a tile's paths. Overwrites `scratch`.
void find_diffuse_points(const KernelContext& context, const TileJob& job, TileScratch& scratch, std::vector<DiffusePoint>& points);

} // namespace blush
