#include "scene/geometry/ray_queries.h"

#include "scene/affine.h"
#include "scene/animation/deform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush {
namespace {

constexpr double left_out = 1e-4;

// A line segment with parameter t; hits count for begin < t < end.
struct Line {
    Vec3d origin, way;
    double begin, end;
};
struct TriangleHit {
    double t;
    const Geometry* geometry = nullptr; // null: no hit
    size_t first_index = 0;             // of the triangle, into geometry->indices
    Affined world_from_mesh{};
    Id<Node> node = {};
};

// Ray-triangle intersection: Möller and Trumbore 1997.
std::optional<double> meet(const Line& line, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const auto& [origin, way, begin, end] = line;
    const Vec3d e = b - a, f = c - a, p = cross(way, f);
    const double determinant = dot(e, p);
    if (determinant == 0) return {};
    const Vec3d s = origin - a, q = cross(s, e);
    const double u = dot(s, p) / determinant, v = dot(way, q) / determinant, t = dot(f, q) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t > begin && t < end)) return {};
    return t;
}

// Updates `nearest` with closer hits; corner(i) is the position of the part's i-th index in the line's space.
template <class Corner> void look_in(const Geometry& g, const Corner& corner, Line line, TriangleHit& nearest) {
    for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
        line.end = std::min(line.end, nearest.t);
        if (const auto t = meet(line, corner(i), corner(i + 1), corner(i + 2))) nearest = {*t, &g, i};
    }
}

// The same in the part's object space.
void look_in(const Geometry& g, const Line& line, TriangleHit& nearest) {
    look_in(
        g, [&](size_t i) { return to_double(g.positions[g.indices[i]]); }, line, nearest);
}

// For singular transforms, which have no inverse: the triangles are transformed to world space.
void look_in_flattened(const std::vector<const Geometry*>& parts, const Affined& world_from_parts, const Line& line, TriangleHit& nearest) {
    const double before = nearest.t;
    for (const Geometry* g : parts)
        look_in(
            *g, [&](size_t i) { return transform_point(world_from_parts, to_double(g->positions[g->indices[i]])); }, line, nearest);
    if (nearest.t < before) nearest.world_from_mesh = world_from_parts;
}

// True for materials with transmission or alpha. Textures are not evaluated at the hit point.
bool lets_light_through(const Material* m) {
    return m && (m->transmission > 0 || m->alpha == Material::Alpha::mask ||
                 (m->alpha == Material::Alpha::blend && (m->opacity < 1 || m->base_color_texture.texture)));
}

// The parts of a mesh, or only those that block light.
std::vector<const Geometry*> parts_of(const Scene& scene, const DeformedMesh& mesh, bool opaque_only) {
    std::vector<const Geometry*> parts;
    for (const MeshPart& part : mesh.parts)
        if (part.geometry && !(opaque_only && lets_light_through(scene.materials.find(part.material))))
            parts.push_back(part.geometry.get());
    return parts;
}

Bounds box_of(const std::vector<const Geometry*>& parts) {
    Bounds box;
    for (const Geometry* g : parts)
        for (const Vec3& p : g->positions) box.include(to_double(p));
    return box;
}

bool meets(const Bounds& box, const Line& line) {
    const Vec3d &origin = line.origin, &way = line.way;
    const double from[3] = {origin.x, origin.y, origin.z}, along[3] = {way.x, way.y, way.z};
    const double low[3] = {box.low.x, box.low.y, box.low.z}, high[3] = {box.high.x, box.high.y, box.high.z};
    double begin = 0, end = line.end;
    for (int k = 0; k < 3; ++k) {
        if (along[k] == 0 && (from[k] < low[k] || from[k] > high[k])) return false;
        if (along[k] == 0) continue;
        const double a = (low[k] - from[k]) / along[k], b = (high[k] - from[k]) / along[k];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end * (1 + 1e-12);
}

// The same for transformed parts. `box`: their bounds in object space; null: skip the bounds test.
void look_in(const std::vector<const Geometry*>& parts, const Affined& world_from_parts, const Bounds* box, const Line& line,
             TriangleHit& nearest) {
    if (!(std::abs(determinant(world_from_parts)) > 0)) return look_in_flattened(parts, world_from_parts, line, nearest);
    const Affined parts_from_world = inverse(world_from_parts);
    const Vec3d origin = transform_point(parts_from_world, line.origin);
    const Line own{origin, transform_point(parts_from_world, line.origin + line.way) - origin, line.begin, line.end};
    if (box && !meets(*box, own)) return;
    const double before = nearest.t;
    for (const Geometry* g : parts) look_in(*g, own, nearest);
    if (nearest.t < before) nearest.world_from_mesh = world_from_parts;
}

// Intersects the meshes of all visible nodes that count, and all their instances.
TriangleHit nearest_hit(const Scene& scene, const Line& line, bool opaque_only, const std::function<bool(Id<Node>)>& counts) {
    WorldTransforms transforms(scene);
    TriangleHit nearest{line.end};
    for (const auto& [id, node] : scene.nodes) {
        if (!node.mesh || !transforms(id).visible || !counts(id)) continue;
        const DeformedMesh mesh = deformed_mesh(scene, transforms, id, node);
        const std::vector<const Geometry*> parts = parts_of(scene, mesh, opaque_only);
        const double before = nearest.t;
        if (!node.instances)
            look_in(parts, mesh.world_from_mesh, nullptr, line, nearest);
        else {
            const Bounds box = box_of(parts);
            for (const Affine& place : node.instances->node_from_copy)
                look_in(parts, mesh.world_from_mesh * to_double(place), &box, line, nearest);
        }
        if (nearest.t < before) nearest.node = id;
    }
    return nearest;
}

// A triangle in world space.
struct PlacedTriangle {
    std::array<Vec3d, 3> corners;
    double largest_term = 0; // as of RayHit
};
PlacedTriangle placed(const Geometry& g, size_t first_index, const Affined& m) {
    PlacedTriangle triangle;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d p = to_double(g.positions[g.indices[first_index + k]]);
        triangle.corners[k] = transform_point(m, p);
        for (const Vec3d& term : {m.x * p.x, m.y * p.y, m.z * p.z})
            triangle.largest_term = std::max({triangle.largest_term, std::abs(term.x), std::abs(term.y), std::abs(term.z)});
    }
    return triangle;
}

