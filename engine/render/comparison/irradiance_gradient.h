// The translational gradient of irradiance, from the same paths as the irradiance.
#pragma once

#include "render/integrator/irradiance.h"

#include <array>

namespace blush {

// Change of the irradiance per metre, in the plane of the receiver, for each of RGB: lux / m, world space. `normal`: the receiver's.
// `nearest`: metres; surfaces closer than this count as this close.
// Ward and Heckbert 1992, "Irradiance gradients", translational part: the hemisphere is divided into rows of equal sin^2(theta) and
// columns of equal azimuth. A move turns the wall between two cells by its angle as seen from the receiver, at the distance of the nearer
// surface, since that hides the other. The cosine-distributed Sobol points of gather_indirect() have the same number in each cell if their
// number is a power of two. Walls of empty cells are left out.
std::array<Vec3d, 3> translational_gradient(const GatheredRays& rays, const Vec3& normal, double nearest);

} // namespace blush
