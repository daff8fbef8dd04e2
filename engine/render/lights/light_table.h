// Table of all emitters with their selection probabilities.
#pragma once

#include "render/lights/light_profiles.h"
#include "render/lights/light_tree.h"
#include "render/lights/mesh_lights.h"
#include "render/lights/sphere_lights.h"
#include "scene/scene.h"
#include "shading/light.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

struct LightTable {
    std::vector<LightRecord> records; // at least one, because kernels may read element 0
    std::vector<Id<Node>> nodes;      // by record: the node of the light; none: the environment
    std::vector<double> powers;       // by record
    std::vector<uint32_t> thresholds;
    std::vector<int32_t> suns; // indices of suns with a disk
    int32_t count = 0;         // the first lights, which light sampling can select; 0: none
    int32_t environment = -1;
    bool samples_environment = false; // false: it is left to BSDF sampling
    int32_t first_sphere = 0;
    LightProfiles profiles;
    LightTreeTable tree;              // empty: selection by power
    std::vector<int32_t> slot_lights; // with a tree and many distant lights: these by slot
    int64_t emissive_triangles = 0, point_lights = 0, sphere_lights = 0, sun_lights = 0;
    int fewer_disk_corners = 0;      // corners of disk polygons, if reduced because of many disks; else 0
    int64_t unsampled_triangles = 0; // emissive triangles beyond max_mesh_lights (light_limits.h), which are not sampled

    void fill(LightTables& tables) const;
};

// Records: emissive triangles part by part, then spheres in order, then other lights in node order, then the sun of a sky, then the
// environment. Positions are relative to `origin` (scene_origin.h). Powers are pi times the irradiance at a distance of 1 m on the axis of
// the light, on a surface that faces it: pi A L for a triangle, pi^2 r^2 L for a sphere, pi I for a point, times the root mean square of
// its IES profile; pi E for a sun; 2 pi^2 L for an environment of mean radiance L, whose irradiance varies with the normal. If several
// lights emit, a light tree selects them by their irradiance at the receiver. The trees of meshes are those of `meshes`.
//
// NeeLights::zero_size_lights: other lights have records only if hits read them: spheres, suns, and triangles with a profile.
struct SkyLight {
    bool emits_light = false;
    Vec3 mean{0, 0, 0};       // radiance averaged over the sphere, nits
    double sampled_share = 1; // the part of it that light sampling aims at (environment_table.h)
};
// `nodes`: those with lights (expanded_lights.h).
LightTable build_light_table(const Scene& scene, const MeshLights& meshes, const std::vector<Id<Node>>& nodes,
                             const std::vector<SphereLight>& spheres, const SkyLight& sky, const Vec3d& origin, NeeLights aim,
                             const Workers& workers);
// True if light sampling can select a light other than the environment.
bool samples_other_lights(const Scene& scene, const MeshLights& meshes, const std::vector<Id<Node>>& nodes);
// Size in bytes of a table of `lights` records.
int64_t light_table_bytes(int64_t lights);

// Selects lights as if record i had factors[i] (>= 0) times its power; empty: factors of 1. Every emitting light keeps a positive
// probability. A light tree keeps its shape.
void set_light_weights(LightTable& table, std::span<const double> factors);

} // namespace blush