// The point of a triangle nearest to p: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
Vec3d nearest_point(const Vec3d& p, const std::array<Vec3d, 3>& corners) {
    const auto& [a, b, c] = corners;
    const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double at_c = d1 * d4 - d3 * d2, at_b = d5 * d2 - d1 * d6, at_a = d3 * d6 - d5 * d4;
    if (at_c <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    if (at_b <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    if (at_a <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    return a + (ab * at_b + ac * at_c) / (at_a + at_b + at_c);
}

// The triangle of a part nearest to a point.
struct NearestTriangle {
    double distance_squared = std::numeric_limits<double>::infinity();
    PlacedTriangle triangle;
    Vec3d position{0, 0, 0};
    Id<Node> node;
};
void look_near(const Geometry& g, const Affined& world_from_part, const Vec3d& point, Id<Node> node, NearestTriangle& nearest) {
    for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
        const PlacedTriangle triangle = placed(g, i, world_from_part);
        const Vec3d normal = cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
        if (!(dot(normal, normal) > 0)) continue;
        const Vec3d position = nearest_point(point, triangle.corners), to = position - point;
        if (dot(to, to) < nearest.distance_squared) nearest = {dot(to, to), triangle, position, node};
    }
}

} // namespace

std::optional<Id<Node>> first_occluder(const Scene& scene, const Vec3d& from, const Vec3d& to,
                                       const std::function<bool(Id<Node>)>& counts) {
    const TriangleHit hit = nearest_hit(scene, {from, to - from, left_out, 1 - left_out}, true, counts);
    return hit.geometry ? std::optional(hit.node) : std::nullopt;
}

double unoccluded_fraction(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts) {
    const TriangleHit hit = nearest_hit(scene, {from, to - from, left_out, 1 - left_out}, true, counts);
    return hit.geometry ? hit.t : 1;
}

std::optional<RayHit> cast_ray(const Scene& scene, const Vec3d& origin, const Vec3d& direction,
                               const std::function<bool(Id<Node>)>& counts) {
    const TriangleHit hit = nearest_hit(scene, {origin, direction, 0, std::numeric_limits<double>::infinity()}, false, counts);
    if (!hit.geometry) return {};
    const PlacedTriangle triangle = placed(*hit.geometry, hit.first_index, hit.world_from_mesh);
    const auto& corners = triangle.corners;
    const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(dot(normal, normal) > 0)) return {};
    const Vec3d unit_normal = normalize(normal) * (dot(normal, direction) > 0 ? -1.0 : 1.0);
    return RayHit{hit.node, origin + direction * hit.t, unit_normal, corners, triangle.largest_term};
}

std::optional<RayHit> nearest_surface(const Scene& scene, const Vec3d& point, const Vec3d& viewer) {
    WorldTransforms transforms(scene);
    NearestTriangle nearest;
    for (const auto& [id, node] : scene.nodes) {
        if (!node.mesh || !transforms(id).visible) continue;
        const DeformedMesh mesh = deformed_mesh(scene, transforms, id, node);
        for (const Geometry* g : parts_of(scene, mesh, false)) {
            if (!node.instances) look_near(*g, mesh.world_from_mesh, point, id, nearest);
            if (node.instances)
                for (const Affine& place : node.instances->node_from_copy)
                    look_near(*g, mesh.world_from_mesh * to_double(place), point, id, nearest);
        }
    }
    if (!nearest.node) return {};
    const auto& corners = nearest.triangle.corners;
    const Vec3d normal = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    const double side = dot(normal, viewer - nearest.position) < 0 ? -1.0 : 1.0;
    return RayHit{nearest.node, nearest.position, normal * side, corners, nearest.triangle.largest_term};
}

} // namespace blush
