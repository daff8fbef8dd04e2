#include "scene/geometry/mikktspace.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

namespace blush {
namespace {

constexpr int none = -1;

// At a vertex with more triangles the angular test is skipped: it is quadratic, and a file may join a million triangles at one
// vertex.
constexpr size_t max_compared = 64;

bool not_zero(double x) { return std::abs(x) > double(FLT_MIN); }
Vec3d unit_or_same(const Vec3d& v) {
    const double size = length(v);
    return not_zero(size) ? v * (1 / size) : v;
}
Vec3d in_plane(const Vec3d& v, const Vec3d& normal) { return unit_or_same(v - normal * dot(normal, v)); }

struct Triangle {
    std::array<uint32_t, 3> vertices{};             // welded
    std::array<int, 3> neighbors{none, none, none}; // across the edge from corner k to k + 1
    std::array<int, 3> groups{none, none, none};    // of each corner
    Vec3d along_u{0, 0, 0}, along_v{0, 0, 0};       // directions of increasing u and v: unit length, or 0
    bool keeps_orientation = false;                 // false: UVs are mirrored
    bool follows = false;                           // degenerate UVs: joins the group of a neighbour
    bool degenerate = false;                        // two corners coincide

    size_t corner_of(uint32_t vertex) const { return size_t(std::ranges::find(vertices, vertex) - vertices.begin()); }
};

struct Group {
    uint32_t vertex = 0;
    bool keeps_orientation = false;
    std::vector<uint32_t> triangles;
};

class TangentSpace {
public:
    TangentSpace(const Geometry& g, const GeometryArray<Vec2>& uv) : g_(g), uv_(uv), triangles_(g.triangle_count()) {
        weld();
        for (size_t t = 0; t < triangles_.size(); ++t) describe(t);
        connect();
        group();
    }

    std::vector<Vec4> corners() const {
        std::vector<std::optional<Vec4>> tangents(g_.indices.size());
        for (const Group& group : groups_) mean(group, tangents);
        const std::vector<int> stand_ins = corners_by_vertex();
        std::vector<Vec4> corners(tangents.size());
        for (size_t i = 0; i < corners.size(); ++i) {
            const Triangle& triangle = triangles_[i / 3];
            const uint32_t vertex = triangle.vertices[i % 3];
            const int from = triangle.degenerate ? stand_ins[vertex] : int(i);
            const Vec3 any = to_float(any_perpendicular(normal(vertex)));
            corners[i] = from == none ? Vec4{any.x, any.y, any.z, 1} : tangents[size_t(from)].value_or(Vec4{any.x, any.y, any.z, 1});
        }
        return corners;
    }

private:
    Vec3d position(uint32_t vertex) const { return to_double(g_.positions[vertex]); }
    Vec3d normal(uint32_t vertex) const { return unit_or_same(to_double(g_.normals[vertex])); }

    // Welds equal vertices to the first of them.
    void weld() {
        const auto key = [&](uint32_t i) {
            const Vec3 &p = g_.positions[i], &n = g_.normals[i];
            return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, uv_[i].x, uv_[i].y);
        };
        std::vector<uint32_t> order(g_.positions.size()), first(order.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::sort(order, [&](uint32_t a, uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
        for (size_t i = 0; i < order.size(); ++i)
            first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
        for (size_t i = 0; i < g_.indices.size(); ++i) triangles_[i / 3].vertices[i % 3] = first[g_.indices[i]];
    }

    void describe(size_t index) {
        Triangle& triangle = triangles_[index];
        const auto [a, b, c] = triangle.vertices;
        const Vec3 &pa = g_.positions[a], &pb = g_.positions[b], &pc = g_.positions[c];
        triangle.degenerate = pa == pb || pa == pc || pb == pc;
        // In single precision like the reference implementation, so that triangles of tiny UV area get the same orientation as in
        // the baker.
        const float u1 = uv_[b].x - uv_[a].x, v1 = uv_[b].y - uv_[a].y, u2 = uv_[c].x - uv_[a].x, v2 = uv_[c].y - uv_[a].y;
        const float area = u1 * v2 - v1 * u2;
        triangle.keeps_orientation = area > 0;
        const Vec3d e1 = position(b) - position(a), e2 = position(c) - position(a);
        const Vec3d along_u = e1 * double(v2) - e2 * double(v1), along_v = e2 * double(u1) - e1 * double(u2);
        triangle.follows = !not_zero(area) || !not_zero(length(along_u)) || !not_zero(length(along_v));
        if (!not_zero(area)) return;
        triangle.along_u = unit_or_same(along_u) * (area > 0 ? 1.0 : -1.0);
        triangle.along_v = unit_or_same(along_v) * (area > 0 ? 1.0 : -1.0);
    }

    // An edge connects two triangles that traverse it in opposite directions; of more than two, the first ones.
    void connect() {
        struct Edge {
            uint32_t low, high, triangle;
            int corner;
            bool upwards;
        };
        std::vector<Edge> edges;
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            if (triangles_[t].degenerate) continue;
            for (int k = 0; k < 3; ++k) {
                const uint32_t from = triangles_[t].vertices[size_t(k)], to = triangles_[t].vertices[size_t((k + 1) % 3)];
                edges.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
            }
        }
        const auto key = [](const Edge& e) { return std::tuple(e.low, e.high, e.triangle, e.corner); };
        std::ranges::sort(edges, {}, key);
        for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
            // Pairs the k-th ascending with the k-th descending edge.
            const std::span same(edges.data() + begin, end - begin);
            auto up = same.begin(), down = same.begin();
            while (true) {
                up = std::find_if(up, same.end(), [](const Edge& e) { return e.upwards; });
                down = std::find_if(down, same.end(), [](const Edge& e) { return !e.upwards; });
                if (up == same.end() || down == same.end()) break;
                triangles_[up->triangle].neighbors[size_t(up->corner)] = int(down->triangle);
                triangles_[down->triangle].neighbors[size_t(down->corner)] = int(up->triangle);
                ++up;
                ++down;
            }
        }
    }

