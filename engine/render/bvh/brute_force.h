// Tests rays against all triangles of a small scene, a register of rays at a time. In scenes of some tens of triangles this is several
// times faster than a BVH: no ray waits for nodes that only others visit, and nothing is gathered.
//
// The vertices are projected along each ray once. A triangle contains the ray if the origin of the projection is on the same side of all
// its edges, or on them. Triangles that share an edge compute its side from the same numbers, with the opposite sign and otherwise to the
// bit, so that no ray passes between them (Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection"; instead of shearing
// along the ray's largest axis, a basis around the ray is used, which needs no permutation of coordinates).
#pragma once

#include "core/lanes.h"
#include "core/math.h"
#include "render/bvh/accel.h"
#include "render/bvh/small_scene.h"

#include <limits>

namespace blush::inline BLUSH_ISA {

// Rays in the lanes of F, and the scene's vertices as they see them.
template <class F> struct ProjectedScene {
    Vec<F> origin, direction;
    F far;
    UInt<F> mask;
    alignas(64) float x[SmallScene::max_positions][width<F>], y[SmallScene::max_positions][width<F>];
    // Distance to each plane; infinite if the plane is not in front of the ray. The watertight test accepts distance 0, but a ray must
    // not hit the surface that it starts on.
    alignas(64) float distance[SmallScene::max_triangles][width<F>];

    ProjectedScene(const SmallScene& scene, const RayArrays& rays, int k) {
        origin = {load<F>(rays.ox + k), load<F>(rays.oy + k), load<F>(rays.oz + k)};
        direction = {load<F>(rays.dx + k), load<F>(rays.dy + k), load<F>(rays.dz + k)};
        far = rays.far_distance ? load<F>(rays.far_distance + k) : F(infinity);
        mask = rays.masks ? load<UInt<F>>(rays.masks + k) : UInt<F>(rays.mask);
        const Basis<F> basis = basis_around(direction * (1.f / sqrt(dot(direction, direction))));
        for (size_t i = 0; i < scene.positions.size(); ++i) {
            const Vec<F> to = splat<F>(scene.positions[i]) - origin;
            store(x[i], dot(to, basis.s));
            store(y[i], dot(to, basis.t));
        }
        for (size_t i = 0; i < scene.planes.size(); ++i) {
            const SmallScene::Plane& plane = scene.planes[i];
            const Vec<F> normal = splat<F>(plane.normal);
            const F t = dot(normal, splat<F>(plane.point) - origin) / dot(normal, direction);
            store(distance[i], select(t >= F(std::numeric_limits<float>::min()), t, F(infinity))); // not if NaN
        }
    }

    // On which side of the edges of a face the ray passes.
    struct Sides {
        F x[4], y[4], of_edge[4]; // the edge from vertex k to the next
        // Those of faces that are seen from the edge are all 0.
        Mask<F> contain() const {
            const F least = min(min(of_edge[0], of_edge[1]), min(of_edge[2], of_edge[3])),
                    most = max(max(of_edge[0], of_edge[1]), max(of_edge[2], of_edge[3]));
            return (least >= F(0.f) && most > F(0.f)) || (most <= F(0.f) && least < F(0.f));
        }
    };
    Sides sides(const SmallScene::Face& face) const {
        Sides s;
        for (int k = 0; k < 4; ++k) {
            s.x[k] = load<F>(x[face.vertices[k]]);
            s.y[k] = load<F>(y[face.vertices[k]]);
        }
        for (int k = 0; k < 4; ++k) s.of_edge[k] = s.x[k] * s.y[(k + 1) % 4] - s.x[(k + 1) % 4] * s.y[k];
        return s;
    }
    Mask<F> sees(const SmallScene& scene, const SmallScene::Face& face) const {
        return scene.masked ? Mask<F>(as_mask((mask & face.mask) != 0u)) : Mask<F>(true);
    }
};

// The hit of a face: weights of the vertices of one of its triangles, up to a factor.
template <class F> struct FaceHit {
    F weights[3]{F(1.f), F(0.f), F(0.f)};
    Int<F> triangle = -1; // of SmallScene::triangles

    // The triangle on whose side of the diagonal the ray passes.
    void select_from(const typename ProjectedScene<F>::Sides& s, int32_t face, const Mask<F>& hit) {
        const F diagonal = s.x[2] * s.y[0] - s.x[0] * s.y[2];
        const F sum = s.of_edge[0] + s.of_edge[1] + s.of_edge[2] + s.of_edge[3];
        const Mask<F> first = select(sum >= F(0.f), diagonal >= F(0.f), diagonal <= F(0.f));
        weights[0] = select(hit, select(first, s.of_edge[1], s.of_edge[2]), weights[0]);
        weights[1] = select(hit, select(first, diagonal, s.of_edge[3]), weights[1]);
        weights[2] = select(hit, select(first, s.of_edge[0], F(-diagonal)), weights[2]);
        triangle = select(hit, select(first, Int<F>(2 * face), Int<F>(2 * face + 1)), triangle);
    }
    void store_to(const SmallScene& scene, const HitArrays& hits, int k) const {
        const Mask<F> any_hit = as_mask(triangle >= 0);
        const Int<F> i = select(any_hit, triangle, Int<F>(0));
        const auto field = [&](auto member) { return gather_field(scene.triangles.data(), member, i); };
        const Int<F> turn = field(&SmallScene::Triangle::turn);
        const Mask<F> none = as_mask(turn == 0), once = as_mask(turn == 1);
        const F over_sum = 1.f / (weights[0] + weights[1] + weights[2]);
        store(hits.u + k, select(none, weights[1], select(once, weights[2], weights[0])) * over_sum);
        store(hits.v + k, select(none, weights[2], select(once, weights[0], weights[1])) * over_sum);
        store(hits.geometry + k, select(any_hit, field(&SmallScene::Triangle::geometry), Int<F>(-1)));
        store(hits.triangle + k, select(any_hit, field(&SmallScene::Triangle::index), Int<F>(-1)));
        store(hits.instance + k, Int<F>(-1));
    }
};

// Calls visit(face, distance, lanes whose distance is less than `limit`, which may shrink) for all faces.
template <class F, class Visit> void for_each_face(const SmallScene& scene, const ProjectedScene<F>& seen, const F& limit, Visit visit) {
    int32_t face = 0;
    for (size_t i = 0; i < scene.planes.size(); ++i) {
        const F distance = load<F>(seen.distance[i]);
        const Mask<F> nearer = distance < limit;
        const int32_t end = scene.planes[i].end;
        if (any(nearer))
            for (; face < end; ++face) visit(face, distance, nearer);
        face = end;
    }
}

// Closest hits; as Accel::intersect.
template <class F> [[gnu::flatten]] void intersect_all(const SmallScene& scene, const RayArrays& rays, int count, const HitArrays& hits) {
    for (int k = 0; k < count; k += width<F>) {
        const ProjectedScene<F> seen(scene, rays, k);
        F t = seen.far;
        FaceHit<F> closest;
        for_each_face(scene, seen, t, [&](int32_t i, const F& distance, const Mask<F>& nearer) {
            const SmallScene::Face& face = scene.faces[size_t(i)];
            const auto sides = seen.sides(face);
            const Mask<F> hit = nearer && sides.contain() && seen.sees(scene, face);
            if (!any(hit)) return;
            t = select(hit, distance, t);
            closest.select_from(sides, i, hit);
        });
        store(hits.t + k, t);
        closest.store_to(scene, hits, k);
    }
}

// As Accel::occluded.
template <class F> [[gnu::flatten]] void occluded_by_any(const SmallScene& scene, const RayArrays& rays, int count, uint8_t* blocked) {
    for (int k = 0; k < count; k += width<F>) {
        const ProjectedScene<F> seen(scene, rays, k);
        Mask<F> hit = !(seen.far >= F(0.f));
        F limit = select(hit, F(0.f), seen.far);
        for_each_face(scene, seen, limit, [&](int32_t i, const F&, const Mask<F>& nearer) {
            const SmallScene::Face& face = scene.faces[size_t(i)];
            hit = hit || (nearer && seen.sides(face).contain() && seen.sees(scene, face));
            limit = select(hit, F(0.f), limit);
        });
        const unsigned lanes = bits(hit);
        for (int n = 0; n < width<F> && k + n < count; ++n) blocked[k + n] = lanes >> n & 1;
    }
}

// The closest hits of rays, by the tracer that suits the scene.
template <class F> void trace_closest(const Accel& accel, const RayArrays& rays, int count, bool coherent, const HitArrays& hits) {
    if (const SmallScene* scene = accel.small_scene())
        intersect_all<F>(*scene, rays, count, hits);
    else
        accel.intersect(rays, count, coherent, hits);
}
// Whether rays hit anything, by the same tracer.
template <class F> void trace_any(const Accel& accel, const RayArrays& rays, int count, bool coherent, uint8_t* blocked) {
    if (const SmallScene* scene = accel.small_scene())
        occluded_by_any<F>(*scene, rays, count, blocked);
    else
        accel.occluded(rays, count, coherent, blocked);
}

} // namespace blush::inline BLUSH_ISA
