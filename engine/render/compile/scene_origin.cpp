#include "render/compile/scene_origin.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
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

void ExtentCache::include(const SceneObject& object, Bounds& bounds) const {
    if (object.disabled) return;
    for (const MeshPart& part : object.parts)
        for (size_t copy = 0; copy < object.copies(); ++copy)
            bounds.include(by_serial_.at(part.geometry->serial), object.world_from_copy(copy));
}

Extent ExtentCache::extent_of(const std::vector<SceneObject>& objects, const std::vector<SphereLight>& spheres) {
    std::map<uint64_t, Bounds> used;
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            const uint64_t serial = part.geometry->serial;
            if (used.contains(serial)) continue;
            const auto known = by_serial_.find(serial);
            used.emplace(serial, known != by_serial_.end() ? known->second : bounds_of(*part.geometry));
        }
    by_serial_ = std::move(used);
    without_area_lights_ = {};
    area_lights_.clear();
    for (size_t i = 0; i < objects.size(); ++i) {
        if (is_expanded(objects[i].node))
            area_lights_.push_back(i);
        else
            include(objects[i], without_area_lights_);
    }
    return with_moved_area_lights(objects, spheres);
}

Extent ExtentCache::with_moved_area_lights(const std::vector<SceneObject>& objects, const std::vector<SphereLight>& spheres) const {
    Extent extent;
    extent.bounds = without_area_lights_;
    for (const size_t i : area_lights_) include(objects[i], extent.bounds);
    for (const SphereLight& sphere : spheres)
        for (const double side : {-sphere.radius, sphere.radius}) extent.bounds.include(sphere.center + Vec3d{side, side, side});
    extent.origin = render_origin(extent.bounds);
    return extent;
}

} // namespace blush
