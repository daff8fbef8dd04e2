#include "io/gltf/check/lint.h"

#include "core/for_ranges.h"
#include "core/math.h"
#include "io/gltf/write/document.h"
#include "scene/affine.h"
#include "scene/lights/light_units.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr double max_plausible_lumens = 100'000;                  // lumens: some sixty bulbs of 100 W
constexpr double max_plausible_sun_lux = 200'000;                 // lux: the sun in space gives 130,000
constexpr double min_plausible_sun_lux = 50;                      // lux of daylight; many web viewers use 1 to 10
constexpr double max_plausible_nits = 1e7;                        // nits: a bulb's filament
constexpr double max_scene_size = 50'000, min_scene_size = 0.001; // metres across

// Above the rounding error of 8-bit normals.
constexpr double unit_tolerance = 0.00674;

bool is_unit(const Vec3d& v) { return std::abs(length(v) - 1) <= unit_tolerance; }

void report_light(const GltfContext& context, const Light& light, const std::string& where) {
    if (light.ies || !light.enabled) return;
    if (light.kind == Light::Kind::sun) {
        if (light.intensity > max_plausible_sun_lux)
            context.warn(fmt::format("{:.6g} lux is brighter than the sun in space, {:.0f}", light.intensity, 130'000.0), where);
        else if (light.intensity > 0 && light.intensity < min_plausible_sun_lux)
            context.note(fmt::format("{:.3g} lux is dimmer than a lit room; a cloudy day has 10000", light.intensity), where);
        return;
    }
    if (is_per_area(light.kind)) {
        if (light.intensity > max_plausible_nits)
            context.warn(fmt::format("{:.4g} nits is brighter than a bulb's filament", light.intensity), where);
        return;
    }
    const double lumens = luminous_flux(light);
    if (lumens > max_plausible_lumens)
        context.warn(fmt::format("{:.6g} candela are {:.6g} lumens, as of {:.0f} bulbs of 100 W; glTF's unit is the candela; check that "
                                 "the value is not in watts",
                                 light.intensity, lumens, lumens / 1600),
                     where);
}

// The scale of a camera has no effect, but an axis of length 0 has no direction.
void report_cameras(const GltfContext& context, const Scene& scene) {
    for (const auto& [id, node] : scene.nodes) {
        if (!node.camera) continue;
        const Affined m = world_from_node(scene, id);
        const double size = length(m.x) * length(m.y) * length(m.z);
        if (!is_finite(m))
            context.warn("the camera's world transform is not finite: it sees nothing", "camera node \"" + node.name + "\"");
        else if (!(std::abs(determinant(m)) > 1e-12 * size) || !(size > 0))
            context.warn("the transform of a camera flattens an axis: its direction follows from the others",
                         "camera node \"" + node.name + "\"");
    }
}

} // namespace

void report_units(const GltfContext& context, const Scene& scene, const GltfIndices& indices) {
    for (const auto& [id, place] : indices.lights)
        if (const Light* light = scene.lights.find(id))
            report_light(context, *light, fmt::format("extensions.{}.lights[{}].intensity", list_name(place.list), place.index));
    for (const auto& [id, index] : indices.materials) {
        const Material* m = scene.materials.find(id);
        if (!m) continue;
        const double nits = double(std::max({m->emissive.x, m->emissive.y, m->emissive.z})) * double(m->emissive_strength);
        if (nits > max_plausible_nits)
            context.warn(fmt::format("{:.4g} nits is brighter than a bulb's filament", nits), fmt::format("materials[{}]", index));
    }
    report_cameras(context, scene);
    const Bounds bounds = world_bounds(scene);
    const double across = 2 * bounds.radius();
    if (!bounds.empty && across > max_scene_size)
        context.warn(
            fmt::format(
                "the scene is {:.4g} km across; glTF's unit is the metre; check that it was not modelled in millimetres or centimetres",
                across / 1000),
            "scene");
    if (!bounds.empty && across > 0 && across < min_scene_size)
        context.warn(fmt::format("the scene is {:.4g} mm across; glTF's unit is the metre", across * 1000), "scene");
}

void report_geometry(const GltfContext& context, const Geometry& g, const std::string& where) {
    const unsigned threads = context.options.threads;
    const size_t flat = count_in_ranges(g.triangle_count(), threads, [&](size_t t) {
        const uint32_t* const corner = &g.indices[3 * t];
        const Vec3d a = to_double(g.positions[corner[0]]);
        const Vec3d normal = cross(to_double(g.positions[corner[1]]) - a, to_double(g.positions[corner[2]]) - a);
        return !(dot(normal, normal) > 0);
    });
    if (flat > 0) context.warn(fmt::format("{} of {} triangles have no area and cannot be seen", flat, g.triangle_count()), where);
    const size_t odd = count_in_ranges(g.normals.size(), threads, [&](size_t i) { return !is_unit(to_double(g.normals[i])); });
    if (odd > 0) context.warn(fmt::format("{} of {} normals are not of unit length; they are normalised", odd, g.normals.size()), where);
    const size_t stretched = count_in_ranges(g.tangents.size(), threads, [&](size_t i) {
        const Vec4& t = g.tangents[i];
        return !is_unit({t.x, t.y, t.z});
    });
    if (stretched > 0)
        context.warn(fmt::format("{} of {} tangents are not of unit length; they are normalised", stretched, g.tangents.size()), where);
}

} // namespace blush
