#include "render/lights/light_table.h"

#include "core/distribution.h"
#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "render/lights/light_limits.h"
#include "scene/affine.h"
#include "scene/lights/light_units.h"
#include "scene/lights/sky_model.h"
#include "scene/world_transforms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace blush {
namespace {

struct TableBuilder {
    NeeLights aim = NeeLights::all_lights;
    LightTable table;
    std::vector<LightBounds> bounds; // by entry of the light tree
    int64_t luminaires = 0;          // at finite distance; an area light counts once, not per triangle

    // `where`: of a light at finite distance; null: it is at infinity.
    void add(const LightRecord& record, Id<Node> node, double power, const LightBounds* where = nullptr) {
        if (where) {
            add_entry({nullptr, int32_t(table.records.size()), no_trail}, *where);
            ++luminaires;
        }
        table.records.push_back(record);
        if (where) table.records.back().slot = ~(int32_t(bounds.size()) - 1);
        table.nodes.push_back(node);
        table.powers.push_back(usable_power(power));
    }
    // Adds a light that rays can also hit.
    void add_findable(const LightRecord& record, Id<Node> node, double power, const LightBounds* where = nullptr) {
        add(record, node, aim == NeeLights::all_lights ? power : 0, where);
    }
    void add_entry(const LightTreeEntry& entry, const LightBounds& where) {
        table.tree.entries.push_back(entry);
        bounds.push_back(where);
    }
    void add_all(const MeshLights& meshes) {
        table.records = meshes.records;
        table.nodes = meshes.nodes;
        table.powers = meshes.powers;
        table.profiles = meshes.profiles;
        table.emissive_triangles = meshes.emissive_triangles;
        table.unsampled_triangles = meshes.unsampled_triangles;
        for (const MeshLightEntry& entry : meshes.entries) {
            add_entry({entry.tree ? &entry.tree->tables() : nullptr, entry.light, no_trail}, entry.bounds);
            if (entry.tree) table.tree.meshes.push_back(entry.tree);
        }
        luminaires = meshes.luminaires;
    }
};

// Bounds of an omnidirectional light at `center`, or of a spot's cone.
LightBounds sphere_bounds(const Vec3& center, double radius, const Light& light, const Affined& world) {
    LightBounds b;
    const Vec3d c = to_double(center), r{radius, radius, radius};
    b.low = to_float(c - r);
    b.high = to_float(c + r);
    b.corners = {center, center, center};
    b.margin = radius;
    const Vec3d axis = world.z * -1.0;
    const bool is_spot = light.kind == Light::Kind::spot && dot(axis, axis) > 0;
    constexpr float right_angle = 0.5f * std::numbers::pi_v<float>;
    b.axis = is_spot ? to_float(normalize(axis)) : Vec3{0, 0, -1};
    b.theta_o = is_spot ? light.inner_cone_radians : std::numbers::pi_v<float>;
    b.theta_e = is_spot ? std::min(light.outer_cone_radians - b.theta_o + float(angle_margin), right_angle) : right_angle;
    return b;
}

void add_spheres(TableBuilder& b, const Scene& scene, const std::vector<SphereLight>& spheres, const Vec3d& origin) {
    WorldTransforms transforms(scene);
    b.table.first_sphere = int32_t(b.table.records.size());
    for (const SphereLight& sphere : spheres) {
        const Light& light = *scene.lights.find(sphere.light);
        const LightProfiles::Added profile = b.table.profiles.add(light, transforms(sphere.node).world_from_node);
        LightRecord record{};
        record.kind = int32_t(LightKind::sphere);
        record.profile = profile.profile;
        record.object = int32_t(sphere.node.value);
        record.position = to_float(sphere.center - origin);
        record.radius = float(sphere.radius);
        const double disk = std::numbers::pi * sphere.radius * sphere.radius; // projected area
        // The luminous intensity of a point or spot is that of its sphere in every direction.
        record.emission = light.enabled ? light_emission(light) : Vec3{0, 0, 0};
        if (light.kind != Light::Kind::sphere) record.emission = to_float(to_double(record.emission) * (1 / disk));
        ++b.table.sphere_lights;
        const LightBounds bounds = sphere_bounds(record.position, sphere.radius, light, transforms(sphere.node).world_from_node);
        b.add_findable(record, sphere.node, 4 * std::numbers::pi * disk * luminance_of(record.emission) * profile.share, &bounds);
    }
}

LightRecord sun_record(const Vec3& towards, float angle_radians, const Vec3& lux) {
    LightRecord record{};
    record.kind = int32_t(LightKind::sun);
    record.profile = -1;
    record.position = towards;
    const double half = 0.5 * double(angle_radians), s = std::sin(0.5 * half);
    record.cone_height = float(2 * s * s);
    // Radiance of the disk from the stated illuminance on a facing surface: E = L pi sin^2(half angle).
    record.emission = record.cone_height > 0 ? lux / float(std::numbers::pi * std::sin(half) * std::sin(half)) : lux;
    return record;
}

void add_sun(TableBuilder& b, const LightRecord& record, Id<Node> node, double lux, double scene_radius) {
    if (record.cone_height > 0) b.table.suns.push_back(int32_t(b.table.records.size()));
    ++b.table.sun_lights;
    const double power = std::numbers::pi * scene_radius * scene_radius * lux;
    record.cone_height > 0 ? b.add_findable(record, node, power) : b.add(record, node, power);
}

void add_punctual(TableBuilder& b, const Scene& scene, const std::vector<Id<Node>>& nodes, double scene_radius, const Vec3d& origin) {
    WorldTransforms transforms(scene);
    for (const Id<Node> id : nodes) {
        const Light* light = scene.lights.find(scene.nodes.find(id)->light);
        if (!light->enabled || is_area_light(*light) || is_sphere_light(*light) || !transforms(id).visible) continue;
        const Affined& world = transforms(id).world_from_node;
        const Vec3 emission = light_emission(*light);
        if (light->kind == Light::Kind::sun) {
            LightRecord record = sun_record(to_float(normalize(world.z)), light->angle_radians, emission);
            if (!light->visible_to_camera) record.flags |= light_hidden;
            add_sun(b, record, id, luminance_of(emission), scene_radius);
            continue;
        }
        const LightProfiles::Added profile = b.table.profiles.add(*light, world);
        LightRecord record{};
        record.kind = int32_t(LightKind::point);
        record.profile = profile.profile;
        record.position = to_float(world.t - origin);
        record.emission = emission;
        ++b.table.point_lights;
        const LightBounds bounds = sphere_bounds(record.position, 0, *light, world);
        b.add(record, id, 4 * std::numbers::pi * luminance_of(emission) * profile.share, &bounds);
    }
}

// A part of the samples is distributed uniformly over all lights (uniform_share).
std::vector<double> with_defensive_mixture(std::span<const double> powers, std::span<const double> factors) {
    std::vector<double> weights(powers.begin(), powers.end());
    double total = 0, emitting = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (!factors.empty()) weights[i] *= factors[i];
        total += weights[i];
        emitting += powers[i] > 0;
    }
    for (size_t i = 0; i < weights.size(); ++i)
        if (powers[i] > 0) weights[i] = (1 - uniform_share) * (total > 0 ? weights[i] / total : 0) + uniform_share / emitting;
    return weights;
}

