#include "scene/affine.h"
#include "scene/animation/deform.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace blush {
namespace {

bool is_finite(const Vec3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
Vec3d smaller(const Vec3d& a, const Vec3d& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d larger(const Vec3d& a, const Vec3d& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

void include_parts(const std::vector<MeshPart>& parts, const Affined& world_from_mesh, Bounds& bounds) {
    for (const MeshPart& part : parts) {
        if (!part.geometry) continue;
        for (const Vec3& p : part.geometry->positions) bounds.include(transform_point(world_from_mesh, to_double(p)));
    }
}

// Uses the mesh's bounding box for instances: visiting the vertices of every instance would be slow.
void include_node(const Scene& scene, WorldTransforms& transforms, Id<Node> id, const Node& node, Bounds& bounds) {
    const DeformedMesh mesh = deformed_mesh(scene, transforms, id, node);
    if (!node.instances) return include_parts(mesh.parts, mesh.world_from_mesh, bounds);
    Bounds box;
    include_parts(mesh.parts, Affined{}, box);
    for (const Affine& place : node.instances->node_from_copy) bounds.include(box, mesh.world_from_mesh * to_double(place));
}

} // namespace

void Bounds::include(const Vec3d& p) {
    if (!is_finite(p)) return;
    if (empty) {
        low = high = p;
        empty = false;
        return;
    }
    low = smaller(low, p);
    high = larger(high, p);
}

void Bounds::include(const Bounds& box, const Affined& world_from_box) {
    if (box.empty) return;
    // A corner is the sum of one product for each axis. Sums round monotonically, so the sum of the smaller products is the smallest
    // corner to the bit. There may be a million boxes.
    const Affined& m = world_from_box;
    const auto products = [](const Vec3d& axis, double a, double b) { return std::pair(axis * a, axis * b); };
    const auto [x0, x1] = products(m.x, box.low.x, box.high.x);
    const auto [y0, y1] = products(m.y, box.low.y, box.high.y);
    const auto [z0, z1] = products(m.z, box.low.z, box.high.z);
    const Vec3d lowest = smaller(x0, x1) + smaller(y0, y1) + smaller(z0, z1) + m.t;
    const Vec3d highest = larger(x0, x1) + larger(y0, y1) + larger(z0, z1) + m.t;
    if (is_finite(lowest) && is_finite(highest)) {
        include(lowest);
        include(highest);
        return;
    }
    const Vec3d corner[2] = {box.low, box.high};
    for (int k = 0; k < 8; ++k) include(transform_point(m, Vec3d{corner[k & 1].x, corner[k >> 1 & 1].y, corner[k >> 2 & 1].z}));
}

Vec3d Bounds::center() const { return (low + high) * 0.5; }
double Bounds::radius() const { return 0.5 * length(high - low); }

Bounds world_bounds(const Scene& scene, Id<Node> node) {
    Bounds bounds;
    WorldTransforms transforms(scene);
    if (const Node* n = scene.nodes.find(node)) include_node(scene, transforms, node, *n, bounds);
    return bounds;
}

Bounds world_bounds(const Scene& scene) {
    Bounds bounds;
    WorldTransforms transforms(scene);
    for (const auto& [id, node] : scene.nodes)
        if (node.mesh && transforms(id).visible) include_node(scene, transforms, id, node, bounds);
    return bounds;
}

View framed(const View& view, const Bounds& bounds, float aspect) {
    if (bounds.empty) return view;
    const double radius = std::max(bounds.radius(), 1e-3);
    View result = view;
    double distance = 2 * radius;
    if (view.lens.orthographic) {
        result.lens.ymag = float(radius * std::max(1.0, 1.0 / aspect));
    } else {
        const double half_height = 0.5 * view.lens.yfov_radians;
        const double half_width = std::atan(std::tan(half_height) * aspect);
        distance = radius / std::sin(std::min(half_height, half_width));
    }
    const Vec3d backward = to_affine(view.rotation).z;
    result.position = to_float(bounds.center() + backward * distance);
    result.pivot_distance = float(distance);
    return result;
}

} // namespace blush
