// How far from a surface a point has to be for rays that begin there.
#pragma once

#include "scene/geometry/ray_queries.h"

namespace blush {

// Offset in metres that keeps the origin of a ray off the surface in the renderer's single precision: hit points are off by at most 2^-21
// of the coordinates that they are computed from (render/integrator/surface.h); four times that.
double surface_clearance(const Scene& scene, const RayHit& hit);

} // namespace blush
