// Table of caustic casters: bounding spheres of specular objects. Diffuse surfaces sample directions towards them
// (shading/caustic_guiding.h), and lights emit light paths towards them (shading/light_emission.h).
#pragma once

#include "render/compile/object_list.h"
#include "render/compile/part_smoothness.h"
#include "scene/scene.h"
#include "shading/caustic_guiding.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace blush {

// Bounding sphere of a geometry, in object space.
struct GeometryBoundingSphere {
    Vec3d center{0, 0, 0};
    double radius = 0;
};
GeometryBoundingSphere bounding_sphere(const Geometry& geometry);

// Why no surface samples directions towards `guides`, the casters by which rays can find light; null if there are some. `all`: with those
// towards which only light paths are emitted.
const char* why_no_guides(const CausticCasterTables& guides, const CausticCasterTables& all);

// Builds the list without reading all vertices at each edit: caches the spheres of geometries.
class CausticCasterTable {
public:
    // The largest ones. Every density of emission loops over all casters, every diffuse vertex over all guides.
    static constexpr size_t max_casters = 32, max_guides = 8;

    // Which casters an image needs. Weak reflectors: see Smoothness.
    struct Wanted {
        bool mirrors_and_glass = false, weak_reflectors = false;
        bool operator==(const Wanted&) const = default;
    };
    // `objects` in their traced form; positions are relative to `origin`. A part is what a large enough share of it is.
    void build(const Scene& scene, const std::vector<SceneObject>& objects, const PartSmoothness& smoothness, const Vec3d& origin,
               const Wanted& wanted);
    // Mirrors and glass, then weak reflectors.
    CausticCasterTables tables() const { return {spheres_.data(), int32_t(spheres_.size())}; }
    CausticCasterTables mirrors_and_glass() const { return {spheres_.data(), mirrors_and_glass_}; }
    // Those that diffuse surfaces sample directions towards.
    CausticCasterTables guides() const { return {spheres_.data(), std::min(mirrors_and_glass_, int32_t(max_guides))}; }

private:
    std::vector<CasterSphere> spheres_;
    int32_t mirrors_and_glass_ = 0;
    std::map<uint64_t, GeometryBoundingSphere> by_serial_;
};

} // namespace blush
