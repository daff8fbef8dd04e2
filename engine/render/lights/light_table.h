// Table of all emitters with their selection probabilities.
#pragma once

#include "render/compile/scene_origin.h"
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
    int32_t count = 0;         // selection slots; 0: no light is sampled
    int32_t environment = -1;
    bool samples_environment = false; // false: it is left to BSDF sampling
    int32_t first_sphere = 0;
    LightProfiles profiles;
    LightTreeTable tree;              // empty: selection by power alone
    std::vector<int32_t> slot_lights; // with a tree: light of each slot
    int64_t emissive_triangles = 0, point_lights = 0, sphere_lights = 0, sun_lights = 0;
    int fewer_disk_corners = 0;      // corners of disk polygons, if reduced because of many disks; else 0
    int64_t unsampled_triangles = 0; // emissive triangles beyond max_mesh_lights (light_limits.h), which are not sampled

    void fill(LightTables& tables) const;
};

// Records: emissive triangles part by part, then spheres in order, then other lights in node
// order, then the sun of a sky, then the environment. Powers are luminous fluxes: pi A L for a triangle, 4 pi^2 r^2 L for a
// sphere, 4 pi I for a point, times the factor of its profile; for suns and sky the flux through the sphere of radius R around
// the scene's bounds: pi R^2 E and 4 pi^2 R^2 L (Pharr, Jakob, Humphreys, section 12.6). Positions are relative to the extent's
// origin. One sample in 64 is distributed uniformly over all lights, so that a weak light is found where it is the only one. If
// there are many lights at finite distance, a light tree is built, which is selected by their total power. The trees of meshes are those
// of `meshes`.
//
// NeeLights::zero_size_lights: other lights have records only if hits read them: spheres, suns, and triangles with a profile.
struct SkyLight {
    bool emits_light = false;
    Vec3 mean{0, 0, 0};       // radiance averaged over the sphere, nits
    double sampled_share = 1; // the part of it that light sampling aims at (environment_table.h)
};
// `nodes`: those with lights (expanded_lights.h).
LightTable build_light_table(const Scene& scene, const MeshLights& meshes, const std::vector<Id<Node>>& nodes,
                             const std::vector<SphereLight>& spheres, const SkyLight& sky, const Extent& extent, NeeLights aim,
                             const Workers& workers);
// True if light sampling can select a light other than the environment.
bool samples_other_lights(const Scene& scene, const MeshLights& meshes, const std::vector<Id<Node>>& nodes);
// Size in bytes of a table of `lights` records.
int64_t light_table_bytes(int64_t lights);

// Selects lights as if record i had factors[i] (>= 0) times its power; empty: factors of 1. Every emitting light keeps a positive
// probability. A light tree keeps its shape.
void set_light_weights(LightTable& table, std::span<const double> factors);

} // namespace blush
