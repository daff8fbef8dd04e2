#include "ui/viewport/picking.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>

namespace blush {

namespace {

std::optional<size_t> pixel_at(const Frame& frame, double u, double v) {
    if (frame.width <= 0 || frame.height <= 0 || !(u >= 0 && u < 1 && v >= 0 && v < 1)) return {};
    const int x = std::min(int(u * frame.width), frame.width - 1), y = std::min(int(v * frame.height), frame.height - 1);
    return size_t(y) * size_t(frame.width) + size_t(x);
}

} // namespace

Picked pick(const Frame& frame, double u, double v) {
    Picked picked;
    const auto i = pixel_at(frame, u, v);
    if (!i) return picked;
    if (*i < frame.object_id.size()) picked.node = {frame.object_id[*i]};
    if (*i < frame.material_id.size()) picked.material = {frame.material_id[*i]};
    if (*i < frame.depth.size() && frame.depth[*i] > 0) picked.depth = frame.depth[*i];
    return picked;
}

std::optional<SurfacePoint> surface_at_pixel(const Frame& frame, const Projection& projection, double u, double v) {
    const auto position = seen_point(frame, projection, u, v);
    const auto i = pixel_at(frame, u, v);
    if (!position || *i >= frame.normal.size()) return {};
    const Vec3d normal = to_double(frame.normal[*i]); // a mean over the pixel: nearly zero at the border of surfaces with opposite normals
    if (!(length(normal) > 1e-3)) return {};
    return SurfacePoint{*position, normalize(normal), pick(frame, u, v).node};
}

std::optional<Vec3d> seen_point(const Frame& frame, const Projection& projection, double u, double v) {
    const Picked picked = pick(frame, u, v);
    if (!picked.depth) return {};
    const ViewRay ray = projection.ray(u, v);
    return ray.origin + ray.direction * *picked.depth;
}

} // namespace blush
