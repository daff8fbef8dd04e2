// Lights of emissive meshes and of the meshes of area lights: one record per triangle.
#pragma once

#include "render/compile/geometry_pool.h"
#include "render/lights/light_profiles.h"
#include "render/lights/light_tree.h"
#include "render/materials/material_table.h"
#include "scene/scene.h"
#include "shading/light.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace blush {

// zero_size_lights: NEE samples only lights of zero size, which rays cannot hit.
enum class NeeLights { all_lights, zero_size_lights };

// An entry of the light tree: a triangle, or all triangles of a part.
struct MeshLightEntry {
    LightBounds bounds;
    std::shared_ptr<const MeshTree> tree; // null: a triangle
    int32_t light = 0, count = 1;         // its records
    // Only for a part:
    Id<Node> node;            // its node
    int32_t part_of_node = 0; // its index among the parts of that node
    float theta_e = 0;        // its spread
};

// The first records of a light table (light_table.h). They depend on meshes, materials and area lights only, and are rebuilt
// only if one of these changes.
struct MeshLights {
    std::vector<LightRecord> records;
    std::vector<Id<Node>> nodes; // by record, like the next
    std::vector<double> powers;
    std::vector<MeshLightEntry> entries;  // of the light tree; a record's slot is the index of its entry
    std::vector<FirstLight> first_lights; // of the parts that have records
    LightProfiles profiles;
    int64_t emissive_triangles = 0;
    int64_t unsampled_triangles = 0; // beyond max_mesh_lights (light_limits.h)
    int64_t luminaires = 0;          // an area light counts once, not per triangle
};

// True for materials of emissive triangles that light the scene.
bool is_emissive(const MaterialRecord& material);
// `parts`: parts with emissive materials, in ascending order. `tables`: of the geometry and the materials; their lights are not read.
// `before`: mesh lights of the previous scene; reuses its trees for parts whose triangles did not change.
MeshLights build_mesh_lights(const Scene& expanded, const GeometryPool& geometry, const SceneTables& tables,
                             const std::vector<size_t>& parts, NeeLights aim, const MeshLights& before, const Workers& workers);

// The power if it is positive and finite, else 0.
double usable_power(double power);
double luminance_of(const Vec3& color);
// Radians added to cone angles of bounds: single-precision cosines cannot represent narrower cones.
constexpr double angle_margin = 0.01;

} // namespace blush
