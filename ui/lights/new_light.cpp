#include "ui/lights/new_light.h"

#include "scene/affine.h"
#include "scene/geometry/ray_queries.h"
#include "scene/node_name.h"
#include "ui/lights/light_tools.h"
#include "ui/transform/rotation.h"
#include "ui/viewport/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace blush {
namespace {

constexpr double size_of_reach = 0.2, reach_factor = 0.45, max_reach_factor = 1.5;
constexpr double room_fraction = 0.6; // fraction of the distance to a wall

// Height of the image in metres at a distance along the view axis.
double reach_at(const View& view, double distance) {
    return view.lens.orthographic ? 2.0 * view.lens.ymag : 2 * distance * std::tan(view.lens.yfov_radians / 2.0);
}

// Radius of a sphere around the light.
double extent(const Light& light) {
    if (light.kind == Light::Kind::rectangle) return std::hypot(light.width, light.height) / 2;
    return light.kind == Light::Kind::sun ? 0 : double(light.radius);
}

// Distance from the position to the nearest surface of a light.
double clearance_at(const Scene& scene, const Vec3d& position) {
    double nearest = 1e300;
    for (const auto& [id, node] : scene.nodes) {
        const Light* light = scene.lights.find(node.light);
        if (light) nearest = std::min(nearest, length(world_from_node(scene, id).t - position) - extent(*light));
    }
    return nearest;
}

// The first candidate that keeps its distance from all lights; else the one farthest from all.
LightPlacement first_free(const Scene& scene, const std::vector<LightPlacement>& spots, double room) {
    const LightPlacement* best = &spots.front();
    double most = -1e300;
    for (const LightPlacement& spot : spots) {
        const double clearance = clearance_at(scene, spot.position);
        if (clearance > room) return spot;
        if (clearance > most) most = clearance, best = &spot;
    }
    return *best;
}

bool contains(const Bounds& box, const Vec3d& p) {
    return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y && p.z > box.low.z && p.z < box.high.z;
}

// Distance at which a ray from inside leaves the box; 0 if the origin is outside.
double distance_to_exit(const Bounds& box, const Vec3d& from, const Vec3d& direction) {
    if (box.empty || !contains(box, from)) return 0;
    double out = 1e300;
    const auto slab = [&](double o, double d, double low, double high) {
        if (d != 0) out = std::min(out, ((d > 0 ? high : low) - o) / d);
    };
    slab(from.x, direction.x, box.low.x, box.high.x);
    slab(from.y, direction.y, box.low.y, box.high.y);
    slab(from.z, direction.z, box.low.z, box.high.z);
    return out;
}

// Distance from a point inside a room to its wall: a surface that faces the point. The shell of an object around the point faces
// away and is skipped. Infinite in the open.
double distance_to_wall(const Scene& scene, const Vec3d& from, const Vec3d& direction) {
    constexpr int max_shells = 16;
    Vec3d origin = from;
    for (int i = 0; i < max_shells; ++i) {
        const auto hit = cast_ray(scene, origin, direction, [](Id<Node>) { return true; });
        if (!hit) break;
        const double distance = length(hit->position - from);
        const Vec3d outside = cross(hit->corners[1] - hit->corners[0], hit->corners[2] - hit->corners[0]);
        if (dot(outside, direction) < 0) return distance;
        origin = from + direction * (distance * (1 + 1e-9) + 1e-12);
    }
    return std::numeric_limits<double>::infinity();
}

// Direction by angles in degrees: about the vertical axis from the viewer's side to the right, and above the horizon.
struct Direction {
    double around, above, strength;
};
// Of the wanted distance to the subject: with less space, another direction is better.
constexpr double min_free_share = 0.4;
constexpr Direction key{40, 40, 1}, fill{-55, 15, 0.25}, rim{160, 45, 1};
constexpr Direction in_turn[] = {key, fill, rim, {0, 80, 1}, {-120, 35, 1}, {95, 20, 1}, {-20, 55, 1}, {70, 60, 1}, {-160, 15, 1}};

} // namespace

