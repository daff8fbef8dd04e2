// Table of caustic casters: bounding spheres of specular objects,
// towards which diffuse surfaces sample directions (shading/caustic_guiding.h).
#pragma once

#include "render/compile/object_list.h"
#include "scene/scene.h"
#include "shading/caustic_guiding.h"

#include <cstdint>
#include <map>
#include <vector>

namespace blush {

// True for smooth or nearly smooth mirrors and glass, whose caustics NEE rarely or never finds.
bool casts_caustics(const Material& material);

// Bounding sphere of a geometry, in object space.
struct GeometryBoundingSphere {
    Vec3d center{0, 0, 0};
    double radius = 0;
};
GeometryBoundingSphere bounding_sphere(const Geometry& geometry);

// Builds the list without reading all vertices at each edit: caches the spheres of geometries.
class CausticCasterTable {
public:
    static constexpr size_t max_casters = 8; // the largest ones; every diffuse vertex loops over all of them

    // `objects` in their traced form; positions are relative to `origin`. Empty if `wanted` is false.
    void build(const Scene& scene, const std::vector<SceneObject>& objects, const Vec3d& origin, bool wanted);
    CausticCasterTables tables() const { return {spheres_.data(), int32_t(spheres_.size())}; }
    const std::vector<CasterSphere>& spheres() const { return spheres_; }

private:
    std::vector<CasterSphere> spheres_;
    std::map<uint64_t, GeometryBoundingSphere> by_serial_;
};

} // namespace blush
