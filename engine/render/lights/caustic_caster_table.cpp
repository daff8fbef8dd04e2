#include "render/lights/caustic_caster_table.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Of a part of which less is smooth, light paths are rarely worth it: its other places stop them.
constexpr float min_smooth_share = 1.f / 32;
// Of a part of which less is mirror or glass, other surfaces sample too many directions in vain.
constexpr float min_caster_share = 0.25f;

// Upper bound of the scale factor of a transform: exact for rotations with uniform scale, else the Frobenius norm.
double max_scale(const Affined& a) {
    const double x = dot(a.x, a.x), y = dot(a.y, a.y), z = dot(a.z, a.z), largest = std::max({x, y, z});
    const double slant = std::max({std::abs(dot(a.x, a.y)), std::abs(dot(a.y, a.z)), std::abs(dot(a.z, a.x))});
    return std::sqrt(slant <= 1e-6 * largest ? largest : x + y + z);
}

} // namespace

const char* why_no_guides(const CausticCasterTables& guides, const CausticCasterTables& all) {
    if (guides.count > 0) return nullptr;
    return all.count > 0 ? "no mirror or solid glass has light to focus that rays can hit" : "no smooth surface has light to focus";
}

GeometryBoundingSphere bounding_sphere(const Geometry& geometry) {
    Bounds box;
    for (const Vec3& p : geometry.positions) box.include(to_double(p));
    GeometryBoundingSphere sphere{box.center(), 0};
    for (const Vec3& p : geometry.positions) sphere.radius = std::max(sphere.radius, length(to_double(p) - sphere.center));
    return sphere;
}

void CausticCasterTable::build(const Scene& scene, const std::vector<SceneObject>& objects, const PartSmoothness& smoothness,
                               const Vec3d& origin, const Wanted& wanted) {
    std::map<uint64_t, GeometryBoundingSphere> used;
    std::vector<CasterSphere> mirrors_and_glass, weak;
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            const Material* material = scene.materials.find(part.material);
            if (!material) continue;
            const Smoothness shares = smoothness.of(part, *material);
            const bool focuses = wanted.mirrors_and_glass && shares.casts_caustics >= min_caster_share;
            if (!focuses && !(wanted.weak_reflectors && shares.casts_caustics + shares.reflects_weakly >= min_smooth_share)) continue;
            const uint64_t serial = part.geometry->serial;
            if (!used.contains(serial)) {
                const auto known = by_serial_.find(serial);
                used.emplace(serial, known != by_serial_.end() ? known->second : bounding_sphere(*part.geometry));
            }
            const GeometryBoundingSphere& sphere = used.at(serial);
            for (size_t copy = 0; copy < object.copies(); ++copy) {
                const Affined world_from_copy = object.world_from_copy(copy);
                const Vec3d center = transform_point(world_from_copy, sphere.center) - origin;
                // Slightly enlarged against rounding.
                const double radius = sphere.radius * max_scale(world_from_copy) * (1 + 1e-5);
                if (radius > 0 && std::isfinite(radius) && std::isfinite(dot(center, center)))
                    (focuses ? mirrors_and_glass : weak).push_back({to_float(center), float(radius)});
            }
        }
    by_serial_ = std::move(used);
    spheres_.clear();
    for (auto* kind : {&mirrors_and_glass, &weak}) {
        std::ranges::stable_sort(*kind, std::greater<>(), &CasterSphere::radius);
        kind->resize(std::min(kind->size(), max_casters - spheres_.size()));
        spheres_.insert(spheres_.end(), kind->begin(), kind->end());
    }
    mirrors_and_glass_ = int32_t(mirrors_and_glass.size());
}

} // namespace blush
