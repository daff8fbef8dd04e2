#include "ui/transform/transform_edits.h"

#include "scene/affine.h"
#include "scene/animation/pose.h"
#include "scene/lights/light_units.h"
#include "scene/node_name.h"
#include "ui/lights/multi_edit.h"
#include "ui/transform/rotation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush {
namespace {

constexpr float min_size = 1e-4f;

bool has_children(const Scene& scene, Id<Node> id) {
    return std::ranges::any_of(scene.nodes, [&](const auto& entry) { return entry.value.parent == id; });
}

// Factor by which the transform scales the axis; negative if it flips it.
double stretch(const Motion& motion, const Vec3d& axis) {
    const double n = length(axis);
    if (!(n > 0)) return 1;
    const Vec3d unit = axis / n, to = motion.direction(unit);
    return dot(to, unit) < 0 ? -length(to) : length(to);
}

Light scaled(const Light& before, const Affined& world_from_node, const Motion& motion) {
    const auto factor = [&](const Vec3d& axis) { return std::abs(stretch(motion, axis)); };
    const double x = factor(world_from_node.x), y = factor(world_from_node.y), all = std::cbrt(x * y * factor(world_from_node.z));
    const auto size = [](float value, double by) { return value > 0 ? std::max(float(value * by), min_size) : value; };
    Light light = before;
    switch (light.kind) {
    case Light::Kind::rectangle:
        light.width = size(light.width, x);
        light.height = size(light.height, y);
        break;
    case Light::Kind::disk: light.radius = size(light.radius, std::sqrt(x * y)); break;
    case Light::Kind::sphere:
    case Light::Kind::point:
    case Light::Kind::spot: light.radius = size(light.radius, all); break;
    case Light::Kind::sun: light.angle_radians = std::min(float(light.angle_radians * all), std::numbers::pi_v<float>); break;
    }
    return with_same_power(before, light);
}

Affined moved(const TransformTarget& target, const Motion& motion) {
    const Affined& m = target.world_from_node;
    const Vec3d t = motion.point(m.t);
    if (motion.mode == TransformMode::rotate) return {motion.direction(m.x), motion.direction(m.y), motion.direction(m.z), t};
    if (motion.mode == TransformMode::scale && !target.light)
        return {m.x * stretch(motion, m.x), m.y * stretch(motion, m.y), m.z * stretch(motion, m.z), t};
    return {m.x, m.y, m.z, t};
}

bool is_rotation_invariant(const Light& light) {
    return (light.kind == Light::Kind::point || light.kind == Light::Kind::sphere) && !light.ies;
}

bool has_size(const Light& light) {
    if (light.kind == Light::Kind::sun) return light.angle_radians > 0;
    return light.kind == Light::Kind::rectangle || light.radius > 0;
}

} // namespace

std::vector<TransformTarget> transform_targets(const Scene& scene, std::span<const Id<Node>> selection) {
    std::vector<TransformTarget> targets;
    for (const Id<Node> id : subtree_roots(scene, selection)) {
        const Node& node = *scene.nodes.find(id);
        if (node.skin || is_transform_animated(scene, id)) continue;
        TransformTarget target{id, world_from_node(scene, id), {}, {}};
        const Light* light = scene.lights.find(node.light);
        if (light && !node.mesh && !has_children(scene, id)) target.light = node.light, target.light_before = *light;
        targets.push_back(target);
    }
    return targets;
}

std::string why_not(const Scene& scene, std::span<const TransformTarget> targets, TransformMode mode) {
    if (targets.empty()) return "The selection cannot be transformed: it is driven by an animation or a skin";
    if (targets.size() != 1 || !targets[0].light || mode == TransformMode::grab) return {};
    const Light& light = *scene.lights.find(targets[0].light);
    const std::string name = node_name(scene, targets[0].node, *scene.nodes.find(targets[0].node));
    if (mode == TransformMode::rotate && is_rotation_invariant(light)) return name + " emits uniformly: rotation has no effect";
    if (mode == TransformMode::scale && !has_size(light))
        return name + (light.kind == Light::Kind::sun ? " has no angle to scale: set its Angle first"
                                                      : " has no size to scale: set its Radius first");
    return {};
}

bool scales_along_axes(std::span<const TransformTarget> targets) {
    return targets.size() > 1 || (targets.size() == 1 && (!targets[0].light || targets[0].light_before.kind == Light::Kind::rectangle));
}

std::vector<Edit> transform_edits(const Scene& scene, std::span<const TransformTarget> targets, const Motion& motion) {
    std::vector<Edit> edits;
    std::vector<Id<Light>> scaled_lights; // each once, although several nodes can share it
    for (const TransformTarget& target : targets) {
        const Node* record = scene.nodes.find(target.node);
        if (!record) continue;
        Node node = *record;
        if (motion.mode == TransformMode::grab) {
            node.local = moved_to(scene, target.node, motion.point(target.world_from_node.t));
        } else {
            const Affined parent = world_from_parent(scene, node);
            if (std::abs(determinant(parent)) > 1e-300) node.local = to_transform(inverse(parent) * moved(target, motion));
        }
        if (node != *record) edits.push_back(SetNode{target.node, node});
        if (motion.mode != TransformMode::scale || !scene.lights.contains(target.light) || std::ranges::count(scaled_lights, target.light))
            continue;
        scaled_lights.push_back(target.light);
        edits.push_back(SetLight{target.light, scaled(target.light_before, target.world_from_node, motion)});
    }
    return edits;
}

std::string transform_label(const Scene& scene, std::span<const TransformTarget> targets, TransformMode mode) {
    static constexpr const char* verbs[] = {"Move", "Rotate", "Scale"};
    const char* verb = verbs[size_t(mode)];
    if (targets.size() != 1) return fmt::format("{} {} objects", verb, targets.size());
    const Node* node = scene.nodes.find(targets[0].node);
    return fmt::format("{} {}", verb, node ? node_name(scene, targets[0].node, *node) : "object");
}

Vec3d handle_point(const Scene& scene, Id<Node> id) {
    const Node& node = *scene.nodes.find(id);
    const Bounds bounds = node.mesh ? world_bounds(scene, id) : Bounds{};
    return bounds.empty ? world_from_node(scene, id).t : bounds.center();
}

std::array<Vec3d, 3> local_axes(const Scene& scene, Id<Node> node) {
    const Quat q = scene.nodes.contains(node) ? world_rotation(scene, node) : Quat{};
    return {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1})};
}

} // namespace blush
