#include "render/compile/geometry_pool.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "render/materials/material_table.h"
#include "scene/affine.h"
#include "scene/geometry/arena_geometry.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace blush {
namespace {

// Cofactors times the determinant's sign, scaled to avoid overflow in single precision.
Affined normal_matrix(const Affined& m) {
    Affined c = cofactor(m);
    const double size = std::max({length(c.x), length(c.y), length(c.z), 1e-300});
    const double s = (determinant(m) < 0 ? -1.0 : 1.0) / size;
    return {c.x * s, c.y * s, c.z * s, {0, 0, 0}};
}

InstanceRecord make_instance(const Affined& m) {
    const Affined n = normal_matrix(m);
    return {to_float(m), to_float(n.x), to_float(n.y), to_float(n.z)};
}

template <class T> void append_or_fill(GeometryArray<T>& pool, bool wanted, const GeometryArray<T>& values, size_t count, const T& filler) {
    if (!wanted) return;
    if (values.size() == count)
        pool.insert(pool.end(), values.begin(), values.end());
    else
        pool.resize(pool.size() + count, filler);
}

// Empty if the mesh lacks that set.
const GeometryArray<Vec2>& uv_set(const Geometry& g, int number) {
    static const GeometryArray<Vec2> none;
    return number >= 0 && g.has_uv_set(number) ? g.uv[size_t(number)] : none;
}

int32_t flags_of(const Geometry& g, const AttributeNeeds& needs, bool smooth, const Affined& world_from_object, bool instanced) {
    int32_t flags = smooth ? part_smooth : 0;
    const size_t n = g.positions.size();
    if (needs.tangents && g.tangents.size() == n) flags |= part_tangents;
    for (size_t set = 0; set < needs.uv_sets.size(); ++set)
        if (uv_set(g, needs.uv_sets[set]).size() == n) flags |= part_uv << set;
    if (needs.colors && g.colors.size() == n) flags |= part_colors;
    if (!instanced && determinant(world_from_object) < 0) flags |= part_mirrored;
    return flags;
}

// Vertex normals equal to the face normals need not be read.
bool has_flat_normals(const Geometry& g) {
    for (size_t i = 0; i < g.indices.size(); i += 3) {
        const uint32_t* v = &g.indices[i];
        const Vec3d a = to_double(g.positions[v[0]]), b = to_double(g.positions[v[1]]), c = to_double(g.positions[v[2]]);
        const Vec3d face = cross(b - a, c - a);
        const double l = length(face);
        for (int k = 0; k < 3; ++k) {
            const Vec3d n = to_double(g.normals[v[k]]);
            if (!(dot(n, face) >= (1 - 1e-9) * l * length(n))) return false;
        }
    }
    return true;
}

// Whether each mesh has smooth vertex normals, by serial.
std::map<uint64_t, bool> smooth_shapes(const std::vector<SceneObject>& objects) {
    std::map<uint64_t, bool> smooth;
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            const Geometry& g = *part.geometry;
            const auto [it, is_new] = smooth.try_emplace(g.serial, false);
            if (is_new) it->second = g.normals.size() == g.positions.size() && !has_flat_normals(g);
        }
    return smooth;
}

// World transform of an instance relative to `origin`, subtracted before rounding.
Affined placed(const SceneObject& object, size_t copy, const Vec3d& origin) {
    Affined m = object.world_from_copy(copy);
    m.t = m.t - origin;
    return m;
}

// Number of parts of an object over all its instances.
size_t placed_parts(const SceneObject& object) { return object.copies() * object.parts.size(); }

// True if the last position can be read as four floats.
bool is_padded(const Geometry& geometry) { return arena_offsets(geometry) || geometry.positions.capacity() > geometry.positions.size(); }

// Address of element 0 of an array: without an arena, its own start.
template <class T> const T* base_of(const GeometryArray<T>& own, bool reserved, Attribute attribute) {
    return reserved ? attribute_base<T>(attribute) : own.data();
}

