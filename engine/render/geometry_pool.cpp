#include "render/geometry_pool.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace blush {
namespace {

// Cofactors times the determinant's sign, scaled so that their size does not overflow in single precision.
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

template <class T> void append_or_fill(std::vector<T>& pool, bool wanted, const std::vector<T>& values, size_t count, const T& filler) {
    if (!wanted) return;
    if (values.size() == count)
        pool.insert(pool.end(), values.begin(), values.end());
    else
        pool.resize(pool.size() + count, filler);
}

int32_t flags_of(const Geometry& g, const AttributeNeeds& needs, bool smooth, const Affined& world_from_object, bool instanced) {
    int32_t flags = smooth ? part_smooth : 0;
    const size_t n = g.positions.size();
    if (needs.tangents && g.tangents.size() == n) flags |= part_tangents;
    if (needs.uv0 && g.uv0.size() == n) flags |= part_uv0;
    if (needs.uv1 && g.uv1.size() == n) flags |= part_uv1;
    if (needs.colors && g.colors.size() == n) flags |= part_colors;
    if (!instanced && determinant(world_from_object) < 0) flags |= part_mirrored;
    return flags;
}

// Vertex normals that are the faces' own change nothing and need not be read.
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

// Has it vertex normals of its own? By serial.
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

// The object's transform into the world about `origin`: the difference is taken before anything is rounded.
Affined placed(const SceneObject& object, const Vec3d& origin) {
    Affined m = object.world_from_object;
    m.t = m.t - origin;
    return m;
}

} // namespace

// Room for exactly what build() appends.
void GeometryPool::reserve(const std::vector<SceneObject>& objects, bool normals) {
    std::set<uint64_t> shared;
    size_t vertices = 0, indices = 0;
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            const Geometry& g = *part.geometry;
            if (object.instanced && !shared.insert(g.serial).second) continue;
            vertices += g.positions.size();
            indices += g.indices.size();
        }
    if (vertices > size_t(INT32_MAX) / 4 || indices > size_t(INT32_MAX))
        throw std::runtime_error("the scene has more vertices than 32-bit indices reach");
    indices_.reserve(indices);
    positions_.reserve(vertices);
    if (normals) normals_.reserve(vertices);
    if (needs_.tangents) tangents_.reserve(vertices);
    if (needs_.colors) colors_.reserve(vertices);
    if (needs_.uv0) uv0_.reserve(vertices);
    if (needs_.uv1) uv1_.reserve(vertices);
}

GeometryPool::Span GeometryPool::append(const Geometry& g, bool normals) {
    const size_t n = g.positions.size();
    const Span span{int32_t(positions_.size()), int32_t(indices_.size())};
    indices_.insert(indices_.end(), g.indices.begin(), g.indices.end());
    positions_.insert(positions_.end(), g.positions.begin(), g.positions.end());
    append_or_fill(normals_, normals, g.normals, n, Vec3{0, 0, 0});
    append_or_fill(tangents_, needs_.tangents, g.tangents, n, Vec4{1, 0, 0, 1});
    append_or_fill(colors_, needs_.colors, g.colors, n, Vec4{1, 1, 1, 1});
    append_or_fill(uv0_, needs_.uv0, g.uv0, n, Vec2{0, 0});
    append_or_fill(uv1_, needs_.uv1, g.uv1, n, Vec2{0, 0});
    return span;
}

void GeometryPool::place(size_t part, const Geometry& g, const Affined& world_from_object) {
    PartRecord& record = parts_[part];
    const Affined normal = normal_matrix(world_from_object);
    record.flags = (record.flags & ~part_mirrored) | (determinant(world_from_object) < 0 ? part_mirrored : 0);
    const size_t first = size_t(record.first_vertex);
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
    const bool normals = std::ranges::any_of(smooth, [](const auto& shape) { return shape.second; });
    reserve(objects, normals);
    for (const SceneObject& object : objects) {
        const Affined world_from_object = placed(object, origin);
        if (object.instanced) {
            instance_first_part_.push_back(int32_t(parts_.size()));
            instances_.push_back(make_instance(world_from_object));
        }
        for (const MeshPart& part : object.parts) {
            const Geometry& g = *part.geometry;
            Span span;
            if (!object.instanced)
                span = append(g, normals);
            else if (const auto it = shared.find(g.serial); it != shared.end())
                span = it->second;
            else
                span = shared[g.serial] = append(g, normals);
            const int32_t flags = flags_of(g, needs, smooth.at(g.serial), world_from_object, object.instanced);
            parts_.push_back({0, int32_t(object.node.value), span.first_index, span.first_vertex,
                              object.instanced ? int32_t(instances_.size()) - 1 : -1, flags, -1});
            part_materials_.push_back(part.material);
            part_triangles_.push_back(int64_t(g.triangle_count()));
            part_vertices_.push_back(int64_t(g.positions.size()));
            if (!object.instanced) place(parts_.size() - 1, g, world_from_object);
        }
    }
}

