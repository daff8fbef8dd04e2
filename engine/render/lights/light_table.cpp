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
#include <limits>
#include <numbers>
#include <numeric>
#include <ranges>
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
            add_entry({-1, int32_t(table.records.size()), no_trail}, *where);
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
            const int32_t mesh = entry.tree ? table.tree.add_mesh(entry.tree) : -1;
            add_entry({mesh, entry.light, no_trail}, entry.bounds);
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
        b.add_findable(record, sphere.node, std::numbers::pi * disk * luminance_of(record.emission) * profile.rms, &bounds);
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

void add_sun(TableBuilder& b, const LightRecord& record, Id<Node> node, double lux) {
    if (record.cone_height > 0) b.table.suns.push_back(int32_t(b.table.records.size()));
    ++b.table.sun_lights;
    const double power = std::numbers::pi * lux;
    record.cone_height > 0 ? b.add_findable(record, node, power) : b.add(record, node, power);
}

void add_punctual(TableBuilder& b, const Scene& scene, const std::vector<Id<Node>>& nodes, const Vec3d& origin) {
    WorldTransforms transforms(scene);
    for (const Id<Node> id : nodes) {
        const Light* light = scene.lights.find(scene.nodes.find(id)->light);
        if (!light->enabled || is_area_light(*light) || is_sphere_light(*light) || !transforms(id).visible) continue;
        const Affined& world = transforms(id).world_from_node;
        const Vec3 emission = light_emission(*light);
        if (light->kind == Light::Kind::sun) {
            LightRecord record = sun_record(to_float(normalize(world.z)), light->angle_radians, emission);
            if (!light->visible_to_camera) record.flags |= light_hidden;
            add_sun(b, record, id, luminance_of(emission));
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
        b.add(record, id, std::numbers::pi * luminance_of(emission) * profile.rms, &bounds);
    }
}

// Powers times factors, where every emitting light keeps a share of its own power; a share of the power of the lights at finite distance
// is distributed uniformly over them (uniform_share). Scaled by a power of two, so that a scene at another scale renders the same bits.
std::vector<double> selection_weights(const LightTable& table, std::span<const double> factors) {
    const double max_factor = factors.empty() ? 1 : std::max(std::ranges::max(factors), std::numeric_limits<double>::min());
    const auto is_near = [&](size_t i) { return table.records[i].slot < 0; };
    std::vector<double> weights(table.powers.size());
    double near = 0, num_near = 0, total = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        const double factor = factors.empty() ? 1 : factors[i] / max_factor;
        weights[i] = ((1 - uniform_share) * factor + uniform_share) * table.powers[i];
        total += weights[i];
        if (!is_near(i) || !(table.powers[i] > 0)) continue;
        near += weights[i];
        ++num_near;
    }
    const double scale = total > 0 ? std::ldexp(1.0, -std::ilogb(total)) : 1;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (!(table.powers[i] > 0)) continue;
        if (is_near(i)) weights[i] = (1 - uniform_share) * weights[i] + uniform_share * near / num_near;
        weights[i] *= scale;
    }
    return weights;
}

// Sets the powers of the tree's entries and of the distant lights; without a tree, the thresholds of all.
void set_selection(LightTable& table, std::span<const double> weights) {
    LightTreeTable& tree = table.tree;
    if (tree.empty()) {
        table.thresholds = make_thresholds(weights);
        return;
    }
    std::vector<double> entries(tree.entries.size(), 0.0), distant(table.slot_lights.size(), 0.0);
    for (size_t i = 0; i < weights.size(); ++i) {
        if (table.powers[i] == 0) continue;
        const int32_t slot = table.records[i].slot;
        if (slot < 0)
            entries[size_t(~slot)] += weights[i];
        else if (table.slot_lights.empty())
            tree.distant[size_t(slot)].power = float(weights[i]);
        else
            distant[size_t(slot)] = weights[i];
    }
    set_light_tree_powers(tree.nodes, entries);
    if (distant.empty()) return;
    tree.distant[0].power = float(std::accumulate(distant.begin(), distant.end(), 0.0));
    table.thresholds = make_thresholds(distant);
}