    void group() {
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            if (triangles_[t].follows || triangles_[t].degenerate) continue;
            for (size_t k = 0; k < 3; ++k)
                if (triangles_[t].groups[k] == none) gather(t, triangles_[t].vertices[k], triangles_[t].keeps_orientation);
        }
    }

    // New group: all triangles that are connected to triangle `seed` by edges at the vertex.
    void gather(uint32_t seed, uint32_t vertex, bool keeps_orientation) {
        const int index = int(groups_.size());
        Group& group = groups_.emplace_back(Group{vertex, keeps_orientation, {}});
        std::vector<int> waiting{int(seed)};
        while (!waiting.empty()) {
            const int t = waiting.back();
            waiting.pop_back();
            if (t == none) continue;
            Triangle& triangle = triangles_[size_t(t)];
            const size_t k = triangle.corner_of(vertex);
            if (k == 3 || triangle.groups[k] != none) continue;
            if (triangle.follows && std::ranges::count(triangle.groups, none) == 3) triangle.keeps_orientation = keeps_orientation;
            if (triangle.keeps_orientation != keeps_orientation) continue;
            triangle.groups[k] = index;
            group.triangles.push_back(uint32_t(t));
            waiting.push_back(triangle.neighbors[(k + 2) % 3]);
            waiting.push_back(triangle.neighbors[k]);
        }
        std::ranges::sort(group.triangles);
    }

    // A triangle of a group, projected along the vertex normal.
    struct Member {
        size_t corner; // into the geometry's indices
        bool follows;
        Vec3d along_u, along_v;
        double angle;

        // Opposite directions are not averaged.
        bool mixes_with(const Member& other) const {
            const auto opposite = [](const Vec3d& a, const Vec3d& b) { return float(dot(a, b)) <= -1; };
            return follows || other.follows || (!opposite(along_u, other.along_u) && !opposite(along_v, other.along_v));
        }
    };

    std::vector<Member> members(const Group& group) const {
        const Vec3d n = normal(group.vertex), at = position(group.vertex);
        std::vector<Member> members;
        for (const uint32_t t : group.triangles) {
            const Triangle& triangle = triangles_[t];
            const size_t k = triangle.corner_of(group.vertex);
            const Vec3d before = in_plane(position(triangle.vertices[(k + 2) % 3]) - at, n);
            const Vec3d after = in_plane(position(triangle.vertices[(k + 1) % 3]) - at, n);
            members.push_back({3 * t + k, triangle.follows, in_plane(triangle.along_u, n), in_plane(triangle.along_v, n),
                               std::acos(std::clamp(dot(before, after), -1.0, 1.0))});
        }
        return members;
    }

    // Tangents of the group's corners; none where the directions cancel.
    void mean(const Group& group, std::vector<std::optional<Vec4>>& tangents) const {
        const std::vector<Member> all = members(group);
        const auto of_those = [&](auto&& counts) -> std::optional<Vec4> {
            Vec3d sum{0, 0, 0};
            for (const Member& m : all)
                if (!m.follows && counts(m)) sum = sum + m.along_u * m.angle;
            const double size = length(sum);
            if (!not_zero(size) || !std::isfinite(size)) return std::nullopt;
            const Vec3 t = to_float(sum * (1 / size));
            return Vec4{t.x, t.y, t.z, group.keeps_orientation ? -1.0f : 1.0f};
        };
        const std::optional<Vec4> shared = of_those([](const Member&) { return true; });
        for (const Member& m : all) {
            const auto mixes = [&](const Member& other) { return &other == &m || m.mixes_with(other); };
            tangents[m.corner] = all.size() > max_compared || std::ranges::all_of(all, mixes) ? shared : of_those(mixes);
        }
    }

    // First grouped corner of each vertex. Degenerate triangles copy its tangent: they are invisible, but must not split vertices
    // of their neighbours.
    std::vector<int> corners_by_vertex() const {
        std::vector<int> corners(g_.positions.size(), none);
        for (size_t i = 0; i < g_.indices.size(); ++i)
            if (int& corner = corners[triangles_[i / 3].vertices[i % 3]]; corner == none && triangles_[i / 3].groups[i % 3] != none)
                corner = int(i);
        return corners;
    }

    const Geometry& g_;
    const GeometryArray<Vec2>& uv_;
    std::vector<Triangle> triangles_;
    std::vector<Group> groups_;
};

} // namespace

std::vector<Vec4> mikktspace_tangents(const Geometry& geometry, const GeometryArray<Vec2>& uv) {
    return TangentSpace(geometry, uv).corners();
}

} // namespace blush