// An empty array with capacity for `count`, at its arena range if there is one.
template <class T> GeometryArray<T> with_room(size_t count, const ArenaRangePtr& numbers, T* base) {
    if (numbers && !base) throw std::runtime_error("cannot reserve address space for the scene's vertices");
    GeometryArray<T> room(numbers ? PlacedAllocator<T>(base + numbers->first(), count) : PlacedAllocator<T>());
    room.reserve(count);
    return room;
}

bool is_read_in_place(const SceneObject& object, const Geometry& geometry) { return object.instanced && arena_offsets(geometry); }

// Lets the BVH builder read the document's arrays, which never move, instead of the pool's.
void share(const GeometryPtr& geometry, AccelTriangles& triangles) {
    triangles.owner = geometry;
    triangles.positions = geometry->positions.data();
    triangles.indices = geometry->indices.data();
}

// Kernels address fields of 21-field records by a 32-bit index.
constexpr size_t max_instance_parts = size_t(1) << 26;

} // namespace

// Reserves exactly the capacity that build() needs.
void GeometryPool::reserve(const std::vector<SceneObject>& objects) {
    std::set<uint64_t> shared;
    size_t vertices = 0, indices = 0, parts = 0, instances = 0;
    bool in_place = false;
    for (const SceneObject& object : objects) {
        parts += placed_parts(object);
        if (object.instanced) instances += object.copies();
        for (const MeshPart& part : object.parts) {
            const Geometry& g = *part.geometry;
            if (object.instanced && !shared.insert(g.serial).second) continue;
            if (is_read_in_place(object, g)) {
                in_place = true;
                continue;
            }
            vertices += g.positions.size();
            indices += g.indices.size();
        }
    }
    vertex_range_ = reserve_arena_range(ArenaKind::vertices, vertices);
    index_range_ = reserve_arena_range(ArenaKind::indices, indices);
    const bool reserved = vertex_range_ && index_range_;
    if (vertices > size_t(arena_capacity(ArenaKind::vertices)) || indices > size_t(arena_capacity(ArenaKind::indices)) ||
        (in_place && !reserved))
        throw std::runtime_error("the scene has more vertices than 32-bit indices reach");
    if (!reserved) vertex_range_ = index_range_ = {};
    first_vertex_ = reserved ? int32_t(vertex_range_->first()) : 0;
    first_index_ = reserved ? int32_t(index_range_->first()) : 0;
    if (parts > max_instance_parts) throw std::runtime_error("the scene has more instances than 32-bit indices reach");
    parts_.reserve(parts);
    part_materials_.reserve(parts);
    part_triangles_.reserve(parts);
    part_vertices_.reserve(parts);
    instances_.reserve(instances);
    instance_first_part_.reserve(instances);
    indices_ = with_room(indices, index_range_, index_base());
    const auto enlarge = [&](auto& array, Attribute attribute) {
        using T = std::decay_t<decltype(array)>::value_type;
        array = with_room(vertices, vertex_range_, attribute_base<T>(attribute));
    };
    enlarge(positions_, Attribute::positions);
    all_positions_ = base_of(positions_, reserved, Attribute::positions);
    all_indices_ = reserved ? index_base() : indices_.data();
    if (has_normals_) enlarge(normals_, Attribute::normals);
    if (needs_.tangents) enlarge(tangents_, Attribute::tangents);
    if (needs_.colors) enlarge(colors_, Attribute::colors);
    for (size_t set = 0; set < needs_.uv_sets.size(); ++set)
        if (needs_.uv_sets[set] >= 0) enlarge(uv_[set], uv_attribute_of(needs_.uv_sets[set]));
}

