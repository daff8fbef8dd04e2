// Computes the surface point of a hit: position with an error bound, normals, texture coordinates; and offsets ray origins
// against self-intersection.
#pragma once

#include "core/math.h"
#include "render/bvh/accel.h"
#include "render/compile/scene_tables.h"
#include "render/integrator/texture_point.h"
#include "shading/features.h"

#include <array>

namespace blush::inline BLUSH_ISA {

template <class F> struct Hit {
    F t, u, v;
    Int<F> geometry, instance, triangle; // geometry < 0: miss
};

template <class F> struct Surface {
    Vec<F> position;
    Vec<F> error;   // bound on |computed - exact| of the position, per axis
    Vec<F> ng, ns;  // unit: geometric, outward by winding; interpolated
    Vec<F> tangent; // not normalised; only where S needs it
    F tangent_sign;
    TexturePoint<F> texture; // only with Feature::textures
    Vec4T<F> color;
    Int<F> part, material;
    Mask<F> has_tangents;
};

// Half an ulp times n operations, Higham 2002: bounds the relative error of n roundings.
constexpr float gamma_bound(int n) { return float(n) * 0x1p-24f / (1 - float(n) * 0x1p-24f); }

// The next float up or down: +-1 ulp.
template <class F> F next_float(const F& x, const Mask<F>& up) {
    const UInt<F> b = to_unsigned(float_bits(x)); // unsigned: -0 has no lower neighbour, but its neighbours are not used
    const Mask<F> away = up == (x >= F(0.f));
    const UInt<F> next = select(away, UInt<F>(b + 1u), UInt<F>(b - 1u));
    const F from_zero = select(up, F(0x1p-126f), F(-0x1p-126f));
    return select(x == F(0.f), from_zero, float_from_bits(to_signed(next)));
}

// Offset along the unit normal `ng` that moves a point with this error bound off its plane.
template <class F> F clearance(const Vec<F>& ng, const Vec<F>& error) { return dot(abs(ng), error); }

// Origin of a ray leaving `position` by the vector `offset`: moved, then rounded away (Pharr, Jakob, Humphreys, "Physically Based
// Rendering", 6.8.6). No scene-wide epsilon.
template <class F> Vec<F> offset_origin(const Vec<F>& position, const Vec<F>& offset) {
    const auto push = [](const F& p, const F& by) {
        const F moved = p + by;
        return select(by == F(0.f), moved, next_float(moved, by > F(0.f)));
    };
    return {push(position.x, offset.x), push(position.y, offset.y), push(position.z, offset.z)};
}
// Offsets by the error bound to the outward or inward side of `ng`.
template <class F> Vec<F> offset_origin(const Vec<F>& position, const Vec<F>& error, const Vec<F>& ng, const Mask<F>& outward) {
    const F d = clearance(ng, error);
    return offset_origin(position, ng * select(outward, d, -d));
}

template <class F> struct TriangleVertices { Vec<F> p0, p1, p2; };
template <class F> TriangleVertices<F> gather_vertices(const float* positions, const Int<F>& i0, const Int<F>& i1, const Int<F>& i2) {
    return {gather3<F>(positions, i0), gather3<F>(positions, i1), gather3<F>(positions, i2)};
}

template <Features S, class F> Int<F> part_of(const SceneTables& scene, const Hit<F>& hit, const Mask<F>& active) {
    const Int<F> geometry = select(active, hit.geometry, Int<F>(0));
    if constexpr (S.has(Feature::instances)) {
        const Mask<F> through = active && as_mask(hit.instance >= 0);
        if (any(through)) {
            const Int<F> first = gather(scene.instance_first_part, select(through, hit.instance, Int<F>(0)));
            return select(through, Int<F>(first + geometry), geometry);
        }
    }
    return geometry;
}

// Lanes of `active` whose hit is on a wall that may transmit straight through (thin_transmission.h).
template <Features S, class F> Mask<F> is_pane(const SceneTables& scene, const Hit<F>& hit, const Mask<F>& active) {
    const Mask<F> surface = active && as_mask(hit.geometry >= 0) && !as_mask(hit.instance == sphere_instance);
    if (!any(surface)) return surface;
    const Int<F> material = gather_field(scene.parts, &PartRecord::material, part_of<S, F>(scene, hit, surface));
    return surface && as_mask((gather_field(scene.materials.materials, &MaterialRecord::flags, material) & int32_t(material_pane)) != 0);
}

// The triangle of a hit: its vertices, barycentric coordinates, and the flags of its part.
template <class F> struct HitTriangle {
    std::array<Int<F>, 3> vertices;
    std::array<F, 3> weights;
    Int<F> flags;

    // Interpolates value(vertex).
    template <class Value> auto interpolate(const Value& value) const {
        return value(vertices[0]) * weights[0] + value(vertices[1]) * weights[1] + value(vertices[2]) * weights[2];
    }
};
template <class F> [[gnu::always_inline]] inline HitTriangle<F> hit_triangle(const SceneTables& scene, const Hit<F>& hit,
                                                                             const Int<F>& part, const Mask<F>& active) {
    const Int<F> flags = gather_field(scene.parts, &PartRecord::flags, part);
    const Int<F> first_vertex = gather_field(scene.parts, &PartRecord::first_vertex, part);
    const Int<F> at = gather_field(scene.parts, &PartRecord::first_index, part) + select(active, hit.triangle, Int<F>(0)) * 3;
    const Int<F> i0 = first_vertex + to_signed(gather(scene.indices, at));
    const Int<F> i1 = first_vertex + to_signed(gather(scene.indices + 1, at));
    const Int<F> i2 = first_vertex + to_signed(gather(scene.indices + 2, at));
    return {{i0, i1, i2}, {1.f - hit.u - hit.v, hit.u, hit.v}, flags};
}

// Vectors of the hit triangle, not normalised: edges from its first vertex, geometric and interpolated normal.
template <class F> struct TriangleVectors { Vec<F> edge1, edge2, ng, ns; };

// Sets position and error, in object space; returns ng as ns.
//
// Position by barycentrics, whose error does not grow with the ray's length (PBR book 6.8.4). Besides the interpolation, the
// bound covers Embree's test of the next ray against the same triangle: its distance from the plane is rounded in proportion
// to the triangle's largest coordinate, whatever the axis, so the bound is the same for all three.
template <class F> [[gnu::always_inline]] inline TriangleVectors<F> place_on_triangle(const SceneTables& scene,
                                                                                      const HitTriangle<F>& triangle, Surface<F>& s) {
    const auto& [i0, i1, i2] = triangle.vertices;
    const auto& [b0, b1, b2] = triangle.weights;
    const TriangleVertices<F> v = gather_vertices<F>(scene.positions, i0, i1, i2);
    s.position = v.p0 * b0 + v.p1 * b1 + v.p2 * b2;
    const F extent = max(max_component(abs(v.p0)), max(max_component(abs(v.p1)), max_component(abs(v.p2))));
    s.error = splat<F>(1.f) * (extent * gamma_bound(8));
    const Vec<F> edge1 = v.p1 - v.p0, edge2 = v.p2 - v.p0;
    const Vec<F> ng = cross(edge1, edge2);
    const Vec<F> outward = select<F>(as_mask((triangle.flags & int32_t(part_mirrored)) != 0), -ng, ng);
    return {edge1, edge2, outward, outward};
}

// The vertices' normals, interpolated; the geometric normal on parts without normals. Not normalised.
template <class F> [[gnu::always_inline]] inline Vec<F> interpolated_normal(const SceneTables& scene, const HitTriangle<F>& triangle,
                                                                            const Vec<F>& ng, const Mask<F>& active) {
    const Mask<F> smooth = active && as_mask((triangle.flags & int32_t(part_smooth)) != 0);
    if (!any(smooth)) return ng;
    // Parts without normals share the index space: values gathered for them are not used.
    const Vec<F> n = triangle.interpolate([&](const Int<F>& i) { return gather3<F>(scene.normals, i); });
    return select<F>(smooth && dot(n, n) > F(0.f), n, ng);
}

template <Features S, class F> [[gnu::always_inline]] inline void
interpolate_tangent(const SceneTables& scene, const HitTriangle<F>& triangle, const Mask<F>& active, Surface<F>& s) {
    s.tangent = {F(1.f), F(0.f), F(0.f)};
    s.tangent_sign = F(1.f);
    s.has_tangents = Mask<F>(false);
    if constexpr (S.has(Feature::normal_maps) || S.has(Feature::anisotropy)) {
        s.has_tangents = active && as_mask((triangle.flags & int32_t(part_tangents)) != 0);
        if (any(s.has_tangents)) {
            const auto at4 = [&](int c, const Int<F>& i) { return gather(scene.tangents + c, Int<F>(i * 4)); };
            const auto mixed = [&](int c) { return triangle.interpolate([&](const Int<F>& i) { return at4(c, i); }); };
            s.tangent = {mixed(0), mixed(1), mixed(2)};
            s.tangent_sign = select(at4(3, triangle.vertices[0]) < F(0.f), F(-1.f), F(1.f));
        }
    }
}

// From the object space of an instance to world space. The error bound is that of the transform (PBR book 6.8.5).
template <Features S, class F> [[gnu::always_inline]] inline void transform_instance(const SceneTables& scene, const Mask<F>& active,
                                                                                     Surface<F>& s, TriangleVectors<F>& vectors) {
    if constexpr (S.has(Feature::instances)) {
        const Int<F> transform = gather_field(scene.parts, &PartRecord::transform, s.part);
        const Mask<F> instanced = active && as_mask(transform >= 0);
        if (!any(instanced)) return;
        const Int<F> row = select(instanced, transform, Int<F>(0)) * int32_t(sizeof(InstanceRecord) / 4);
        const float* first = &scene.instances->world_from_object.x.x;
        const auto column = [&](int c) { return Vec<F>{gather(first + c, row), gather(first + c + 1, row), gather(first + c + 2, row)}; };
        const Vec<F> x = column(0), y = column(3), z = column(6), t = column(9);
        const auto through = [&](const Vec<F>& p) { return x * p.x + y * p.y + z * p.z; };
        const auto bound = [&](const Vec<F>& p) { return abs(x) * p.x + abs(y) * p.y + abs(z) * p.z; };
        const Vec<F> world = through(s.position) + t;
        const F rounding = max_component(bound(abs(s.position)) + abs(t)) * gamma_bound(8);
        const Vec<F> error = bound(s.error) * (1.f + gamma_bound(3)) + splat<F>(1.f) * rounding;
        const Vec<F> nx = column(12), ny = column(15), nz = column(18);
        const auto normal = [&](const Vec<F>& n) { return nx * n.x + ny * n.y + nz * n.z; };
        s.position = select<F>(instanced, world, s.position);
        s.error = select<F>(instanced, error, s.error);
        vectors.ng = select<F>(instanced, normal(vectors.ng), vectors.ng);
        vectors.ns = select<F>(instanced, normal(vectors.ns), vectors.ns);
        s.tangent = select<F>(instanced, through(s.tangent), s.tangent);
        if constexpr (S.has(Feature::textures)) {
            vectors.edge1 = select<F>(instanced, through(vectors.edge1), vectors.edge1);
            vectors.edge2 = select<F>(instanced, through(vectors.edge2), vectors.edge2);
        }
    }
}

// The vertices' colours, interpolated; white on parts without.
template <Features S, class F>
[[gnu::always_inline]] inline Vec4T<F> vertex_color(const SceneTables& scene, const HitTriangle<F>& triangle, const Mask<F>& active) {
    if constexpr (S.has(Feature::vertex_colors)) {
        const Mask<F> present = active && as_mask((triangle.flags & int32_t(part_colors)) != 0);
        if (any(present)) {
            const auto mixed = [&](int c) {
                const F m = triangle.interpolate([&](const Int<F>& i) { return gather(scene.colors + c, Int<F>(i * 4)); });
                return select(present, m, F(1.f));
            };
            return {mixed(0), mixed(1), mixed(2), mixed(3)};
        }
    }
    return {F(1.f), F(1.f), F(1.f), F(1.f)};
}

// Interpolated attributes of `hit` in the lanes of `active`; elsewhere
// those of some valid triangle. Textures are filtered over `width` metres.
template <Features S, class F>
Surface<F> surface_at(const SceneTables& scene, const Hit<F>& hit, const Mask<F>& active, const F& width = F(0.f)) {
    Surface<F> s;
    s.part = part_of<S, F>(scene, hit, active);
    s.material = gather_field(scene.parts, &PartRecord::material, s.part);
    const HitTriangle<F> triangle = hit_triangle<F>(scene, hit, s.part, active);
    TriangleVectors<F> vectors = place_on_triangle<F>(scene, triangle, s);
    vectors.ns = interpolated_normal<F>(scene, triangle, vectors.ng, active);
    interpolate_tangent<S, F>(scene, triangle, active, s);
    transform_instance<S, F>(scene, active, s, vectors);
    s.ng = normalize(vectors.ng);
    s.ns = normalize(vectors.ns);
    if constexpr (S.has(Feature::textures)) {
        const Footprint<F> footprint{width, length(cross(vectors.edge1, vectors.edge2))};
        s.texture = texture_point<F>(scene, triangle.flags, triangle.vertices, triangle.weights, active, footprint);
    }
    s.color = vertex_color<S, F>(scene, triangle, active);
    return s;
}

} // namespace blush::inline BLUSH_ISA
