#include "render/lights/caustic_caster_table.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Above this roughness, NEE finds the reflected light well enough.
constexpr float max_caster_roughness = 0.2f;

// Minimal share of specular reflection or refraction in a material's light; less is not visible next to the diffuse part.
constexpr float min_specular_share = 0.5f;

// Upper bound of the scale factor of a transform: exact for rotations with uniform scale, else the Frobenius norm.
double max_scale(const Affined& a) {
    const double x = dot(a.x, a.x), y = dot(a.y, a.y), z = dot(a.z, a.z), largest = std::max({x, y, z});
    const double slant = std::max({std::abs(dot(a.x, a.y)), std::abs(dot(a.y, a.z)), std::abs(dot(a.z, a.x))});
    return std::sqrt(slant <= 1e-6 * largest ? largest : x + y + z);
}

} // namespace

bool casts_caustics(const Material& m) {
    const bool narrow = m.roughness <= max_caster_roughness && !m.unlit && m.alpha == Material::Alpha::opaque;
    const float refracts = m.thickness > 0 ? m.transmission : 0; // thin walls do not bend light (thin_transmission.h)
    return narrow && std::max(m.metallic, refracts) >= min_specular_share;
}

GeometryBoundingSphere bounding_sphere(const Geometry& geometry) {
    Bounds box;
    for (const Vec3& p : geometry.positions) box.include(to_double(p));
    GeometryBoundingSphere sphere{box.center(), 0};
    for (const Vec3& p : geometry.positions) sphere.radius = std::max(sphere.radius, length(to_double(p) - sphere.center));
    return sphere;
}

void CausticCasterTable::build(const Scene& scene, const std::vector<SceneObject>& objects, const Vec3d& origin, bool wanted) {
    std::map<uint64_t, GeometryBoundingSphere> used;
    spheres_.clear();
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            const Material* material = scene.materials.find(part.material);
            if (!wanted || !material || !casts_caustics(*material)) continue;
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
                    spheres_.push_back({to_float(center), float(radius)});
            }
        }
    by_serial_ = std::move(used);
    std::ranges::stable_sort(spheres_, std::greater<>(), &CasterSphere::radius);
    spheres_.resize(std::min(spheres_.size(), max_casters));
}

} // namespace blush
