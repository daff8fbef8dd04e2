// The scene as rays see it: plain tables of 4-byte fields, built by render_scene and read by every kernel.
#pragma once

#include "core/vec.h"
#include "shading/environment.h"
#include "shading/focus.h"
#include "shading/light.h"
#include "shading/material.h"

#include <array>
#include <cstdint>

namespace blush {

// One mesh part at one place. Its vertices are in world space, or in object space with `transform` saying which
// InstanceRecord brings them into the world.
struct PartRecord {
    int32_t material;     // index into the material table
    int32_t object;       // Id<Node>.value
    int32_t first_index;  // into indices: 3 per triangle, relative to first_vertex
    int32_t first_vertex; // into positions, normals, ...: the arrays run in parallel, those that no part needs are null
    int32_t transform;    // index into instances, -1: already in world space
    int32_t flags;        // PartFlag
    int32_t first_light;  // light of this part's first triangle, -1: does not emit
};
enum PartFlag : int32_t {
    part_smooth = 1,      // vertex normals that differ from the face's
    part_tangents = 2,
    part_colors = 4,
    part_mirrored = 8,    // in world space by a transform that turned the winding around
    part_uv = 1 << 16,    // has the first of the scene's UV sets; the next bits are those of the others
};

// world_from_object and the columns of the matrix for normals: cofactors times the determinant's sign, which gives the
// outward normal up to a positive length for both windings.
struct InstanceRecord {
    Affine world_from_object;
    Vec3 normal_x, normal_y, normal_z;
};

struct CameraRecord {
    Vec3 position, right, up, forward; // right and up scaled so that the image spans [-1, 1] in both
    float aperture_radius, focus_distance;
    int32_t orthographic;
};

// Which plane of the film light goes to, by what emits it.
struct GroupTables {
    const int32_t* of_light = nullptr; // by record of the light table
    const int32_t* of_part = nullptr;  // of emission that a ray finds on a surface
    int32_t environment = 0;           // of one that is no record of the light table: a backdrop
};

// Whom lights light and who casts their shadows, where that is not everything (light_links.h).
struct LinkTables {
    const int32_t* lit_sets = nullptr;       // by record of the light table: a set of parts, -1: all; null: no light is linked
    const uint32_t* lit_parts = nullptr;     // sets, each of `words` times 32 bits, a bit for each part
    const uint32_t* shadow_masks = nullptr;  // by record: of shadow rays towards the light
    int32_t words = 0;
};

// Everything a kernel reads about the scene. Pointers stay valid until the next update of the RenderScene.
struct SceneTables {
    const PartRecord* parts = nullptr;          // those in world space first: part = Embree's geometry id
    const InstanceRecord* instances = nullptr;
    const int32_t* instance_first_part = nullptr; // by Embree's instance id; part = this + geometry id
    const uint32_t* indices = nullptr;
    const float* positions = nullptr; // 3 per vertex
    const float* normals = nullptr;   // 3 per vertex
    const float* tangents = nullptr;  // 4 per vertex
    std::array<const float*, most_uv_sets> uv{}; // 2 per vertex, of each UV set that textures lie on
    const float* colors = nullptr;    // 4 per vertex
    MaterialTables materials;
    LightTables lights;
    EnvironmentTables environment;
    FocusTables focus;  // none: nobody aims at anything but lights
    GroupTables groups; // null: nobody mixes
    LinkTables links;
    bool panes = false; // some part is a wall that may transmit straight on (thin_transmission.h)
    CameraRecord camera{};
};

} // namespace blush
