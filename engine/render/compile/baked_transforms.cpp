#include "render/compile/baked_transforms.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "scene/affine.h"
#include "scene/geometry/arena_geometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace blush {
namespace {

// A singular value below this fraction of the largest is rounding error of an exactly singular product.
constexpr double zero_share = 1e-13;

double min_scale(double largest, const Vec3d& translation) {
    return std::max({min_relative_scale * largest, min_absolute_scale, min_scale_by_distance * length(translation)});
}

bool fits_float(const Affined& m) { return is_finite(to_double(to_float(m))); }

// Lower bound of the smallest singular value, determinant / norm^2: sufficient for nearly all transforms, and cheap.
bool is_clearly_invertible(const Affined& m) {
    const double norm_squared = dot(m.x, m.x) + dot(m.y, m.y) + dot(m.z, m.z);
    return norm_squared > 0 && std::abs(determinant(m)) >= norm_squared * min_scale(std::sqrt(norm_squared), m.t);
}

// m * v has orthogonal columns w.
struct Columns {
    Vec3d w[3], v[3];
};

Columns orthogonalised(const Affined& m) {
    Columns c{{m.x, m.y, m.z}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    constexpr int max_sweeps = 30;
    bool turned = true;
    for (int sweep = 0; turned && sweep < max_sweeps; ++sweep) {
        turned = false;
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                const double a = dot(c.w[p], c.w[p]), b = dot(c.w[q], c.w[q]), d = dot(c.w[p], c.w[q]);
                if (!(std::abs(d) > 1e-12 * std::sqrt(a * b))) continue;
                turned = true;
                const double zeta = (b - a) / (2 * d);
                const double t = (zeta < 0 ? -1 : 1) / (std::abs(zeta) + std::hypot(1, zeta)), cosine = 1 / std::hypot(1, t),
                             sine = t * cosine;
                for (Vec3d* columns : {c.w, c.v}) {
                    const Vec3d first = columns[p];
                    columns[p] = first * cosine - columns[q] * sine;
                    columns[q] = first * sine + columns[q] * cosine;
                }
            }
    }
    return c;
}

// m += u * v^T
void add_outer(Affined& m, const Vec3d& u, const Vec3d& v) {
    m.x = m.x + u * v.x;
    m.y = m.y + u * v.y;
    m.z = m.z + u * v.z;
}

Vec3 unit_or(const Vec3d& v, const Vec3& otherwise) {
    const double size = length(v);
    return size > 0 && std::isfinite(size) ? to_float(v * (1 / size)) : otherwise;
}

size_t unique_triangles(const std::vector<SceneObject>& objects) {
    std::set<uint64_t> known;
    size_t n = 0;
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts)
            if (known.insert(part.geometry->serial).second) n += part.geometry->triangle_count();
    return n;
}

// False if the transform flattens every triangle to a line or a point: a wall scaled by 0 in height. Ends at the first triangle
// with area.
bool keeps_area(const SceneObject& object, const Affined& m) {
    for (const MeshPart& part : object.parts) {
        const Geometry& g = *part.geometry;
        const auto corner = [&](size_t i) { return transform_vector(m, to_double(g.positions[g.indices[i]])); };
        for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
            const Vec3d a = corner(i), along = corner(i + 1) - a, across = corner(i + 2) - a;
            if (length(cross(along, across)) > zero_share * length(along) * length(across)) return true;
        }
    }
    return false;
}

bool has_area(const SceneObject& object, const PlaceSplit& split) {
    return split.has_area && (split.invertible || keeps_area(object, split.stretch));
}

bool all_invertible(const SceneObject& object) {
    for (size_t copy = 0; copy < object.copies(); ++copy) {
        const PlaceSplit split = split_place(object.world_from_copy(copy));
        if (!split.has_area || !split.invertible) return false;
    }
    return true;
}

Affined as_affine(const BakedTransforms::Stretch& s) { return {{s[0], s[1], s[2]}, {s[3], s[4], s[5]}, {s[6], s[7], s[8]}, {0, 0, 0}}; }

struct SortedPlaces {
    std::vector<Affined> invertible;
    std::map<BakedTransforms::Stretch, std::vector<Affined>> stretched;
    size_t without_area = 0;
};

SortedPlaces sort_places(const SceneObject& object) {
    SortedPlaces sorted;
    for (size_t copy = 0; copy < object.copies(); ++copy) {
        const Affined m = object.world_from_copy(copy);
        const PlaceSplit split = split_place(m);
        const Affined& s = split.stretch;
        if (!split.has_area)
            ++sorted.without_area;
        else if (split.invertible)
            sorted.invertible.push_back(m);
        else
            sorted.stretched[{s.x.x, s.x.y, s.x.z, s.y.x, s.y.y, s.y.z, s.z.x, s.z.y, s.z.z}].push_back(split.place);
    }
    return sorted;
}

SceneObject at_places(const SceneObject& object, std::vector<Affined> places) {
    SceneObject placed = object;
    placed.instances = nullptr;
    placed.places = std::move(places);
    return placed;
}

constexpr const char* without_area = "no area; the transform flattens it to a line or a point, or is not finite";