GeometryPool::Span GeometryPool::append(const Geometry& g) {
    const size_t n = g.positions.size();
    const Span span{first_vertex_ + int32_t(positions_.size()), first_index_ + int32_t(indices_.size())};
    indices_.insert(indices_.end(), g.indices.begin(), g.indices.end());
    positions_.insert(positions_.end(), g.positions.begin(), g.positions.end());
    append_or_fill(normals_, has_normals_, g.normals, n, Vec3{0, 0, 0});
    append_or_fill(tangents_, needs_.tangents, g.tangents, n, Vec4{1, 0, 0, 1});
    append_or_fill(colors_, needs_.colors, g.colors, n, Vec4{1, 1, 1, 1});
    for (size_t set = 0; set < needs_.uv_sets.size(); ++set)
        append_or_fill(uv_[set], needs_.uv_sets[set] >= 0, uv_set(g, needs_.uv_sets[set]), n, Vec2{0, 0});
    return span;
}

GeometryPool::Span GeometryPool::find_or_append(const SceneObject& object, const GeometryPtr& geometry, std::map<uint64_t, Span>& shared) {
    if (!object.instanced) return append(*geometry);
    const auto [known, is_new] = shared.try_emplace(geometry->serial);
    if (!is_new) return known->second;
    if (const auto at = arena_offsets(*geometry)) {
        read_in_place_.push_back(geometry);
        known->second = {at->first_vertex, at->first_index};
    } else
        known->second = append(*geometry);
    return known->second;
}

void GeometryPool::place(size_t part, const Geometry& g, const Affined& world_from_object) {
    PartRecord& record = parts_[part];
    const Affined normal = normal_matrix(world_from_object);
    record.flags = (record.flags & ~part_mirrored) | (determinant(world_from_object) < 0 ? part_mirrored : 0);
    const auto first = size_t(record.first_vertex - first_vertex_);
    for (size_t i = 0; i < g.positions.size(); ++i)
        positions_[first + i] = to_float(transform_point(world_from_object, to_double(g.positions[i])));
    if (record.flags & part_smooth)
        for (size_t i = 0; i < g.normals.size(); ++i) normals_[first + i] = to_float(transform_vector(normal, to_double(g.normals[i])));
    if (record.flags & part_tangents)
        for (size_t i = 0; i < g.tangents.size(); ++i) {
            const Vec4& t = g.tangents[i];
            const Vec3 world = to_float(transform_vector(world_from_object, to_double(Vec3{t.x, t.y, t.z})));
            tangents_[first + i] = {world.x, world.y, world.z, t.w};
        }
}

void GeometryPool::build(const std::vector<SceneObject>& objects, const AttributeNeeds& needs, const Vec3d& origin) {
    *this = {};
    needs_ = needs;
    origin_ = origin;
    std::map<uint64_t, Span> shared; // instanced geometry by serial
    const std::map<uint64_t, bool> smooth = smooth_shapes(objects);
    has_normals_ = std::ranges::any_of(smooth, [](const auto& shape) { return shape.second; });
    reserve(objects);
    for (const SceneObject& object : objects) {
        object_first_part_.push_back(parts_.size());
        std::vector<Span> spans;
        if (object.instanced) largest_instanced_mesh_ = std::max(largest_instanced_mesh_, object.triangle_count());
        for (const MeshPart& part : object.parts) spans.push_back(find_or_append(object, part.geometry, shared));
        for (size_t copy = 0; copy < object.copies(); ++copy) {
            const Affined world_from_object = placed(object, copy, origin);
            if (object.instanced) {
                instance_first_part_.push_back(int32_t(parts_.size()));
                instances_.push_back(make_instance(world_from_object));
            }
            for (size_t i = 0; i < object.parts.size(); ++i) {
                const Geometry& g = *object.parts[i].geometry;
                const int32_t flags = flags_of(g, needs, smooth.at(g.serial), world_from_object, object.instanced);
                parts_.push_back({0, int32_t(object.node.value), spans[i].first_index, spans[i].first_vertex,
                                  object.instanced ? int32_t(instances_.size()) - 1 : -1, flags, -1});
                part_materials_.push_back(object.parts[i].material);
                part_triangles_.push_back(int64_t(g.triangle_count()));
                part_vertices_.push_back(int64_t(g.positions.size()));
                if (!object.instanced) place(parts_.size() - 1, g, world_from_object);
            }
        }
    }
}

