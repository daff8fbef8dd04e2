#include "io/gltf_tangents.h"

#include "core/math.h"
#include "scene/affine.h"

#include <cmath>

namespace blush {
namespace {

// Where u and where v grow, in object space, weighted by the triangle's size; both zero if the UVs are degenerate.
struct UvDirections {
    Vec3d u{0, 0, 0}, v{0, 0, 0};
};

UvDirections uv_directions(const Geometry& g, const std::vector<Vec2>& uv, size_t triangle) {
    const uint32_t i0 = g.indices[3 * triangle], i1 = g.indices[3 * triangle + 1], i2 = g.indices[3 * triangle + 2];
    const Vec3d e1 = to_double(g.positions[i1]) - to_double(g.positions[i0]), e2 = to_double(g.positions[i2]) - to_double(g.positions[i0]);
    const double u1 = double(uv[i1].x) - uv[i0].x, v1 = double(uv[i1].y) - uv[i0].y;
    const double u2 = double(uv[i2].x) - uv[i0].x, v2 = double(uv[i2].y) - uv[i0].y;
    const double determinant = u1 * v2 - u2 * v1;
    if (determinant == 0) return {};
    // Only the sign of the determinant: dividing by it would let slivers in UV space outweigh everything else.
    const double sign = determinant > 0 ? 1 : -1;
    return {(e1 * v2 - e2 * v1) * sign, (e2 * u1 - e1 * u2) * sign};
}

} // namespace

std::vector<Vec4> tangents_from_uv(const Geometry& g, const std::vector<Vec2>& uv) {
    std::vector<UvDirections> sums(g.positions.size());
    for (size_t t = 0; t < g.triangle_count(); ++t) {
        const UvDirections d = uv_directions(g, uv, t);
        for (size_t corner = 0; corner < 3; ++corner) {
            UvDirections& sum = sums[g.indices[3 * t + corner]];
            sum.u = sum.u + d.u;
            sum.v = sum.v + d.v;
        }
    }
    std::vector<Vec4> tangents(g.positions.size());
    for (size_t i = 0; i < tangents.size(); ++i) {
        const Vec3d n = normalize(to_double(g.normals[i]));
        const Vec3d in_plane = sums[i].u - n * dot(n, sums[i].u);
        const double size = length(in_plane);
        const Vec3d t = size > 0 && std::isfinite(size) ? in_plane * (1 / size) : any_perpendicular(n);
        // The bitangent, cross(normal, tangent) * w, points up in the image; v as stored grows downwards.
        const float w = dot(cross(n, t), sums[i].v) > 0 ? -1.0f : 1.0f;
        tangents[i] = {float(t.x), float(t.y), float(t.z), w};
    }
    return tangents;
}

} // namespace blush
