#include "render/compile/scene_origin.h"

#include "core/math.h"
#include "scene/affine.h"

#include <cmath>

namespace blush {
namespace {

Bounds bounds_of(const Geometry& geometry) {
    Bounds bounds;
    for (const Vec3& p : geometry.positions) bounds.include(to_double(p));
    return bounds;
}

} // namespace

Vec3d render_origin(const Bounds& bounds) {
    const double radius = bounds.empty ? 0 : bounds.radius();
    if (!(radius > 0) || !std::isfinite(radius)) return {0, 0, 0};
    int exponent = 0;
    std::frexp(radius, &exponent); // 2^exponent is above the radius, by at most a factor of two
    const double step = std::ldexp(1.0, exponent + 2);
    const auto rounded = [&](double x) { return std::round(x / step) * step; };
    const Vec3d c = bounds.center();
    return {rounded(c.x), rounded(c.y), rounded(c.z)};
}

Extent ExtentCache::extent_of(const std::vector<SceneObject>& objects, const std::vector<SphereLight>& spheres) {
    std::map<uint64_t, Bounds> used;
    Extent extent;
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            const uint64_t serial = part.geometry->serial;
            auto it = used.find(serial);
            if (it == used.end()) {
                const auto known = by_serial_.find(serial);
                it = used.emplace(serial, known != by_serial_.end() ? known->second : bounds_of(*part.geometry)).first;
            }
            for (size_t copy = 0; copy < object.copies(); ++copy) extent.bounds.include(it->second, object.world_from_copy(copy));
        }
    by_serial_ = std::move(used);
    for (const SphereLight& sphere : spheres)
        for (const double side : {-sphere.radius, sphere.radius}) extent.bounds.include(sphere.center + Vec3d{side, side, side});
    extent.origin = render_origin(extent.bounds);
    return extent;
}

} // namespace blush