void warn(const Scene& scene, const SceneObject& object, size_t count, const char* why, std::vector<Diagnostic>& left_out) {
    if (count == 0) return;
    const size_t all = object.copies();
    left_out.push_back({Diagnostic::Severity::warning,
                        all == 1 ? fmt::format("an object is not rendered: {}", why)
                                 : fmt::format("{} of {} instances are not rendered: {}", count, all, why),
                        node_label(scene, object.node)});
}

} // namespace

PlaceSplit split_place(const Affined& m) {
    PlaceSplit split;
    split.has_area = fits_float(m);
    if (!split.has_area || is_clearly_invertible(m)) return split;
    const Columns c = orthogonalised(m);
    double scale[3];
    for (int i = 0; i < 3; ++i) scale[i] = length(c.w[i]);
    const double largest = std::max({scale[0], scale[1], scale[2]});
    if (std::ranges::count_if(scale, [&](double s) { return s > zero_share * largest; }) < 2) {
        split.has_area = false;
        return split;
    }
    const double least = min_scale(largest, m.t);
    const bool some_stay = largest >= least;
    const double base = some_stay ? largest : std::max(1.0, min_scale_by_distance * length(m.t));
    // Axes that do not change are kept bit for bit, so that transforms flattened in the same way have the same stretch.
    constexpr Vec3d zero{0, 0, 0};
    split.place = some_stay ? m : Affined{zero, zero, zero, m.t};
    if (!some_stay) split.stretch = {zero, zero, zero, zero};
    for (int i = 0; i < 3; ++i) {
        if (scale[i] >= least) continue;
        split.invertible = false;
        const bool is_zero = !(scale[i] > zero_share * largest);
        // The two others are not zero: the third axis is perpendicular to both.
        const Vec3d direction =
            is_zero ? normalize(cross(c.w[(i + 1) % 3] * (1 / largest), c.w[(i + 2) % 3] * (1 / largest))) : c.w[i] / scale[i];
        add_outer(split.place, some_stay ? direction * base - c.w[i] : direction * base, c.v[i]);
        add_outer(split.stretch, c.v[i] * ((is_zero ? 0 : scale[i] / base) - (some_stay ? 1 : 0)), c.v[i]);
    }
    return split;
}

GeometryPtr BakedTransforms::baked(const GeometryPtr& geometry, const Stretch& s, Shapes& used) const {
    const auto key = std::pair(geometry->serial, s);
    GeometryPtr& shape = used[key];
    if (shape) return shape;
    if (const auto known = known_.find(key); known != known_.end()) return shape = known->second;
    const Affined stretch = as_affine(s), normals = cofactor(stretch);
    auto result = std::make_shared<Geometry>(*geometry);
    result->serial = next_payload_serial();
    for (Vec3& p : result->positions) p = to_float(transform_vector(stretch, to_double(p)));
    for (Vec3& n : result->normals) n = unit_or(transform_vector(normals, to_double(n)), n);
    for (Vec4& t : result->tangents) {
        const Vec3 along = unit_or(transform_vector(stretch, Vec3d{t.x, t.y, t.z}), {t.x, t.y, t.z});
        t = {along.x, along.y, along.z, t.w};
    }
    move_to_arena(*result);
    return shape = std::move(result);
}

void BakedTransforms::bake(const Scene& scene, std::vector<SceneObject>& objects, std::vector<Diagnostic>& left_out) {
    Shapes used;
    const size_t budget = std::max(max_baked_triangles, unique_triangles(objects));
    std::set<std::pair<uint64_t, Stretch>> made;
    size_t triangles = 0;
    std::vector<SceneObject> result;
    result.reserve(objects.size());
    for (SceneObject& object : objects) {
        const bool flat = !object.instanced; // its vertices are in world space: any transform will do
        if (flat && !is_expanded(object.node))
            warn(scene, object, !has_area(object, split_place(object.world_from_object)), without_area, left_out);
        if (flat || all_invertible(object)) {
            result.push_back(std::move(object));
            continue;
        }
        SortedPlaces sorted = sort_places(object);
        size_t over_budget = 0;
        if (!sorted.invertible.empty()) result.push_back(at_places(object, std::move(sorted.invertible)));
        for (auto& [stretch, places] : sorted.stretched) {
            if (!keeps_area(object, as_affine(stretch))) {
                sorted.without_area += places.size();
                continue;
            }
            size_t more = 0;
            for (const MeshPart& part : object.parts)
                if (!made.contains({part.geometry->serial, stretch})) more += part.geometry->triangle_count();
            if (triangles + more > budget) {
                over_budget += places.size();
                continue;
            }
            triangles += more;
            SceneObject baked_object = at_places(object, std::move(places));
            for (MeshPart& part : baked_object.parts) {
                made.emplace(part.geometry->serial, stretch);
                part.geometry = baked(part.geometry, stretch, used);
            }
            result.push_back(std::move(baked_object));
        }
        warn(scene, object, sorted.without_area, without_area, left_out);
        warn(scene, object, over_budget, "too many triangles in flattened shapes", left_out);
    }
    objects = std::move(result);
    known_ = std::move(used);
}

} // namespace blush