LightPlacement placement_above_surface(const Scene& scene, const View& view, const SurfacePoint& surface) {
    const Vec3d eye = to_double(view.position), right = rotate(view.rotation, {1, 0, 0});
    const Vec3d to_eye = view.lens.orthographic ? rotate(view.rotation, {0, 0, 1}) : normalize(eye - surface.position);
    const Vec3d normal = dot(surface.normal, to_eye) < 0 ? -surface.normal : surface.normal;
    const double reach = reach_at(view, length(eye - surface.position)), distance = reach_factor * reach;
    std::vector<LightPlacement> spots;
    for (const double lateral : {0.0, 0.7, -0.7, 1.4, -1.4, 2.8, -2.8}) {
        const Vec3d direction = normalize(normal + to_eye * 0.3 + Vec3d{0, 0.3, 0} + right * lateral);
        const double free =
            unoccluded_fraction(scene, surface.position, surface.position + direction * distance, [](Id<Node>) { return true; });
        spots.push_back({surface.position + direction * (distance * (free < 1 ? room_fraction * free : 1)), surface.position, 1});
    }
    return first_free(scene, spots, size_of_reach * reach);
}

LightPlacement placement_around_subject(const Scene& scene, const View& view, const Bounds& subject) {
    const Vec3d target = pivot(view), back = rotate(view.rotation, {0, 0, 1});
    const double reach = reach_at(view, view.pivot_distance), to_viewer = std::atan2(back.x, back.z);
    const bool in_room = !subject.empty && contains(subject, to_double(view.position));
    std::vector<Vec3d> directions;
    std::vector<double> farthest;
    for (const Direction& d : in_turn) {
        const double around = to_viewer + d.around * std::numbers::pi / 180, above = d.above * std::numbers::pi / 180;
        directions.push_back({std::sin(around) * std::cos(above), std::sin(above), std::cos(around) * std::cos(above)});
        farthest.push_back(room_fraction * distance_to_wall(scene, target, directions.back()));
    }
    std::vector<LightPlacement> spots, cramped;
    for (const double farther : {1.0, 1.4, 2.0})
        for (size_t i = 0; i < directions.size(); ++i) {
            const Vec3d& direction = directions[i];
            double distance = reach_factor * reach;
            // A floor that extends beyond the image is not a subject: the light need not be outside of it.
            if (const double out = in_room ? 0 : 1.1 * distance_to_exit(subject, target, direction); out < max_reach_factor * reach)
                distance = std::max(distance, out);
            // A light close to another object would light only a spot of it: other directions come first.
            const double free = std::min(distance * farther, farthest[i]);
            (free < min_free_share * distance ? cramped : spots).push_back({target + direction * free, target, in_turn[i].strength});
        }
    spots.insert(spots.end(), cramped.begin(), cramped.end());
    return first_free(scene, spots, size_of_reach * reach);
}

AddLight new_light(Light::Kind kind, const View& view, const LightPlacement& spot, float exposure_ev) {
    const double reach = reach_at(view, length(spot.target - to_double(view.position))), distance = length(spot.target - spot.position);
    AddLight add;
    add.light.name = add.node.name = kind_name(kind);
    add.light.kind = kind;
    add.light.width = add.light.height = float(size_of_reach * reach);
    if (is_per_area(kind)) add.light.radius = float(size_of_reach / 2 * reach);
    add.light.outer_cone_radians = 0.5f;
    add.light.inner_cone_radians = 0.4f;
    add.light.angle_radians = kind == Light::Kind::sun ? 0.00925f : 0;
    // White is displayed for reflectance x illuminance / pi = 1 at exposure 0.
    const double illuminance = spot.strength * std::numbers::pi * std::exp2(-exposure_ev);
    add.light.intensity = intensity_towards(add.light, illuminance * distance * distance, distance);
    add.node.local.translation = to_float(spot.position);
    add.node.local.rotation = looking_along(spot.target - spot.position);
    return add;
}

} // namespace blush