void GeometryPool::move(const std::vector<SceneObject>& before, const std::vector<SceneObject>& objects, const Vec3d& origin) {
    const bool all_moved = origin != origin_;
    origin_ = origin;
    size_t part = 0, instance = 0;
    for (size_t i = 0; i < objects.size(); ++i) {
        const SceneObject& object = objects[i];
        const bool moved = all_moved || !before[i].same_place(object);
        if (moved && object.instanced)
            for (size_t copy = 0; copy < object.copies(); ++copy) instances_[instance + copy] = make_instance(placed(object, copy, origin));
        if (moved && !object.instanced)
            for (size_t k = 0; k < object.parts.size(); ++k) place(part + k, *object.parts[k].geometry, placed(object, 0, origin));
        if (object.instanced) instance += object.copies();
        part += placed_parts(object);
    }
}

void GeometryPool::move_flat(size_t i, const SceneObject& object) {
    for (size_t k = 0; k < object.parts.size(); ++k)
        place(object_first_part_[i] + k, *object.parts[k].geometry, placed(object, 0, origin_));
}

void GeometryPool::set_materials(const MaterialTable& materials) {
    if (materials.ids == indexed_materials_) return;
    indexed_materials_ = materials.ids;
    for (size_t part = 0; part < parts_.size(); ++part) parts_[part].material = materials.index_of(part_materials_[part]);
}

void GeometryPool::set_first_lights(const std::vector<FirstLight>& lights) {
    for (const FirstLight& before : first_lights_) parts_[before.part].first_light = -1;
    for (const FirstLight& now : lights) parts_[now.part].first_light = now.light;
    first_lights_ = lights;
}

std::vector<size_t> GeometryPool::parts_of(const std::vector<SceneObject>& objects, const std::vector<Id<Material>>& materials) const {
    std::vector<size_t> parts;
    const auto is_one = [&](const MeshPart& part) { return std::ranges::binary_search(materials, part.material); };
    for (size_t i = 0; i < objects.size(); ++i) {
        const SceneObject& object = objects[i];
        if (std::ranges::none_of(object.parts, is_one)) continue;
        for (size_t copy = 0; copy < object.copies(); ++copy)
            for (size_t k = 0; k < object.parts.size(); ++k)
                if (is_one(object.parts[k])) parts.push_back(object_first_part_[i] + copy * object.parts.size() + k);
    }
    return parts;
}

const Geometry& GeometryPool::mesh_of(const std::vector<SceneObject>& objects, size_t part) const {
    const auto object = size_t(std::ranges::upper_bound(object_first_part_, part) - object_first_part_.begin()) - 1;
    const std::vector<MeshPart>& parts = objects[object].parts;
    return *parts[(part - object_first_part_[object]) % parts.size()].geometry;
}

void GeometryPool::corners(size_t part, int64_t triangle, Vec3 (&p)[3]) const {
    const PartRecord& record = parts_[part];
    for (int k = 0; k < 3; ++k) {
        const size_t vertex = size_t(record.first_vertex) + all_indices_[size_t(record.first_index) + 3 * size_t(triangle) + size_t(k)];
        p[k] = all_positions_[vertex];
        if (record.transform >= 0) p[k] = transform_point(instances_[size_t(record.transform)].world_from_object, p[k]);
    }
}

void GeometryPool::fill(SceneTables& t) const {
    const auto pointer = [&](const auto& own, Attribute attribute, bool used) {
        const auto* base = used ? base_of(own, vertex_range_ != nullptr, attribute) : nullptr;
        return base ? &base->x : nullptr;
    };
    t.parts = parts_.data();
    t.instances = instances_.data();
    t.instance_first_part = instance_first_part_.data();
    t.indices = all_indices_;
    t.positions = pointer(positions_, Attribute::positions, true);
    t.normals = pointer(normals_, Attribute::normals, has_normals_);
    t.tangents = pointer(tangents_, Attribute::tangents, needs_.tangents);
    t.uv = {};
    for (size_t set = 0; set < needs_.uv_sets.size(); ++set)
        t.uv[set] = pointer(uv_[set], uv_attribute_of(needs_.uv_sets[set]), needs_.uv_sets[set] >= 0);
    t.colors = pointer(colors_, Attribute::colors, needs_.colors);
}