// The table's distant lights; one for all of them if there are too many.
void add_distant(LightTable& table) {
    for (size_t i = 0; i < table.records.size(); ++i) {
        LightRecord& record = table.records[i];
        if (record.slot < 0 || table.powers[i] == 0) continue;
        const bool sun = record.kind == int32_t(LightKind::sun);
        const float height = record.cone_height; // 1 - cos
        record.slot = int32_t(table.tree.distant.size());
        table.tree.distant.push_back(
            {sun ? record.position : Vec3{0, 0, 0}, sun ? std::sqrt(height * std::max(0.f, 2 - height)) : 1.f, 0, int32_t(i)});
        table.slot_lights.push_back(int32_t(i));
    }
    if (table.slot_lights.size() <= size_t(max_distant_lights))
        table.slot_lights.clear();
    else
        table.tree.distant = {{{0, 0, 0}, 1, 0, -1}};
}

// Selects lights by their irradiance at the receiver. False, and no tree, if fewer than two emit.
bool add_tree(TableBuilder& b, const std::vector<double>& powers, const Workers& workers) {
    LightTable& table = b.table;
    for (size_t i = 0; i < table.records.size(); ++i)
        if (table.records[i].slot < 0) b.bounds[size_t(~table.records[i].slot)].power += powers[i];
    LightTreeShape shape = build_light_tree(b.bounds, workers);
    const int64_t near = shape.items.empty() ? 0 : b.luminaires;
    const auto distant = std::ranges::count_if(std::views::iota(size_t(0), powers.size()),
                                               [&](size_t i) { return table.records[i].slot >= 0 && powers[i] > 0; });
    if (near + distant < 2) return false;
    for (size_t i = 0; i < shape.trails.size(); ++i) table.tree.entries[i].trail = shape.trails[i];
    for (LightTreeNode& node : shape.nodes)
        for (int32_t& child : node.child)
            if (child < 0) child = ~shape.items[size_t(~child)];
    table.tree.nodes = std::move(shape.nodes);
    table.tree.find_root_lights();
    add_distant(table);
    return true;
}

} // namespace

LightTable build_light_table(const Scene& scene, const MeshLights& meshes, const std::vector<Id<Node>>& nodes,
                             const std::vector<SphereLight>& spheres, const SkyLight& sky, const Vec3d& origin, NeeLights aim,
                             const Workers& workers) {
    TableBuilder b;
    b.aim = aim;
    if (const int corners = disk_corners(scene, nodes); corners < max_disk_corners) b.table.fewer_disk_corners = corners;
    b.add_all(meshes);
    add_spheres(b, scene, spheres, origin);
    add_punctual(b, scene, nodes, origin);
    if (const SkySun sun = sun_of(scene.environment); luminance_of(sun.lux) > 0) {
        LightRecord record = sun_record(sun.direction, sun_angle_radians, sun.lux);
        if (!scene.environment.visible_to_camera) record.flags |= light_hidden;
        add_sun(b, record, {}, luminance_of(sun.lux));
    }
    if (sky.emits_light) {
        LightRecord record{};
        record.kind = int32_t(LightKind::environment);
        record.profile = -1;
        b.table.environment = int32_t(b.table.records.size());
        b.add_findable(record, {}, 2 * std::numbers::pi * std::numbers::pi * luminance_of(sky.mean) * sky.sampled_share);
        b.table.samples_environment = b.table.powers.back() > 0;
    }
    b.table.count = int32_t(b.table.records.size());
    // Emitters with zero selection probability are never returned, even for u = 1 - eps.
    if (sky.emits_light && !b.table.samples_environment) --b.table.count;
    while (aim == NeeLights::zero_size_lights && b.table.count > 0 && b.table.powers[size_t(b.table.count) - 1] == 0) --b.table.count;
    if (b.table.records.empty()) b.add({}, {}, 1);
    const std::vector<double> weights = selection_weights(b.table, {});
    if (!add_tree(b, weights, workers)) b.table.tree = {};
    set_selection(b.table, weights);
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

void set_light_weights(LightTable& table, std::span<const double> factors) { set_selection(table, selection_weights(table, factors)); }

int64_t light_table_bytes(int64_t lights) { return lights * int64_t(sizeof(LightRecord) + sizeof(uint32_t)); }

void LightTable::fill(LightTables& t) const {
    t.lights = records.data();
    t.thresholds = thresholds.data();
    t.count = count;
    t.slot_lights = slot_lights.data();
    t.slot_count = int32_t(slot_lights.size());
    t.tree = tree.tables();
    t.environment = environment;
    t.samples_environment = samples_environment;
    t.suns = suns.data();
    t.sun_count = int32_t(suns.size());
    t.first_sphere = first_sphere;
    t.profiles = profiles.tables();
}

} // namespace blush
