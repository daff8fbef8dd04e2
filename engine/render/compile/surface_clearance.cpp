#include "render/compile/surface_clearance.h"

#include "render/compile/scene_origin.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>

namespace blush {

double surface_clearance(const Scene& scene, const RayHit& hit) {
    const Vec3d origin = render_origin(world_bounds(scene));
    double largest = hit.largest_term;
    for (const Vec3d& corner : hit.corners) {
        const Vec3d p = corner - origin;
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest * 0x1p-19;
}

} // namespace blush
