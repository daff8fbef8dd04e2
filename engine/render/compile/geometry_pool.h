// All vertices and triangles that rays can hit, in parallel arrays; unused attributes are not allocated. Large instanced meshes
// are read in place from the document (scene/geometry/arena_geometry.h).
#pragma once

#include "core/geometry_arena.h"
#include "render/bvh/accel.h"
#include "render/compile/object_list.h"
#include "render/compile/scene_tables.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace blush {

// Vertex attributes that the meshes and the materials in use need.
struct AttributeNeeds {
    bool tangents = false, colors = false;
    std::vector<int> uv_sets; // for each UV set of the scene its index, -1 if no mesh needs it
    bool operator==(const AttributeNeeds&) const = default;
};

struct MaterialTable;

// The light record of the first triangle of a part.
struct FirstLight {
    size_t part = 0;
    int32_t light = -1;
};

// The only writer of part records.
class GeometryPool {
public:
    // Lays out the parts of `objects`: flat ones in world space, instanced ones in object space and once for all instances. World
    // space is relative to `origin` (scene_origin.h). Parts have the default material and no lights until these are set.
    void build(const std::vector<SceneObject>& objects, const AttributeNeeds& needs, const Vec3d& origin);
    // Rewrites moved objects: same meshes, other transforms or another origin. `before` as passed last time.
    void move(const std::vector<SceneObject>& before, const std::vector<SceneObject>& objects, const Vec3d& origin);

    // Rewrites one flat object, objects[i] of build(), at another transform.
    void move_flat(size_t i, const SceneObject& object);
    // Sets the material indices of all parts; does nothing if the table has the same ids as last time.
    void set_materials(const MaterialTable& materials);
    // Sets the parts that have light records; all others have none.
    void set_first_lights(const std::vector<FirstLight>& lights);

    // One record per part and instance, in the order of objects, their instances and the parts of each.
    const std::vector<PartRecord>& parts() const { return parts_; }
    // The material id of each part.
    const std::vector<Id<Material>>& part_materials() const { return part_materials_; }
    // Indices of the parts that have one of these materials (in id order), ascending. `objects` as passed to build().
    std::vector<size_t> parts_of(const std::vector<SceneObject>& objects, const std::vector<Id<Material>>& materials) const;
    // The mesh of a part. `objects` as passed to build().
    const Geometry& mesh_of(const std::vector<SceneObject>& objects, size_t part) const;
    int64_t triangle_count(size_t part) const { return part_triangles_[part]; }
    // World-space vertices of a part's triangle, computed like the kernels do.
    void corners(size_t part, int64_t triangle, Vec3 (&p)[3]) const;

    void fill(SceneTables& tables) const;
    // Input for the BVH builder, valid until the next change; hits on the materials `alpha` (in id order) get opacity tests,
    // masks[object] is the ray mask.
    AccelScene accel_scene(const std::vector<SceneObject>& objects, const std::vector<Id<Material>>& alpha,
                           const std::vector<uint32_t>& masks) const;
    // The part of it that are flat meshes of area lights.
    std::vector<AccelTriangles> accel_area_lights(const std::vector<SceneObject>& objects, const std::vector<uint32_t>& masks) const;
    int64_t instance_count() const { return int64_t(instances_.size()); }
    // True if some part has smooth vertex normals.
    bool has_normals() const { return has_normals_; }
    // Own vertices, without those read in place from the document.
    int64_t vertex_count() const { return int64_t(positions_.size()); }
    size_t memory_bytes() const;
    size_t shapes_in_place() const { return read_in_place_.size(); }
    // Bytes that copies of those would use.
    size_t in_place_bytes() const;
    // Triangles of the largest instanced mesh.
    size_t largest_instanced_mesh() const { return largest_instanced_mesh_; }

private:
    struct Span {
        int32_t first_vertex = 0, first_index = 0;
    };
    void reserve(const std::vector<SceneObject>& objects);
    Span append(const Geometry& geometry);
    // Span of a mesh, here or in the document; missing ones are appended. `shared`: known instanced meshes by serial.
    Span find_or_append(const SceneObject& object, const GeometryPtr& geometry, std::map<uint64_t, Span>& shared);
    void place(size_t part, const Geometry& geometry, const Affined& world_from_object);
    AccelTriangles accel_triangles(const GeometryPtr& geometry, size_t part, uint32_t mask) const;

    std::vector<PartRecord> parts_;
    std::vector<Id<Material>> part_materials_;
    std::vector<int64_t> part_triangles_;
    std::vector<int64_t> part_vertices_;
    std::vector<size_t> object_first_part_;
    std::vector<Id<Material>> indexed_materials_; // those of the material table that the parts' indices are for
    std::vector<FirstLight> first_lights_;
    std::vector<InstanceRecord> instances_;
    std::vector<int32_t> instance_first_part_;
    std::vector<GeometryPtr> read_in_place_;
    size_t largest_instanced_mesh_ = 0;
    bool has_normals_ = false;
    // Arena ranges of the own arrays. If the arena is unavailable, nothing is read in place.
    ArenaRangePtr vertex_range_, index_range_;
    int32_t first_vertex_ = 0, first_index_ = 0;
    // From arena element 0: own data and data read in place.
    const Vec3* all_positions_ = nullptr;
    const uint32_t* all_indices_ = nullptr;
    GeometryArray<uint32_t> indices_;
    GeometryArray<Vec3> positions_, normals_;
    GeometryArray<Vec4> tangents_, colors_;
    std::array<GeometryArray<Vec2>, max_uv_sets> uv_;
    AttributeNeeds needs_;
    Vec3d origin_{0, 0, 0};
};

} // namespace blush
