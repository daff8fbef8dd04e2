// All vertices and triangles that rays can hit, in arrays that run in parallel; attributes that no part has are not allocated. Large shapes that
// are traced through instances are read where the document has them (scene/placed_geometry.h).
#pragma once

#include "render/accel.h"
#include "render/object_list.h"
#include "render/scene_tables.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace blush {

// Which vertex attributes the shapes and the materials in use call for.
struct AttributeNeeds {
    bool tangents = false, colors = false;
    std::vector<int> uv_sets; // at each of the scene's UV sets its number, -1 if no shape needs it
    bool operator==(const AttributeNeeds&) const = default;
};

class GeometryPool {
public:
    // Lays out the parts of `objects`: flat ones in world space, instanced ones in object space and once for all instances. World
    // space is about `origin` (render/extent.h). Fills every field of the part records but `material` and `first_light`.
    void build(const std::vector<SceneObject>& objects, const AttributeNeeds& needs, const Vec3d& origin);
    // Objects of the same shape at other places, or seen from another origin: rewrites what moved. `before` as given last time.
    void move(const std::vector<SceneObject>& before, const std::vector<SceneObject>& objects, const Vec3d& origin);

    // One record per part and copy, in the order of objects, their copies and the parts of each.
    std::vector<PartRecord>& parts() { return parts_; }
    const std::vector<PartRecord>& parts() const { return parts_; }
    // The material of each part in the scene.
    const std::vector<Id<Material>>& part_materials() const { return part_materials_; }
    int64_t triangle_count(size_t part) const { return part_triangles_[part]; }
    // Triangles that have no area where they lie.
    int64_t degenerate_count() const;
    // World-space corners of a triangle of a part, as the kernels compute them.
    void corners(size_t part, int64_t triangle, Vec3 (&p)[3]) const;

    void fill(SceneTables& tables) const;
    // For the builder, valid until the next change; alpha[part] asks for opacity tests, masks[object] says which rays meet it.
    AccelScene accel_scene(const std::vector<SceneObject>& objects, const std::vector<bool>& alpha,
                           const std::vector<uint32_t>& masks) const;
    int64_t instance_count() const { return int64_t(instances_.size()); }
    // Some part has vertex normals that differ from its faces'.
    bool has_normals() const { return has_normals_; }
    // Of its own: what is read in the document is not counted.
    int64_t vertex_count() const { return int64_t(positions_.size()); }
    size_t memory_bytes() const;
    size_t shapes_in_place() const { return read_in_place_.size(); }
    // What copies of those would take.
    size_t in_place_bytes() const;
    // Triangles of the largest mesh that is traced through instances.
    size_t largest_instanced_mesh() const { return largest_instanced_mesh_; }

private:
    struct Span {
        int32_t first_vertex = 0, first_index = 0;
    };
    void reserve(const std::vector<SceneObject>& objects);
    int64_t degenerate_in(size_t part) const; // as it is stored
    Span append(const Geometry& geometry);
    // Where the shape is, here or in the document; what is not yet anywhere is appended. `shared`: instanced ones that are, by serial.
    Span find_or_append(const SceneObject& object, const GeometryPtr& geometry, std::map<uint64_t, Span>& shared);
    void place(size_t part, const Geometry& geometry, const Affined& world_from_object);

    std::vector<PartRecord> parts_;
    std::vector<Id<Material>> part_materials_;
    std::vector<int64_t> part_triangles_;
    std::vector<int64_t> part_vertices_;
    std::vector<InstanceRecord> instances_;
    std::vector<int32_t> instance_first_part_;
    std::vector<GeometryPtr> read_in_place_;
    size_t largest_instanced_mesh_ = 0;
    bool has_normals_ = false;
    // Its own arrays, and their first numbers. Without numbers, which may be refused, nothing is read in the document.
    NumbersPtr vertex_numbers_, index_numbers_;
    int32_t first_vertex_ = 0, first_index_ = 0;
    // From number 0 on: its own and those it reads in place.
    const Vec3* all_positions_ = nullptr;
    const uint32_t* all_indices_ = nullptr;
    PlacedVector<uint32_t> indices_;
    PlacedVector<Vec3> positions_, normals_;
    PlacedVector<Vec4> tangents_, colors_;
    std::array<PlacedVector<Vec2>, most_uv_sets> uv_;
    AttributeNeeds needs_;
    Vec3d origin_{0, 0, 0};
};

} // namespace blush
