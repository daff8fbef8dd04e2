#include "render/lights/mesh_lights.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "render/integrator/light_sampling.h"
#include "render/lights/light_limits.h"
#include "scene/affine.h"
#include "scene/world_transforms.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace blush {
namespace {

// Mean luminance of a textured emissive triangle over a 4 x 4 grid; never
// 0 where the material may emit, because the grid may miss emission.
double mean_varying_luminance(const SceneTables& tables, size_t light, const Vec3& factor) {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const Vec2 b = sample_triangle((float(i) + 0.5f) / 4, (float(j) + 0.5f) / 4);
            sum += luminance_of(varying_emission<all_features, float>(tables, int32_t(light), b, true));
        }
    return std::max(sum / 16, 0.01 * luminance_of(factor));
}

float emission_angle(const Light* area_light) {
    constexpr float all = 0.5f * std::numbers::pi_v<float>;
    return area_light ? std::min(0.5f * area_light->spread_radians + float(angle_margin), all) : all;
}

LightBounds triangle_bounds(const LightRecord& light, float theta_e, double power) {
    LightBounds b;
    b.corners = {light.position, light.position + light.edge1, light.position + light.edge2};
    const auto& p = b.corners;
    b.low = {std::min({p[0].x, p[1].x, p[2].x}), std::min({p[0].y, p[1].y, p[2].y}), std::min({p[0].z, p[1].z, p[2].z})};
    b.high = {std::max({p[0].x, p[1].x, p[2].x}), std::max({p[0].y, p[1].y, p[2].y}), std::max({p[0].z, p[1].z, p[2].z})};
    const Vec3d normal = cross(to_double(light.edge1), to_double(light.edge2));
    b.axis = dot(normal, normal) > 0 ? to_float(normalize(normal)) : Vec3{0, 0, 1};
    b.theta_e = theta_e;
    b.two_sided = light.flags & light_two_sided;
    b.power = power;
    return b;
}

// Triangles that are sampled by NEE, of the parts `parts`, by part. Area lights come first, then objects with the fewest
// triangles, so that a huge number of instances does not displace all other emitters.
std::vector<bool> is_sampled(const GeometryPool& geometry, const std::vector<size_t>& parts) {
    std::vector<bool> aimed(parts.size(), true);
    std::map<int32_t, int64_t> triangles; // by object
    std::vector<size_t> emissive;         // indices into `parts`
    int64_t total = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
        const int32_t object = geometry.parts()[parts[i]].object;
        if (is_expanded(Id<Node>{uint32_t(object)})) continue;
        emissive.push_back(i);
        triangles[object] += geometry.triangle_count(parts[i]);
        total += geometry.triangle_count(parts[i]);
    }
    if (total <= max_mesh_lights) return aimed;
    std::ranges::stable_sort(emissive, {}, [&](size_t i) {
        const int32_t object = geometry.parts()[parts[i]].object;
        return std::pair(triangles[object], object);
    });
    int64_t left = max_mesh_lights;
    for (const size_t i : emissive) {
        left -= geometry.triangle_count(parts[i]);
        aimed[i] = left >= 0;
    }
    return aimed;
}

// What the records of one part have in common.
struct Emitter {
    size_t part = 0;
    LightRecord record{}; // except the triangle
    Vec3 factor{0, 0, 0}; // emission before textures
    bool varying = false; // emission or opacity is textured, or opacity is in vertex colours
    bool mirrored = false;
    bool sampled = true;
};

Emitter emitter_of(const SceneTables& tables, const GeometryPool& geometry, size_t part, int32_t profile) {
    const PartRecord& record = geometry.parts()[part];
    const MaterialRecord& material = tables.materials.materials[record.material];
    Emitter e{part, {}, material.emission};
    const bool two_sided = material.flags & material_double_sided, translucent = material.alpha != alpha_opaque;
    e.varying = material.emissive_texture >= 0 || (translucent && (material.base_color_texture >= 0 || (record.flags & part_colors) != 0));
    // Constant alpha dims the whole light.
    const float opacity = e.varying ? 1.f : opacity_at<all_features, float>(tables.materials, record.material, {}, 1.f, true);
    // The stored vertices have the mesh's winding; under a mirroring transform the outside is the other side of the plane.
    e.mirrored =
        record.transform >= 0 ? determinant(tables.instances[record.transform].world_from_object) < 0 : (record.flags & part_mirrored) != 0;
    e.record.kind = int32_t(LightKind::triangle);
    e.record.flags = (two_sided ? light_two_sided : 0) | (e.varying ? light_varying : 0) | (e.mirrored ? light_mirrored : 0);
    e.record.part = int32_t(part);
    e.record.profile = profile;
    e.record.emission = material.emission * opacity;
    return e;
}

void add_triangle(MeshLights& lights, SceneTables& tables, const GeometryPool& geometry, const Emitter& e, int64_t triangle) {
    Vec3 p[3];
    geometry.corners(e.part, triangle, p);
    LightRecord light = e.record;
    light.triangle = int32_t(triangle);
    light.position = p[0];
    light.edge1 = p[1] - p[0];
    light.edge2 = p[2] - p[0];
    if (e.mirrored) std::swap(light.edge1, light.edge2);
    const double area = 0.5 * double(length(cross(light.edge1, light.edge2)));
    light.inverse_area = area > 0 && std::isfinite(1 / area) ? float(1 / area) : 0.f;
    lights.records.push_back(light);
    double nits = luminance_of(light.emission);
    if (e.varying) {
        tables.lights.lights = lights.records.data();
        nits = mean_varying_luminance(tables, lights.records.size() - 1, e.factor);
    }
    const double power = std::numbers::pi * area * nits;
    lights.nodes.push_back(Id<Node>{uint32_t(geometry.parts()[e.part].object)});
    lights.powers.push_back(e.sampled && light.inverse_area > 0 ? usable_power(power) : 0);
}

