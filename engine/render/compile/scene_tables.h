// The compiled scene as plain tables of 4-byte fields, built by render_scene and read by every kernel.
#pragma once

#include "core/vec.h"
#include "shading/environment.h"
#include "shading/learned_adjoint.h"
#include "shading/light.h"
#include "shading/light_emission.h"
#include "shading/manifold_seeds.h"
#include "shading/material.h"
#include "shading/path_guiding.h"

#include <array>
#include <cstdint>

namespace blush {

// One mesh part of one instance. Its vertices are in world space,
// or in object space with `transform` indexing the InstanceRecord.
struct PartRecord {
    int32_t material;     // index into the material table
    int32_t object;       // Id<Node>.value
    int32_t first_index;  // into indices: 3 per triangle, relative to first_vertex
    int32_t first_vertex; // into positions, normals, ...: parallel arrays; null if no part uses them
    int32_t transform;    // index into instances, -1: already in world space
    int32_t flags;        // PartFlag
    int32_t first_light;  // light record of this part's first triangle, -1: does not emit
};
enum PartFlag : int32_t {
    part_smooth = 1, // vertex normals that differ from the face's
    part_tangents = 2,
    part_colors = 4,
    part_mirrored = 8, // in world space by a transform that turned the winding around
    part_uv = 1 << 16, // has the first of the scene's UV sets; the next bits are for the others
};

// world_from_object and the columns of the normal matrix: cofactors times the determinant's sign, which gives the outward normal
// up to a positive length for both windings.
struct InstanceRecord {
    Affine world_from_object;
    Vec3 normal_x, normal_y, normal_z;
};

struct CameraRecord {
    Vec3 position, right, up, forward; // right and up scaled so that the image spans [-1, 1] in both
    float aperture_radius, focus_distance;
    int32_t orthographic;
};

// Film plane of each emitter's light group.
struct GroupTables {
    const int32_t* of_light = nullptr; // by record of the light table
    const int32_t* of_part = nullptr;  // for emission at surface hits
    int32_t environment = 0;           // of an environment without a light record (a backdrop)
};

// Light and shadow linking, for lights that have it (light_links.h).
struct LinkTables {
    const int32_t* lit_sets = nullptr;      // by light record: index of a part set, -1: all; null: no light is linked
    const uint32_t* lit_parts = nullptr;    // sets of `words` times 32 bits, one bit per part
    const uint32_t* shadow_masks = nullptr; // by light record: mask of shadow rays towards the light
    int32_t words = 0;
};

// Light vertices beside manifold sampling (render/integrator/manifold/light_vertices.h).
struct LightVertexTables {
    EmissionTables emission, emitter; // in the weights, and of the paths; empty: none
    float usual_ratio = 0;            // geometric mean of LightVertexColumns::ratio, m^2
    float walk_share = 1; // factor of the density of manifold sampling in the weights: walks have more variance, and take longer

    bool empty() const { return emitter.empty(); }
};

// Everything a kernel reads about the scene. Pointers stay valid until the next update of the RenderScene.
struct SceneTables {
    const PartRecord* parts = nullptr; // world-space parts first: part = Embree's geometry id
    const InstanceRecord* instances = nullptr;
    const int32_t* instance_first_part = nullptr; // by Embree's instance id; part = this + geometry id
    const uint32_t* indices = nullptr;
    const float* positions = nullptr;           // 3 per vertex
    const float* normals = nullptr;             // 3 per vertex
    const float* tangents = nullptr;            // 4 per vertex
    std::array<const float*, max_uv_sets> uv{}; // 2 per vertex, for each UV set used by textures
    const float* colors = nullptr;              // 4 per vertex
    MaterialTables materials;
    LightTables lights;
    EnvironmentTables environment;
    GuideTables guides;
    CausticCasterTables casters;          // mirrors and glass; guides.casters are the same, or none if rays find no light by them
    CausticCasterTables emission_casters; // light paths are emitted towards these: with weak reflectors, for small lights
    EmissionTables emission;              // null: no light paths
    ManifoldTables manifolds;             // null: no manifold sampling
    LightVertexTables light_vertices;     // only with manifold sampling
    AdjointTables adjoint;                // empty: roulette reads the throughput alone
    int32_t roulette_start = 0;           // bounce before which roulette ends no path from the camera, even if the settings let it
    GroupTables groups;                   // null: no light mix
    LinkTables links;
    bool blends = false; // some part may be neither opaque nor clear: shadow rays carry its transmittance
    bool panes = false;  // some part is a wall that may transmit straight through (thin_transmission.h)
    CameraRecord camera{};
};

} // namespace blush
