#include "render/materials/smoothness.h"

#include "core/math.h"
#include "core/sampling.h"
#include "render/materials/material_factors.h"
#include "render/materials/material_layers.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace blush {
namespace {

// Above this roughness, NEE finds the reflected light well enough.
constexpr float max_caster_roughness = 0.2f;
// The same of a weak reflection, which is found at less cost beside the diffuse part.
constexpr float max_weak_roughness = 0.15f;
// Minimal share of specular reflection or refraction in a material's light; less is not visible next to the diffuse part.
constexpr float min_specular_share = 0.5f;

constexpr std::array shares{&Smoothness::casts_caustics, &Smoothness::reflects_weakly, &Smoothness::is_mirror, &Smoothness::is_glass};

constexpr int num_points = 256;
// Of larger meshes, some triangles stand for all.
constexpr size_t max_visited_triangles = 1 << 16;

bool is_opaque(const Material& m) { return !m.unlit && m.alpha == Material::Alpha::opaque; }

bool casts_caustics(const Material& m) {
    const float refracts = m.thickness > 0 ? m.transmission : 0; // thin walls do not bend light (thin_transmission.h)
    return is_opaque(m) && m.roughness <= max_caster_roughness && std::max(m.metallic, refracts) >= min_specular_share;
}
bool reflects_weakly(const Material& m) {
    const bool base = reflects(m) && m.roughness <= max_weak_roughness, coat = is_coated(m) && m.clearcoat_roughness <= max_weak_roughness;
    return is_opaque(m) && !casts_caustics(m) && (base || coat);
}
bool has_smooth_coat(const Material& m) { return is_coated(m) && unit(m.clearcoat_roughness) < smooth_roughness; }

// As smooth as textures can make it; they multiply factors by at most 1.
Material smoothest(Material m) {
    if (m.metallic_roughness_texture.texture) m.roughness = 0;
    if (m.clearcoat_roughness_texture.texture) m.clearcoat_roughness = 0;
    return m;
}

bool has_textured_lobes(const Material& m) {
    return std::ranges::any_of(std::array{&m.metallic_roughness_texture, &m.specular_texture, &m.transmission_texture, &m.clearcoat_texture,
                                          &m.clearcoat_roughness_texture},
                               [](const TextureRef* ref) { return bool(ref->texture); });
}

// Calls visit(corners, area) for triangles of the geometry, in object space.
template <class Visit> void each_triangle(const Geometry& geometry, const Visit& visit) {
    const size_t count = geometry.triangle_count(), stride = 1 + count / max_visited_triangles;
    for (size_t t = 0; t < count; t += stride) {
        const uint32_t* corners = geometry.indices.data() + 3 * t;
        const Vec3d a = to_double(geometry.positions[corners[0]]);
        const Vec3d b = to_double(geometry.positions[corners[1]]) - a, c = to_double(geometry.positions[corners[2]]) - a;
        const double area = 0.5 * length(cross(b, c));
        if (std::isfinite(area)) visit(corners, area);
    }
}

// Calls visit(corners, b) for `num_points` points, b being the barycentric coordinates of the second and third corner: systematic
// sampling by area, and the R2 sequence (Roberts 2018) within triangles.
template <class Visit> void each_point(const Geometry& geometry, const Visit& visit) {
    double total = 0, passed = 0;
    each_triangle(geometry, [&](const uint32_t*, double area) { total += area; });
    int point = 0;
    each_triangle(geometry, [&](const uint32_t* corners, double area) {
        passed += area;
        for (; point < num_points && (point + 0.5) * total < passed * num_points; ++point) {
            const double u = 0.5 + 0.7548776662466927 * point, v = 0.5 + 0.5698402909980532 * point;
            visit(corners, sample_triangle(float(u - std::floor(u)), float(v - std::floor(v))));
        }
    });
}

} // namespace

Smoothness smoothness_of(const Material& m) {
    const auto share = [](bool is) { return is ? 1.f : 0.f; };
    return {.casts_caustics = share(casts_caustics(m)),
            .reflects_weakly = share(reflects_weakly(m)),
            .is_mirror = share(is_smooth(m) || has_smooth_coat(m)),
            .is_glass = share(is_smooth(m) && transmits(m) && !is_thin(m))};
}

Smoothness largest_of(const Smoothness& a, const Smoothness& b) {
    Smoothness largest;
    for (float Smoothness::*share : shares) largest.*share = std::max(a.*share, b.*share);
    return largest;
}

bool is_smooth_by_texture(const Material& m) { return has_textured_lobes(m) && smoothness_of(smoothest(m)) != Smoothness{}; }

bool may_cast_caustics(const Material& m) { return casts_caustics(smoothest(m)); }

Smoothness smoothness_of(const Geometry& geometry, const Material& material, Id<Material> id, const MaterialTable& table) {
    const auto index = size_t(table.index_of(id));
    const MaterialRecord& record = table.records[index];
    const LayerRecord& layer = table.layers[index];
    const TextureTables textures = table.tables().textures;
    Material at_point = material;
    Smoothness sum;
    each_point(geometry, [&](const uint32_t* corners, const Vec2& b) {
        TexturePoint<float> at{};
        for (size_t i = 0; i < table.uv_sets.size(); ++i) {
            if (!geometry.has_uv_set(table.uv_sets[i])) continue;
            const auto& uv = geometry.uv[size_t(table.uv_sets[i])];
            const Vec2 p = uv[corners[0]], q = uv[corners[1]], r = uv[corners[2]];
            at.uv[i] = {p.x + b.x * (q.x - p.x) + b.y * (r.x - p.x), p.y + b.x * (q.y - p.y) + b.y * (r.y - p.y)};
        }
        const auto texel = [&](int32_t use) { return lookup<float>(textures, use, at, true, false); };
        const Vec4 metallic_roughness = texel(record.metallic_roughness_texture);
        at_point.roughness = material.roughness * metallic_roughness.y;
        at_point.metallic = material.metallic * metallic_roughness.z;
        at_point.specular = material.specular * texel(record.specular_texture).w;
        at_point.transmission = material.transmission * texel(record.transmission_texture).x;
        at_point.clearcoat = material.clearcoat * texel(layer.clearcoat_texture).x;
        at_point.clearcoat_roughness = material.clearcoat_roughness * texel(layer.clearcoat_roughness_texture).y;
        const Smoothness here = smoothness_of(at_point);
        for (float Smoothness::*share : shares) sum.*share += here.*share / num_points;
    });
    return sum;
}

} // namespace blush