bool same_triangle(const LightRecord& a, const LightRecord& b) {
    return a.position == b.position && a.edge1 == b.edge1 && a.edge2 == b.edge2 && a.flags == b.flags;
}

// The tree of an entry's triangles. It does not depend on a constant emission, so that an edit of it builds nothing. `same`: the
// entry of this part in `before`, or null.
std::shared_ptr<const MeshTree> mesh_tree(const MeshLights& lights, const MeshLightEntry& entry, const MeshLights& before,
                                          const MeshLightEntry* same, const Workers& workers) {
    const auto first = size_t(entry.light), count = size_t(entry.count);
    const bool varying = lights.records[first].flags & light_varying;
    if (same && same->count == entry.count && same->theta_e == entry.theta_e) {
        const auto first_before = size_t(same->light);
        bool equal = true;
        for (size_t i = 0; equal && i < count; ++i)
            equal = same_triangle(lights.records[first + i], before.records[first_before + i]) &&
                    (!varying || lights.powers[first + i] == before.powers[first_before + i]);
        if (equal) return same->tree;
    }
    std::vector<LightBounds> triangles;
    triangles.reserve(count);
    for (size_t i = first; i < first + count; ++i) {
        const float inverse_area = lights.records[i].inverse_area;
        const double area = inverse_area > 0 ? 1 / double(inverse_area) : 0;
        triangles.push_back(triangle_bounds(lights.records[i], entry.theta_e, varying ? lights.powers[i] : area));
    }
    return std::make_shared<const MeshTree>(triangles, workers);
}

using EntriesByPart = std::map<std::pair<Id<Node>, int32_t>, const MeshLightEntry*>;

// Adds the entries of the light tree for the newest records, from `first` on. `part`: what they have in common.
void add_entries(MeshLights& lights, size_t first, const MeshLightEntry& part, const MeshLights& before, const EntriesByPart& parts_before,
                 const Workers& workers) {
    const size_t count = lights.records.size() - first;
    if (count < size_t(min_triangles_for_a_tree)) {
        for (size_t i = first; i < first + count; ++i) {
            lights.records[i].slot = ~int32_t(lights.entries.size());
            MeshLightEntry triangle;
            triangle.bounds = triangle_bounds(lights.records[i], part.theta_e, 0);
            triangle.light = int32_t(i);
            lights.entries.push_back(std::move(triangle));
        }
        return;
    }
    MeshLightEntry entry = part;
    entry.light = int32_t(first);
    entry.count = int32_t(count);
    const auto same = parts_before.find({entry.node, entry.part_of_node});
    entry.tree = mesh_tree(lights, entry, before, same == parts_before.end() ? nullptr : same->second, workers);
    entry.bounds = entry.tree->bounds();
    for (size_t i = first; i < first + count; ++i) lights.records[i].slot = ~int32_t(lights.entries.size());
    lights.entries.push_back(std::move(entry));
}

} // namespace

bool is_emissive(const MaterialRecord& material) { return material.flags & material_emissive && !(material.flags & material_unlit); }
double usable_power(double power) { return std::isfinite(power) && power > 0 ? power : 0; }
double luminance_of(const Vec3& c) { return double(luminance(c)); }

MeshLights build_mesh_lights(const Scene& scene, const GeometryPool& geometry, const SceneTables& scene_tables,
                             const std::vector<size_t>& parts, NeeLights aim, const MeshLights& before, const Workers& workers) {
    MeshLights lights;
    EntriesByPart parts_before;
    for (const MeshLightEntry& entry : before.entries)
        if (entry.tree) parts_before.emplace(std::pair(entry.node, entry.part_of_node), &entry);
    MeshLightEntry common; // to the triangles of a part
    WorldTransforms transforms(scene);
    SceneTables tables = scene_tables;
    const std::vector<bool> aimed = is_sampled(geometry, parts);
    for (size_t i = 0; i < parts.size(); ++i) {
        const size_t part = parts[i];
        const int64_t triangles = geometry.triangle_count(part);
        const Id<Node> body{uint32_t(geometry.parts()[part].object)};
        const Light* area_light = light_of_expanded_mesh(scene, body);
        lights.luminaires += area_light ? 1 : (triangles + 1) / 2;
        lights.emissive_triangles += triangles;
        const int32_t profile = area_light ? lights.profiles.add(*area_light, transforms(body).world_from_node).profile : -1;
        // A ray that hits the light reads its profile.
        if (aim == NeeLights::zero_size_lights && profile < 0) continue;
        if (!aimed[i]) {
            lights.unsampled_triangles += triangles;
            continue;
        }
        common.part_of_node = common.node == body ? common.part_of_node + 1 : 0;
        common.node = body;
        common.theta_e = emission_angle(area_light);
        const size_t first = lights.records.size();
        lights.first_lights.push_back({part, int32_t(first)});
        Emitter emitter = emitter_of(tables, geometry, part, profile);
        emitter.sampled = aim == NeeLights::all_lights;
        for (int64_t t = 0; t < triangles; ++t) add_triangle(lights, tables, geometry, emitter, t);
        if (emitter.sampled) add_entries(lights, first, common, before, parts_before, workers);
    }
    return lights;
}

} // namespace blush