void GeometryPool::move(const std::vector<SceneObject>& before, const std::vector<SceneObject>& objects, const Vec3d& origin) {
    const bool all_moved = origin != origin_;
    origin_ = origin;
    size_t part = 0, instance = 0;
    for (size_t i = 0; i < objects.size(); ++i) {
        const bool moved = all_moved || before[i].world_from_object != objects[i].world_from_object;
        const Affined world_from_object = placed(objects[i], origin);
        if (objects[i].instanced) {
            if (moved) instances_[instance] = make_instance(world_from_object);
            ++instance;
        }
        for (const MeshPart& p : objects[i].parts) {
            if (moved && !objects[i].instanced) place(part, *p.geometry, world_from_object);
            ++part;
        }
    }
}

void GeometryPool::corners(size_t part, int64_t triangle, Vec3 (&p)[3]) const {
    const PartRecord& record = parts_[part];
    for (int k = 0; k < 3; ++k) {
        const size_t vertex = size_t(record.first_vertex) + indices_[size_t(record.first_index) + 3 * size_t(triangle) + size_t(k)];
        p[k] = positions_[vertex];
        if (record.transform >= 0) p[k] = transform_point(instances_[size_t(record.transform)].world_from_object, p[k]);
    }
}

int64_t GeometryPool::degenerate_count(size_t part) const {
    int64_t n = 0;
    for (int64_t t = 0; t < part_triangles_[part]; ++t) {
        Vec3 p[3];
        corners(part, t, p);
        const Vec3d a = to_double(p[0]), normal = cross(to_double(p[1]) - a, to_double(p[2]) - a);
        n += !(dot(normal, normal) > 0);
    }
    return n;
}

void GeometryPool::fill(SceneTables& t) const {
    const auto pointer = [](const auto& v) { return v.empty() ? nullptr : &v[0].x; };
    t.parts = parts_.data();
    t.instances = instances_.data();
    t.instance_first_part = instance_first_part_.data();
    t.indices = indices_.data();
    t.positions = pointer(positions_);
    t.normals = pointer(normals_);
    t.tangents = pointer(tangents_);
    t.uv0 = pointer(uv0_);
    t.uv1 = pointer(uv1_);
    t.colors = pointer(colors_);
}

AccelScene GeometryPool::accel_scene(const std::vector<SceneObject>& objects, const std::vector<bool>& alpha,
                                     const std::vector<uint32_t>& masks) const {
    AccelScene scene;
    // Instanced parts of the same data and material are equally opaque: the first answers for all, so that they share one bottom level.
    std::map<std::pair<uint64_t, Id<Material>>, int32_t> first_alike;
    size_t part = 0;
    for (size_t i = 0; i < objects.size(); ++i) {
        const SceneObject& object = objects[i];
        std::vector<AccelTriangles> triangles;
        for (const MeshPart& p : object.parts) {
            const PartRecord& record = parts_[part];
            const int32_t opaque_as =
                object.instanced ? first_alike.try_emplace({p.geometry->serial, p.material}, int32_t(part)).first->second : int32_t(part);
            triangles.push_back({p.geometry->serial, positions_.data() + record.first_vertex, size_t(part_vertices_[part]),
                                 indices_.data() + record.first_index, size_t(part_triangles_[part]), opaque_as, alpha[part],
                                 object.instanced ? seen_by_all : masks[i]});
            ++part;
        }
        if (object.instanced)
            scene.instances.push_back({std::move(triangles), instances_[scene.instances.size()].world_from_object, masks[i]});
        else
            scene.flat.insert(scene.flat.end(), triangles.begin(), triangles.end());
    }
    return scene;
}

size_t GeometryPool::memory_bytes() const {
    const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return bytes(parts_) + bytes(instances_) + bytes(indices_) + bytes(positions_) + bytes(normals_) + bytes(tangents_) + bytes(colors_) +
           bytes(uv0_) + bytes(uv1_);
}

} // namespace blush
