#include "render/compile/expand_area_lights.h"

#include "render/compile/expanded_lights.h"
#include "render/lights/light_limits.h"
#include "scene/animation/posed_scene.h"
#include "scene/lights/light_units.h"
#include "scene/lights/light_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

// Unit square in the XY plane, facing -Z, the direction of lights.
GeometryPtr unit_rectangle() {
    static const GeometryPtr shared = [] {
        auto g = std::make_shared<Geometry>();
        g->positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
        g->indices = {0, 2, 1, 0, 3, 2};
        return g;
    }();
    return shared;
}

// Tessellates a disk: a regular polygon in the XY plane, facing -Z, with the area of the unit disk.
GeometryPtr make_unit_disk(uint32_t corners) {
    const double step = 2 * std::numbers::pi / corners;
    const double radius = std::sqrt(step / std::sin(step));
    auto g = std::make_shared<Geometry>();
    g->positions.push_back({0, 0, 0});
    for (uint32_t i = 0; i < corners; ++i) {
        g->positions.push_back({float(radius * std::cos(i * step)), float(radius * std::sin(i * step)), 0});
        g->indices.insert(g->indices.end(), {0, 1 + (i + 1) % corners, 1 + i});
    }
    return g;
}

GeometryPtr unit_disk(int corners) {
    static const auto shared = [] {
        std::array<GeometryPtr, disk_corner_choices.size()> disks;
        std::ranges::transform(disk_corner_choices, disks.begin(), make_unit_disk);
        return disks;
    }();
    return shared[size_t(std::ranges::find(disk_corner_choices, corners) - disk_corner_choices.begin())];
}

Material emitter(const Light& light, const Vec3& nits) {
    Material m;
    m.name = light.name;
    m.base_color = {0, 0, 0};
    m.metallic = 0;
    m.specular = 0;
    m.emissive = nits;
    m.double_sided = light.two_sided;
    return m;
}

struct AreaShape {
    GeometryPtr geometry;
    Vec3 scale;
};

AreaShape shape_of(const Light& light, int corners) {
    if (light.kind == Light::Kind::rectangle) return {unit_rectangle(), {light.width, light.height, 1}};
    return {unit_disk(corners), {light.radius, light.radius, 1}};
}

} // namespace

Scene expand_area_lights(const Scene& whole, ExpandedMeshes* known, const Workers* workers) {
    Scene scene = with_solo_applied(with_pose_applied(whole));
    ExpandedMeshes none;
    ExpandedMeshes& meshes = known ? *known : none;
    meshes.tangents.provide(scene);
    meshes.deformed.deform(scene, workers);
    ExtendedTable<Node>::Records bodies;
    ExtendedTable<Mesh>::Records shapes;
    ExtendedTable<Material>::Records emitters;
    const std::vector<Id<Node>> nodes = nodes_with_lights(scene);
    const int corners = disk_corners(scene, nodes);
    for (const Id<Node> id : nodes) {
        const Node& node = *scene.nodes.find(id);
        const Light* light = scene.lights.find(node.light);
        if (!is_area_light(*light)) continue;
        // Meshes of disabled lights remain, so that switching a light changes no list of objects (is_disabled_mesh).
        const AreaShape shape = shape_of(*light, corners);
        const uint32_t key = expanded_id_bit | node.light.value;
        // Nodes may share a light; tables keep the first of equal records.
        emitters.push_back({Id<Material>{key}, emitter(*light, light->enabled ? light_emission(*light) : Vec3{0, 0, 0})});
        shapes.push_back({Id<Mesh>{key}, {light->name, {{shape.geometry, Id<Material>{key}}}}});
        Node body;
        body.parent = id;
        body.local.scale = shape.scale;
        body.mesh = Id<Mesh>{key};
        bodies.push_back({Id<Node>{expanded_id_bit | id.value}, std::move(body)});
    }
    scene.nodes = meshes.nodes.extended(scene.nodes, std::move(bodies));
    scene.meshes = meshes.meshes.extended(scene.meshes, std::move(shapes));
    scene.materials = meshes.materials.extended(scene.materials, std::move(emitters));
    return scene;
}

} // namespace blush