// Powers of the tree's entries, and by slot; of a table with a tree.
struct TablePowers {
    std::vector<double> entries, slots;
};
TablePowers table_powers(const LightTable& table, std::span<const double> powers) {
    TablePowers p{std::vector(table.tree.entries.size(), 0.0), std::vector(table.slot_lights.size(), 0.0)};
    for (size_t i = 0; i < powers.size(); ++i) {
        const int32_t slot = table.records[i].slot;
        (slot < 0 ? p.entries[size_t(~slot)] : p.slots[size_t(slot)]) += powers[i];
    }
    for (const double power : p.entries) p.slots[0] += power;
    return p;
}

// Puts lights at finite distance into a tree, which uses the first slot; each other light gets its own slot. False, and no tree,
// if no light at finite distance emits.
bool add_tree(TableBuilder& b, const std::vector<double>& powers, const Workers& workers) {
    LightTable& table = b.table;
    table.slot_lights = {0};
    for (size_t i = 0; i < table.records.size(); ++i) {
        LightRecord& record = table.records[i];
        if (record.slot < 0 || (int32_t(i) == table.environment && !table.samples_environment)) continue;
        record.slot = int32_t(table.slot_lights.size());
        table.slot_lights.push_back(int32_t(i));
    }
    const TablePowers p = table_powers(table, powers);
    for (size_t i = 0; i < b.bounds.size(); ++i) b.bounds[i].power = p.entries[i];
    LightTreeShape shape = build_light_tree(b.bounds, workers);
    if (shape.nodes.empty()) {
        table.slot_lights.clear();
        return false;
    }
    for (size_t i = 0; i < shape.trails.size(); ++i) table.tree.entries[i].trail = shape.trails[i];
    for (LightTreeNode& node : shape.nodes)
        for (int32_t& child : node.child)
            if (child < 0) child = ~shape.items[size_t(~child)];
    set_light_tree_powers(shape.nodes, p.entries);
    table.tree.nodes = std::move(shape.nodes);
    table.thresholds = make_thresholds(p.slots);
    table.count = int32_t(table.slot_lights.size());
    return true;
}

} // namespace

