#include "scene/line_of_sight.h"

#include "scene/affine.h"
#include "scene/placements.h"

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

} // namespace

std::optional<Id<Node>> first_between(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts) {
    Placements placements(scene);
    double nearest = 1;
    std::optional<Id<Node>> first;
    for (const auto& [id, node] : scene.nodes) {
        const Mesh* mesh = scene.meshes.find(node.mesh);
        const Placement& placed = placements(id);
        if (!mesh || !placed.visible || !counts(id) || !(std::abs(determinant(placed.world_from_node)) > 0)) continue;
        const Affined node_from_world = inverse(placed.world_from_node);
        const Vec3d origin = transform_point(node_from_world, from), way = transform_point(node_from_world, to) - origin;
        for (const MeshPart& part : mesh->parts) {
            if (!part.geometry || lets_light_through(scene.materials.find(part.material))) continue;
            const double t = nearest_in(*part.geometry, origin, way, nearest);
            if (t < nearest) {
                nearest = t;
                first = id;
            }
        }
    }
    return first;
}

} // namespace blush
