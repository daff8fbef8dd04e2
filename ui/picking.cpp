#include "ui/picking.h"

#include "core/math.h"

#include <algorithm>

namespace blush {

Picked pick(const Frame& frame, double u, double v) {
    Picked picked;
    if (frame.width <= 0 || frame.height <= 0 || u < 0 || u >= 1 || v < 0 || v >= 1) return picked;
    const int x = std::min(int(u * frame.width), frame.width - 1), y = std::min(int(v * frame.height), frame.height - 1);
    const size_t i = size_t(y) * size_t(frame.width) + size_t(x);
    if (i < frame.object_id.size()) picked.node = {frame.object_id[i]};
    if (i < frame.material_id.size()) picked.material = {frame.material_id[i]};
    if (i < frame.depth.size() && frame.depth[i] > 0) picked.depth = frame.depth[i];
    return picked;
}

std::optional<Vec3d> seen_point(const Frame& frame, const Projection& projection, double u, double v) {
    const Picked picked = pick(frame, u, v);
    if (!picked.depth) return {};
    const ViewRay ray = projection.ray(u, v);
    return ray.origin + ray.direction * *picked.depth;
}

} // namespace blush
