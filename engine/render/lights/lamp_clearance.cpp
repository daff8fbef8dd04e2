#include "render/lights/lamp_clearance.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "render/lights/hull_triangles.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace blush {
namespace {

// Least share of the triangles on the hull for which a clearance box pays: a torus has a half of them, a cloud nearly none.
constexpr double min_share_on_hull = 0.25;
// The box without other geometry is larger than the mesh by this share of its largest side on each side; kernels get a box half as far
// away.
constexpr double relative_margin = 1.0 / 32;
// For rounding of positions and of rays in instances, of the largest coordinate.
constexpr double rounding_margin = 0x1p-18;
// Metres: Embree's queries square distances in single precision.
constexpr double min_side = 1e-12;

// Limit of lamps times instances: each lamp asks for the place of each instance, some 10 ns.
constexpr int64_t max_places = int64_t(1) << 22;

constexpr ClearanceBox infinite_box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};

// True if the projections of a triangle and of the box [-half, half] onto `axis` are disjoint.
bool are_separated(const Vec3d& axis, const std::array<Vec3d, 3>& corners, const Vec3d& half) {
    const auto [low, high] = std::minmax({dot(axis, corners[0]), dot(axis, corners[1]), dot(axis, corners[2])});
    const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    return low > reach || high < -reach;
}

// Separating axis theorem (Akenine-Möller 2001, "Fast 3D Triangle-Box Overlap Testing").
bool overlaps(const std::array<Vec3d, 3>& corners, const Vec3d& half) {
    constexpr std::array<Vec3d, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const auto separates = [&](const Vec3d& axis) { return are_separated(axis, corners, half); };
    if (std::ranges::any_of(axes, separates)) return false;
    const std::array<Vec3d, 3> edges{corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
    if (separates(cross(edges[0], edges[1]))) return false;
    for (const Vec3d& edge : edges)
        for (const Vec3d& axis : axes)
            if (separates(cross(edge, axis))) return false;
    return true;
}

bool sphere_overlaps(const Vec3d& center, double radius, const Vec3d& half) {
    const Vec3d outside{std::max(0.0, std::abs(center.x) - half.x), std::max(0.0, std::abs(center.y) - half.y),
                        std::max(0.0, std::abs(center.z) - half.z)};
    return length(outside) <= radius;
}

struct Scenery {
    const Accel& accel;
    const GeometryPool& geometry;
    const SceneTables& tables;
    const std::vector<AccelSphere>& spheres;

    // True if no geometry but that part is within `half` of `center` along each axis.
    bool is_empty(const Vec3d& center, const Vec3d& half, int32_t part) const {
        for (const AccelSphere& sphere : spheres)
            if (sphere_overlaps(to_double(sphere.center) - center, double(sphere.radius), half)) return false;
        bool empty = true;
        accel.visit_near(to_float(center), float(length(half) * (1 + relative_margin)), tables.instances, [&](const NearTriangle& t) {
            const int32_t other = t.geometry + (t.instance >= 0 ? tables.instance_first_part[t.instance] : 0);
            if (other == part) return true;
            Vec3 corners[3];
            geometry.corners(size_t(other), t.triangle, corners);
            empty = !overlaps({to_double(corners[0]) - center, to_double(corners[1]) - center, to_double(corners[2]) - center}, half);
            return empty;
        });
        return empty;
    }
};

// `low`, `high`: bounds of that part.
ClearanceBox clearance_box(const Scenery& scenery, const Vec3d& low, const Vec3d& high, int32_t part) {
    const Vec3d size = high - low, center = (low + high) * 0.5;
    const double largest_side = std::max({size.x, size.y, size.z});
    const double largest = largest_side + std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    const double margin = relative_margin * largest_side + 2 * rounding_margin * largest;
    const auto half_with = [&](double m) { return size * 0.5 + Vec3d{m, m, m}; };
    if (!(largest_side >= min_side) || !scenery.is_empty(center, half_with(margin), part)) return infinite_box;
    return {to_float(center - half_with(margin / 2)), to_float(center + half_with(margin / 2))};
}

} // namespace

std::shared_ptr<const LampClearances::Hull> LampClearances::hull_of(const Geometry& mesh, Hulls& used, const Workers& workers) const {
    std::shared_ptr<const Hull>& hull = used[mesh.serial];
    if (hull) return hull;
    if (const auto known = hulls_.find(mesh.serial); known != hulls_.end()) return hull = known->second;
    Hull made{hull_triangles(mesh, workers)};
    made.useful = double(std::ranges::count(made.triangles, 1)) >= min_share_on_hull * double(made.triangles.size());
    return hull = std::make_shared<const Hull>(std::move(made));
}

bool LampClearances::find_lamps(const std::vector<SceneObject>& objects, const GeometryPool& geometry, MeshLights& lights,
                                const Workers& workers) {
    Hulls used;
    const std::vector<Lamp> before = std::exchange(lamps_, {});
    for (const MeshLightEntry& entry : lights.entries) {
        if (entry.count < min_triangles_of_a_lamp || is_expanded(entry.node)) continue;
        const auto first = lights.records.begin() + entry.light;
        const std::shared_ptr<const Hull> hull = hull_of(geometry.mesh_of(objects, size_t(first->part)), used, workers);
        if (!hull->useful) continue;
        for (int32_t i = 0; i < entry.count; ++i)
            if (hull->triangles[size_t(i)]) first[i].clearance = int32_t(lamps_.size());
        lamps_.push_back({first->part, entry.bounds.low, entry.bounds.high});
    }
    hulls_ = std::move(used);
    return lamps_ != before;
}

void LampClearances::find_clear_lamps(const Accel& accel, const GeometryPool& geometry, const SceneTables& tables,
                                      const std::vector<AccelSphere>& spheres, const Workers& workers) {
    const Scenery scenery{accel, geometry, tables, spheres};
    boxes_.assign(lamps_.size(), infinite_box);
    clear_lamps_ = 0;
    if (int64_t(lamps_.size()) * geometry.instance_count() > max_places) return;
    workers.for_each(int64_t(lamps_.size()), {}, [&](int64_t i, unsigned) {
        const Lamp& lamp = lamps_[size_t(i)];
        boxes_[size_t(i)] = clearance_box(scenery, to_double(lamp.low), to_double(lamp.high), lamp.part);
    });
    clear_lamps_ = size_t(std::ranges::count_if(boxes_, [](const ClearanceBox& box) { return box.high.x < infinity; }));
}

} // namespace blush
