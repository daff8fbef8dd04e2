// Everything that emits, as records with selection probabilities.
#pragma once

#include "render/extent.h"
#include "render/geometry_pool.h"
#include "render/light_profiles.h"
#include "render/light_tree.h"
#include "render/material_table.h"
#include "render/sphere_lights.h"
#include "scene/scene.h"
#include "shading/light.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

struct LightTable {
    std::vector<LightRecord> records; // at least one, so that kernels can always read
    std::vector<Id<Node>> nodes;      // by record: what carries it; none: the environment
    std::vector<double> powers;       // by record
    std::vector<uint32_t> thresholds;
    std::vector<int32_t> suns;        // indices of those with a disk
    int32_t count = 0;                // slots to draw from; 0: nothing to aim at
    int32_t environment = -1;
    int32_t first_sphere = 0;
    LightProfiles profiles;
    LightTreeTable tree;              // empty: lights are drawn by power alone
    std::vector<int32_t> slot_lights; // with a tree
    int64_t emissive_triangles = 0, point_lights = 0, sphere_lights = 0, sun_lights = 0;
    int fewer_disk_corners = 0;       // of the polygons that stand for disks, if those are so many that it is not what it should be
    int64_t unaimed_triangles = 0;    // of those that emit: beyond most_mesh_lights

    void fill(LightTables& tables) const;
};

// Triangles that are aimed at: copies of a glowing mesh would otherwise multiply a small file. Beyond that, of objects that have the most of
// them, light is found by those rays alone that happen to meet it, with its full weight: the picture is the same in the mean, with more noise.
constexpr int64_t most_mesh_lights = int64_t(1) << 20;

// Emissive triangles part by part (part records get their first_light), then spheres in their order, then other lights in node order, then
// the sun of a sky, then the environment. Powers are luminous fluxes: pi A L for a triangle, 4 pi^2 r^2 L for a sphere, 4 pi I for a point, times the share that a
// profile leaves of it; for suns and sky what crosses the sphere of radius R around the scene's bounds: pi R^2 E and 4 pi^2 R^2 L (Pharr,
// Jakob, Humphreys, section 12.6). Positions are about the extent's origin. One sample in 64 is shared out among all lights alike, so that a
// faint one is found where it is all there is. If those at finite distance are many, a tree of them is built, which is drawn with the power
// that they have together.
//
// Aim::at_points: only what no ray can find, lights without size, is aimed at. What is found has records where they are read then:
// spheres, suns, and triangles with a profile.
enum class Aim { at_all, at_points };
struct SkyLight {
    bool shines = false;
    Vec3 mean{0, 0, 0}; // radiance averaged over the sphere, nits
};
LightTable build_light_table(const Scene& scene, const MaterialTable& materials, GeometryPool& geometry, const SceneTables& tables,
                             const std::vector<SphereLight>& spheres, const SkyLight& sky, const Extent& extent, Aim aim);
// Bytes of a table of `lights` records.
int64_t light_table_bytes(int64_t lights);

// Picks lights as if record i had factors[i] (>= 0) times its power; none: as they are. Whatever the factors, what shines may be picked. A
// tree of lights keeps its shape.
void weigh_lights(LightTable& table, std::span<const double> factors);

} // namespace blush
