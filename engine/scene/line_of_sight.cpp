#include "scene/line_of_sight.h"

#include "scene/affine.h"
#include "scene/bend.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr double left_out = 1e-4;

// Share of the way from `origin` along `way` at which a triangle is met, 0 .. 1: Möller and Trumbore 1997.
std::optional<double> meet(const Vec3d& origin, const Vec3d& way, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d e = b - a, f = c - a, p = cross(way, f);
    const double determinant = dot(e, p);
    if (determinant == 0) return {};
    const Vec3d s = origin - a, q = cross(s, e);
    const double u = dot(s, p) / determinant, v = dot(way, q) / determinant, t = dot(f, q) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t > left_out && t < 1 - left_out)) return {};
    return t;
}

// The nearest in one part that is nearer than `nearest`, in the part's own space.
double nearest_in(const Geometry& g, const Vec3d& origin, const Vec3d& way, double nearest) {
    const auto corner = [&](size_t i) { return to_double(g.positions[g.indices[i]]); };
    for (size_t i = 0; i + 2 < g.indices.size(); i += 3)
        if (const auto t = meet(origin, way, corner(i), corner(i + 1), corner(i + 2)); t && *t < nearest) nearest = *t;
    return nearest;
}

// Glass, and what is partly or in places not there: whether its textures let this very line through is not asked.
bool lets_light_through(const Material* m) {
    return m && (m->transmission > 0 || m->alpha == Material::Alpha::mask ||
                 (m->alpha == Material::Alpha::blend && (m->opacity < 1 || m->base_color_texture.texture)));
}

// The parts of a mesh that are in the way of light.
std::vector<const Geometry*> solid_parts(const Scene& scene, const PlacedMesh& mesh) {
    std::vector<const Geometry*> parts;
    for (const MeshPart& part : mesh.parts)
        if (part.geometry && !lets_light_through(scene.materials.find(part.material))) parts.push_back(part.geometry.get());
    return parts;
}

Bounds box_of(const std::vector<const Geometry*>& parts) {
    Bounds box;
    for (const Geometry* g : parts)
        for (const Vec3& p : g->positions) box.include(to_double(p));
    return box;
}

// The straight line from `origin` along `way` to its end meets the box.
bool meets(const Bounds& box, const Vec3d& origin, const Vec3d& way) {
    const double from[3] = {origin.x, origin.y, origin.z}, along[3] = {way.x, way.y, way.z};
    const double low[3] = {box.low.x, box.low.y, box.low.z}, high[3] = {box.high.x, box.high.y, box.high.z};
    double begin = 0, end = 1;
    for (int k = 0; k < 3; ++k) {
        if (along[k] == 0 && (from[k] < low[k] || from[k] > high[k])) return false;
        if (along[k] == 0) continue;
        const double a = (low[k] - from[k]) / along[k], b = (high[k] - from[k]) / along[k];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end * (1 + 1e-12);
}

// The nearest in parts that lie somewhere, `box` around them in their own space; null: not worth looking at.
double nearest_in(const std::vector<const Geometry*>& parts, const Affined& world_from_parts, const Bounds* box, const Vec3d& from, const Vec3d& to,
                  double nearest) {
    if (!(std::abs(determinant(world_from_parts)) > 0)) return nearest;
    const Affined parts_from_world = inverse(world_from_parts);
    const Vec3d origin = transform_point(parts_from_world, from), way = transform_point(parts_from_world, to) - origin;
    if (box && !meets(*box, origin, way)) return nearest;
    for (const Geometry* g : parts) nearest = nearest_in(*g, origin, way, nearest);
    return nearest;
}

// The nearest in the mesh of a node, or in all copies of it.
double nearest_in(const Scene& scene, const Node& node, const PlacedMesh& mesh, const Vec3d& from, const Vec3d& to, double nearest) {
    const std::vector<const Geometry*> parts = solid_parts(scene, mesh);
    if (!node.instances) return nearest_in(parts, mesh.world_from_mesh, nullptr, from, to, nearest);
    const Bounds box = box_of(parts);
    for (const Affine& place : node.instances->node_from_copy)
        nearest = nearest_in(parts, mesh.world_from_mesh * to_double(place), &box, from, to, nearest);
    return nearest;
}

} // namespace

std::optional<Id<Node>> first_between(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts) {
    Placements placements(scene);
    double nearest = 1;
    std::optional<Id<Node>> first;
    for (const auto& [id, node] : scene.nodes) {
        if (!node.mesh || !placements(id).visible || !counts(id)) continue;
        const double t = nearest_in(scene, node, placed_mesh(scene, placements, id, node), from, to, nearest);
        if (t < nearest) {
            nearest = t;
            first = id;
        }
    }
    return first;
}

} // namespace blush