LightTable build_light_table(const Scene& scene, const MeshLights& meshes, const std::vector<Id<Node>>& nodes,
                             const std::vector<SphereLight>& spheres, const SkyLight& sky, const Extent& extent, NeeLights aim,
                             const Workers& workers) {
    TableBuilder b;
    b.aim = aim;
    if (const int corners = disk_corners(scene, nodes); corners < max_disk_corners) b.table.fewer_disk_corners = corners;
    b.add_all(meshes);
    add_spheres(b, scene, spheres, extent.origin);
    const double radius = extent.bounds.empty ? 1 : std::max(extent.bounds.radius(), 1e-30);
    add_punctual(b, scene, nodes, radius, extent.origin);
    if (const SkySun sun = sun_of(scene.environment); luminance_of(sun.lux) > 0) {
        LightRecord record = sun_record(sun.direction, sun_angle_radians, sun.lux);
        if (!scene.environment.visible_to_camera) record.flags |= light_hidden;
        add_sun(b, record, {}, luminance_of(sun.lux), radius);
    }
    if (sky.emits_light) {
        LightRecord record{};
        record.kind = int32_t(LightKind::environment);
        record.profile = -1;
        b.table.environment = int32_t(b.table.records.size());
        b.add_findable(record, {}, 4 * std::numbers::pi * std::numbers::pi * radius * radius * luminance_of(sky.mean) * sky.sampled_share);
        b.table.samples_environment = b.table.powers.back() > 0;
    }
    b.table.count = int32_t(b.table.records.size());
    // Emitters with zero selection probability are never returned, even for u = 1 - eps.
    if (sky.emits_light && !b.table.samples_environment) --b.table.count;
    while (aim == NeeLights::zero_size_lights && b.table.count > 0 && b.table.powers[size_t(b.table.count) - 1] == 0) --b.table.count;
    if (b.table.records.empty()) b.add({}, {}, 1);
    const std::vector<double> powers = with_defensive_mixture(b.table.powers, {});
    const bool many = aim == NeeLights::all_lights && b.luminaires >= min_lights_for_a_tree;
    if (!many || !add_tree(b, powers, workers)) {
        b.table.tree = {};
        b.table.thresholds = make_thresholds(powers);
    }
    return std::move(b.table);
}

bool samples_other_lights(const Scene& scene, const MeshLights& meshes, const std::vector<Id<Node>>& nodes) {
    WorldTransforms transforms(scene);
    const auto emits = [&](Id<Node> id) {
        const Light& light = *scene.lights.find(scene.nodes.find(id)->light);
        return light.enabled && !is_area_light(light) && luminance_of(light_emission(light)) > 0 && transforms(id).visible;
    };
    return std::ranges::any_of(meshes.powers, [](double power) { return power > 0; }) || std::ranges::any_of(nodes, emits) ||
           luminance_of(sun_of(scene.environment).lux) > 0;
}

void set_light_weights(LightTable& table, std::span<const double> factors) {
    const std::vector<double> weights = with_defensive_mixture(table.powers, factors);
    if (table.slot_lights.empty()) {
        table.thresholds = make_thresholds(weights);
        return;
    }
    const TablePowers p = table_powers(table, weights);
    set_light_tree_powers(table.tree.nodes, p.entries);
    table.thresholds = make_thresholds(p.slots);
}

int64_t light_table_bytes(int64_t lights) { return lights * int64_t(sizeof(LightRecord) + sizeof(uint32_t)); }

void LightTable::fill(LightTables& t) const {
    t.lights = records.data();
    t.thresholds = thresholds.data();
    t.count = count;
    t.slot_lights = slot_lights.data();
    t.tree = tree.tables();
    t.environment = environment;
    t.samples_environment = samples_environment;
    t.suns = suns.data();
    t.sun_count = int32_t(suns.size());
    t.first_sphere = first_sphere;
    t.profiles = profiles.tables();
}

} // namespace blush