AccelTriangles GeometryPool::accel_triangles(const GeometryPtr& geometry, size_t part, uint32_t mask) const {
    const PartRecord& record = parts_[part];
    return {geometry->serial,
            nullptr,
            all_positions_ + record.first_vertex,
            size_t(part_vertices_[part]),
            all_indices_ + record.first_index,
            size_t(part_triangles_[part]),
            int32_t(part),
            false,
            mask};
}

AccelScene GeometryPool::accel_scene(const std::vector<SceneObject>& objects, const std::vector<Id<Material>>& alpha,
                                     const std::vector<uint32_t>& masks) const {
    AccelScene scene;
    // Instanced parts with equal geometry and material have equal opacity:
    // the first one represents all, so that they share one bottom-level BVH.
    std::map<std::pair<uint64_t, Id<Material>>, int32_t> first_alike;
    size_t instance = 0;
    for (size_t i = 0; i < objects.size(); ++i) {
        const SceneObject& object = objects[i];
        if (!object.instanced && is_expanded(object.node)) scene.first_area_light = std::min(scene.first_area_light, scene.flat.size());
        std::vector<AccelTriangles> triangles;
        for (const MeshPart& p : object.parts) {
            const size_t part = object_first_part_[i] + triangles.size();
            AccelTriangles t = accel_triangles(p.geometry, part, object.instanced ? seen_by_all : masks[i]);
            if (object.instanced) t.part = first_alike.try_emplace({p.geometry->serial, p.material}, int32_t(part)).first->second;
            t.alpha = std::ranges::binary_search(alpha, p.material);
            if (object.instanced && is_padded(*p.geometry)) share(p.geometry, t);
            triangles.push_back(std::move(t));
        }
        if (object.instanced) {
            scene.instances.push_back({std::move(triangles), std::span(instances_).subspan(instance, object.copies()), masks[i]});
            instance += object.copies();
        } else
            scene.flat.insert(scene.flat.end(), triangles.begin(), triangles.end());
    }
    return scene;
}

std::vector<AccelTriangles> GeometryPool::accel_area_lights(const std::vector<SceneObject>& objects,
                                                            const std::vector<uint32_t>& masks) const {
    std::vector<AccelTriangles> area_lights;
    for (size_t i = 0; i < objects.size() && !objects[i].instanced; ++i) // flat objects are first
        for (size_t k = 0; is_expanded(objects[i].node) && k < objects[i].parts.size(); ++k)
            area_lights.push_back(accel_triangles(objects[i].parts[k].geometry, object_first_part_[i] + k, masks[i]));
    return area_lights;
}

size_t GeometryPool::memory_bytes() const {
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    size_t sum = bytes(parts_) + bytes(part_materials_) + bytes(object_first_part_) + bytes(part_triangles_) + bytes(part_vertices_) +
                 bytes(instances_) + bytes(instance_first_part_) + bytes(indices_) + bytes(positions_) + bytes(normals_) +
                 bytes(tangents_) + bytes(colors_);
    for (const GeometryArray<Vec2>& uv : uv_) sum += bytes(uv);
    return sum;
}

size_t GeometryPool::in_place_bytes() const {
    const auto sets = std::ranges::count_if(needs_.uv_sets, [](int number) { return number >= 0; });
    const size_t per_vertex = sizeof(Vec3) + (has_normals_ ? sizeof(Vec3) : 0) + (needs_.tangents ? sizeof(Vec4) : 0) +
                              (needs_.colors ? sizeof(Vec4) : 0) + size_t(sets) * sizeof(Vec2);
    size_t sum = 0;
    for (const GeometryPtr& g : read_in_place_) sum += g->positions.size() * per_vertex + g->indices.size() * sizeof(uint32_t);
    return sum;
}

} // namespace blush
