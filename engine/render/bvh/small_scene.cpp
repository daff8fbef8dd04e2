#include "render/bvh/small_scene.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace blush {
namespace {

constexpr double min_relative_height = 1e-4;
constexpr double min_diagonal = 1e-12; // metres; the largest is its reciprocal
// Largest distance of a vertex from the plane of another triangle that it shares, in diagonals of the scene: well below rounding.
constexpr double max_relative_distance = 1e-10;
// Least area of the triangles, of that of the bounding box: in open scenes most rays miss the boxes of a BVH, which then is as fast.
constexpr double min_area_share = 0.8;
// Least sine of the angles of a quadrilateral.
constexpr double min_corner_sine = 1e-3;

struct Corners {
    int32_t vertices[3];
    uint32_t mask;
    SmallScene::Triangle triangle;
};

struct Builder {
    SmallScene scene;
    std::vector<Corners> found;
    std::map<std::tuple<float, float, float>, int32_t> known;
    Vec3d low{0, 0, 0}, high{0, 0, 0};

    Vec3d position(int32_t vertex) const { return to_double(scene.positions[size_t(vertex)]); }
    Vec3d edge(int32_t from, int32_t to) const { return position(to) - position(from); }
    Vec3d normal(const Corners& c) const { return cross(edge(c.vertices[0], c.vertices[1]), edge(c.vertices[0], c.vertices[2])); }
    double diagonal() const { return length(high - low); }

    int32_t vertex(const Vec3& p) {
        const auto [at, is_new] = known.try_emplace({p.x, p.y, p.z}, int32_t(scene.positions.size()));
        if (!is_new) return at->second;
        const Vec3d d = to_double(p);
        low = scene.positions.empty() ? d : Vec3d{std::min(low.x, d.x), std::min(low.y, d.y), std::min(low.z, d.z)};
        high = scene.positions.empty() ? d : Vec3d{std::max(high.x, d.x), std::max(high.y, d.y), std::max(high.z, d.z)};
        scene.positions.push_back(p);
        return at->second;
    }

    // False if a position is not finite.
    bool add(const AccelTriangles& mesh, size_t geometry) {
        if (mesh.mask == 0) return true;
        scene.masked |= mesh.mask != seen_by_all;
        for (size_t i = 0; i < mesh.triangle_count; ++i) {
            Corners c{{}, mesh.mask, {int32_t(geometry), int32_t(i), 0}};
            for (size_t k = 0; k < 3; ++k) {
                const Vec3& p = mesh.positions[mesh.indices[3 * i + k]];
                if (!std::isfinite(p.x + p.y + p.z)) return false;
                c.vertices[k] = vertex(p);
            }
            if (length(normal(c)) > 0) found.push_back(c);
        }
        return true;
    }

    double area() const {
        double sum = 0;
        for (const Corners& c : found) sum += 0.5 * length(normal(c));
        return sum;
    }
    double area_of_bounds() const {
        const Vec3d size = high - low;
        return 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    }
    bool is_narrow(const Corners& c) const {
        const double longest = std::max({length(edge(c.vertices[0], c.vertices[1])), length(edge(c.vertices[1], c.vertices[2])),
                                         length(edge(c.vertices[2], c.vertices[0]))});
        return !(length(normal(c)) >= min_relative_height * diagonal() * longest);
    }
    bool in_plane(const SmallScene::Plane& plane, const Corners& c) const {
        return std::ranges::all_of(c.vertices, [&](int32_t v) {
            return std::abs(dot(to_double(plane.normal), position(v) - to_double(plane.point))) <= max_relative_distance * diagonal();
        });
    }

    bool is_convex(const int32_t (&v)[4], const Vec3d& up) const {
        for (int k = 0; k < 4; ++k) {
            const Vec3d before = edge(v[(k + 3) % 4], v[k]), after = edge(v[k], v[(k + 1) % 4]);
            if (!(dot(cross(before, after), up) >= min_corner_sine * length(before) * length(after))) return false;
        }
        return true;
    }

    // The quadrilateral of two triangles with a common edge, which run around it in the same sense.
    bool add_quadrilateral(const Corners& a, const Corners& b) {
        if (a.mask != b.mask) return false;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                // The edge from `last` to `first` of a.
                const int32_t first = a.vertices[i], last = a.vertices[(i + 2) % 3];
                if (b.vertices[k] != first || b.vertices[(k + 1) % 3] != last) continue;
                const int32_t v[4] = {first, a.vertices[(i + 1) % 3], last, b.vertices[(k + 2) % 3]};
                if (v[3] == v[1] || !is_convex(v, normalize(normal(a)))) continue;
                add_face({{v[0], v[1], v[2], v[3]}, a.mask}, a, b, (3 - i) % 3, (3 - k) % 3);
                return true;
            }
        return false;
    }
    void add_face(const SmallScene::Face& face, const Corners& a, const Corners& b, int turn_a, int turn_b) {
        scene.faces.push_back(face);
        scene.triangles.push_back({a.triangle.geometry, a.triangle.index, turn_a});
        scene.triangles.push_back({b.triangle.geometry, b.triangle.index, turn_b});
    }

    void add_plane(std::vector<Corners> rest) {
        SmallScene::Plane plane{to_float(normalize(normal(rest[0]))), scene.positions[size_t(rest[0].vertices[0])]};
        while (!rest.empty()) {
            const Corners a = rest.front();
            rest.erase(rest.begin());
            const auto b = std::ranges::find_if(rest, [&](const Corners& other) { return add_quadrilateral(a, other); });
            if (b == rest.end())
                add_face({{a.vertices[0], a.vertices[1], a.vertices[2], a.vertices[0]}, a.mask}, a, a, 0, 0);
            else
                rest.erase(b);
        }
        plane.end = int32_t(scene.faces.size());
        scene.planes.push_back(plane);
    }
    void add_planes() {
        while (!found.empty()) {
            const SmallScene::Plane plane{to_float(normalize(normal(found[0]))), scene.positions[size_t(found[0].vertices[0])]};
            // The first face is in its plane, up to the rounding of the normal.
            const auto others = std::stable_partition(found.begin() + 1, found.end(), [&](const Corners& c) { return in_plane(plane, c); });
            add_plane({found.begin(), others});
            found.erase(found.begin(), others);
        }
    }
};

} // namespace

std::optional<SmallScene> make_small_scene(const AccelScene& scene) {
    if (!scene.instances.empty() || !scene.spheres.empty()) return {};
    size_t count = 0;
    for (const AccelTriangles& mesh : scene.flat) {
        count += mesh.mask ? mesh.triangle_count : 0;
        if (mesh.alpha || count > size_t(SmallScene::max_triangles)) return {};
    }
    Builder b;
    for (size_t geometry = 0; geometry < scene.flat.size(); ++geometry)
        if (!b.add(scene.flat[geometry], geometry)) return {};
    // Products of coordinates neither overflow nor underflow.
    if (!(b.diagonal() >= min_diagonal && b.diagonal() <= 1 / min_diagonal)) return {};
    if (b.area() < min_area_share * b.area_of_bounds()) return {};
    if (b.found.empty() || std::ranges::any_of(b.found, [&](const Corners& c) { return b.is_narrow(c); })) return {};
    b.add_planes();
    return std::move(b.scene);
}

} // namespace blush
