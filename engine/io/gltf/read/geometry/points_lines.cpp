#include "io/gltf/read/geometry/points_lines.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace blush {
namespace {

constexpr double share_of_diagonal = 1.0 / 500;
constexpr float radius_of_one_place = 0.005f; // metres, before the node's scale
constexpr uint32_t sides = 6;

bool is_finite_point(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Vertices of solids, each with its source vertex for the attributes.
struct Builder {
    Geometry solids;
    std::vector<uint32_t> origins;

    void add(uint32_t origin, const Vec3d& center, const Vec3d& normal, double radius) {
        origins.push_back(origin);
        solids.positions.push_back(to_float(center + normal * radius));
        solids.normals.push_back(to_float(normal));
    }
    uint32_t next() const { return uint32_t(origins.size()); }
};

// A regular icosahedron, counter-clockwise from outside.
void add_ball(Builder& b, uint32_t vertex, const Vec3d& center, double radius) {
    constexpr uint32_t faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    constexpr double g = std::numbers::phi;
    constexpr double corners[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                       {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    const uint32_t first = b.next();
    for (const auto& c : corners) b.add(vertex, center, normalize(Vec3d{c[0], c[1], c[2]}), radius);
    for (const auto& face : faces)
        for (const uint32_t corner : face) b.solids.indices.push_back(first + corner);
}

// A prism with a pyramid at each end, so that connected tubes leave no gap and the mesh is closed.
void add_tube(Builder& b, uint32_t from, uint32_t to, const Vec3d& a, const Vec3d& c, double radius) {
    const Vec3d along = normalize(c - a), u = any_perpendicular(along), v = cross(along, u);
    const uint32_t first = b.next();
    for (const auto& [vertex, center] : {std::pair(from, a), std::pair(to, c)})
        for (uint32_t k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            b.add(vertex, center, u * std::cos(angle) + v * std::sin(angle), radius);
        }
    const uint32_t begin = b.next(), end = begin + 1;
    b.add(from, a, along * -1.0, radius);
    b.add(to, c, along, radius);
    for (uint32_t k = 0; k < sides; ++k) {
        const uint32_t p = first + k, q = first + (k + 1) % sides, r = p + sides, s = q + sides;
        b.solids.indices.insert(b.solids.indices.end(), {p, q, s, p, s, r, begin, q, p, end, r, s});
    }
}

// Vertex pairs of the segments.
std::vector<std::pair<uint32_t, uint32_t>> segments_of(std::span<const uint32_t> order, int mode) {
    std::vector<std::pair<uint32_t, uint32_t>> segments;
    for (size_t i = 0; i + 1 < order.size(); i += mode == 1 ? 2 : 1) segments.emplace_back(order[i], order[i + 1]);
    if (mode == 2 && order.size() > 2) segments.emplace_back(order.back(), order.front());
    return segments;
}

template <class V> void take(GeometryArray<V>& target, const GeometryArray<V>& source, const std::vector<uint32_t>& origins) {
    if (source.empty()) return;
    target.reserve(origins.size());
    for (const uint32_t origin : origins) target.push_back(source[origin]);
}

} // namespace

float mark_radius(const GeometryArray<Vec3>& positions) {
    Bounds box;
    for (const Vec3& p : positions) box.include(to_double(p));
    const double diagonal = box.empty ? 0 : length(box.high - box.low);
    const auto radius = float(diagonal * share_of_diagonal);
    return radius > 0 && std::isfinite(radius) ? radius : radius_of_one_place;
}

Solids solids_of(const Geometry& vertices, std::span<const uint32_t> order, int mode) {
    Solids made;
    made.radius = mark_radius(vertices.positions);
    Builder b;
    const auto position = [&](uint32_t i) { return to_double(vertices.positions[i]); };
    const auto is_place = [&](uint32_t i) { return is_finite_point(vertices.positions[i]); };
    size_t asked = 0;
    if (mode == 0) {
        asked = order.size();
        for (size_t i = 0; i < asked && made.shown < max_points_and_segments; ++i) {
            if (!is_place(order[i])) continue;
            add_ball(b, order[i], position(order[i]), double(made.radius));
            ++made.shown;
        }
    } else {
        const auto segments = segments_of(order, mode);
        asked = segments.size();
        for (size_t i = 0; i < asked && made.shown < max_points_and_segments; ++i) {
            const auto [from, to] = segments[i];
            if (!is_place(from) || !is_place(to) || vertices.positions[from] == vertices.positions[to]) continue;
            add_tube(b, from, to, position(from), position(to), double(made.radius));
            ++made.shown;
        }
    }
    made.left_out = asked - made.shown;
    b.solids.uv.resize(vertices.uv.size());
    for (size_t set = 0; set < vertices.uv.size(); ++set) take(b.solids.uv[set], vertices.uv[set], b.origins);
    take(b.solids.colors, vertices.colors, b.origins);
    made.geometry = std::move(b.solids);
    return made;
}

} // namespace blush
