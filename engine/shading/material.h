// Material parameters at a surface point: the factors of a material record times its textures, clamped to valid ranges.
#pragma once

#include "shading/bsdf.h"
#include "shading/features.h"
#include "shading/material_layers.h"
#include "shading/texture.h"

namespace blush {

enum MaterialFlag : int32_t {
    material_double_sided = 1,
    material_unlit = 2,    // only base_color is visible; does not scatter
    material_thin = 4,     // transmits like a sheet without inside
    material_emissive = 8, // emission is not black
    material_pane = 16,    // thin, and may be smooth: light may pass straight through (render/integrator/thin_transmission.h)
    material_chains = 32,  // its delta lobes may be events of manifold sampling (render/integrator/manifold/manifold_sampling.h)
};
enum MaterialAlpha : int32_t { alpha_opaque, alpha_mask, alpha_blend };

// glTF's metallic-roughness material, compiled: factors are finite and in range; parameters that no lobe uses have their default,
// so that materials of equal appearance are equal. Each texture slot is the index of a TextureUse or -1.
struct MaterialRecord {
    Vec3 base_color{1, 1, 1};
    float opacity = 1;
    float metallic = 0, roughness = 1;
    Vec3 emission{0, 0, 0}; // radiance in nits
    float normal_scale = 1;
    float ior = 1.5f; // >= 1, or 0
    float specular = 0;
    Vec3 specular_color{1, 1, 1};
    float transmission = 0;
    Vec3 sigma_a{0, 0, 0};        // absorption inside a solid, 1/m
    int32_t flags = 0;            // MaterialFlag
    int32_t alpha = alpha_opaque; // MaterialAlpha
    float alpha_cutoff = 0.5f;
    int32_t base_color_texture = -1;
    int32_t metallic_roughness_texture = -1;
    int32_t normal_texture = -1;
    int32_t emissive_texture = -1;
    int32_t specular_texture = -1;
    int32_t specular_color_texture = -1;
    int32_t transmission_texture = -1;
    bool operator==(const MaterialRecord&) const = default;
};

struct MaterialTables {
    const MaterialRecord* materials = nullptr;
    const LayerRecord* layers = nullptr; // parallel to the records
    TextureTables textures;
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> struct MaterialPoint {
    BsdfParams<F> bsdf;
    Vec<F> emission;                 // radiance in nits towards the emitting side
    Vec<F> tangent_normal;           // unit, in the frame of tangent, bitangent and shading normal; (0, 0, 1) without a normal map
    Vec<F> clearcoat_tangent_normal; // the coat's normal, in the same frame
    AnisotropyPoint<F> anisotropy;
    F dispersion;   // 20 / Abbe number
    Vec<F> sigma_a; // 1/m, on the inner side of a solid
    Mask<F> double_sided, unlit, pane;
};

// Emission of the material in nits at a point, front side; its texture is not filtered, because NEE samples points. Zero in a
// kernel without emissive triangles.
template <Features S, class F>
Vec<F> emission_at(const MaterialTables& tables, const Int<F>& material, const TexturePoint<F>& at, const Mask<F>& active) {
    if constexpr (!S.has(Feature::emissive_triangles)) return splat<F>(0.f);
    const Int<F> m = select(active, material, Int<F>(0));
    const MaterialRecord* records = tables.materials;
    const Vec<F> emission = gather_field3<F>(records, &MaterialRecord::emission, m);
    if constexpr (!S.has(Feature::textures)) return emission;
    return emission * rgb(lookup<F>(tables.textures, gather_field(records, &MaterialRecord::emissive_texture, m), at, active, false));
}

// Clear coat coverage at a point; not filtered, because it attenuates emission.
template <Features S, class F>
F clearcoat_at(const MaterialTables& tables, const Int<F>& material, const TexturePoint<F>& at, const Mask<F>& active) {
    const Int<F> m = select(active, material, Int<F>(0));
    return clearcoat_share<S, F>(tables.layers, m, [&](int32_t LayerRecord::*slot) {
        return lookup<F>(tables.textures, gather_field(tables.layers, slot, m), at, active, false);
    });
}

// (0, 0, 1) without a normal map. Not filtered: averaged normals reflect differently.
template <class F>
Vec<F> tangent_normal_at(const MaterialTables& tables, const Int<F>& m, const TexturePoint<F>& at, const Mask<F>& active) {
    const Int<F> use = gather_field(tables.materials, &MaterialRecord::normal_texture, m);
    const Mask<F> mapped = active && as_mask(use >= 0);
    if (!any(mapped)) return {F(0.f), F(0.f), F(1.f)};
    const F scale = gather_field(tables.materials, &MaterialRecord::normal_scale, m);
    return decode_normal<F>(rgb(lookup<F>(tables.textures, use, at, active, false)), scale, mapped);
}

// All material parameters at a hit. Inactive lanes get some valid
// material. Base colour is clamped to [0, 1]: more would gain energy.
template <Features S, class F> MaterialPoint<F> material_at(const MaterialTables& tables, const Int<F>& material, const TexturePoint<F>& at,
                                                            const Vec4T<F>& vertex_color, const Mask<F>& active) {
    const Int<F> m = select(active, material, Int<F>(0));
    const MaterialRecord* records = tables.materials;
    const auto texture = [&](int32_t MaterialRecord::*slot) {
        return lookup<F>(tables.textures, gather_field(records, slot, m), at, active);
    };
    const auto layer_texture = [&](int32_t LayerRecord::*slot) {
        const bool filtered = slot != &LayerRecord::clearcoat_texture && slot != &LayerRecord::clearcoat_normal_texture &&
                              // coats are unfiltered, as in NEE of emission below them; so are directions
                              slot != &LayerRecord::anisotropy_texture;
        return lookup<F>(tables.textures, gather_field(tables.layers, slot, m), at, active, filtered);
    };
    const Int<F> flags = gather_field(records, &MaterialRecord::flags, m);
    const auto flag = [&](MaterialFlag f) { return Mask<F>(as_mask((flags & int32_t(f)) != 0)); };

    MaterialPoint<F> p;
    p.double_sided = flag(material_double_sided);
    p.emission = emission_at<S, F>(tables, material, at, active);
    p.unlit = Mask<F>(false);
    if constexpr (S.has(Feature::unlit)) p.unlit = flag(material_unlit);

    Vec<F> color = gather_field3<F>(records, &MaterialRecord::base_color, m);
    if constexpr (S.has(Feature::textures)) color = color * rgb(texture(&MaterialRecord::base_color_texture));
    if constexpr (S.has(Feature::vertex_colors)) color = color * rgb(vertex_color);
    p.bsdf.base_color = {clamp01(color.x), clamp01(color.y), clamp01(color.z)};

    p.bsdf.metallic = F(0.f);
    p.bsdf.roughness = F(1.f);
    p.bsdf.ior = F(1.5f);
    p.bsdf.specular = F(0.f);
    p.bsdf.specular_color = splat<F>(1.f);
    if constexpr (has_facets(S)) {
        p.bsdf.metallic = gather_field(records, &MaterialRecord::metallic, m);
        p.bsdf.roughness = gather_field(records, &MaterialRecord::roughness, m);
        p.bsdf.ior = gather_field(records, &MaterialRecord::ior, m);
        p.bsdf.specular = gather_field(records, &MaterialRecord::specular, m);
        p.bsdf.specular_color = gather_field3<F>(records, &MaterialRecord::specular_color, m);
        if constexpr (S.has(Feature::textures)) {
            const Vec4T<F> rough_metal = texture(&MaterialRecord::metallic_roughness_texture);
            p.bsdf.roughness = clamp01(F(p.bsdf.roughness * rough_metal.y));
            p.bsdf.metallic = clamp01(F(p.bsdf.metallic * rough_metal.z));
            p.bsdf.specular = clamp01(F(p.bsdf.specular * texture(&MaterialRecord::specular_texture).w));
            p.bsdf.specular_color = p.bsdf.specular_color * rgb(texture(&MaterialRecord::specular_color_texture));
        }
    }

    p.bsdf.transmission = F(0.f);
    p.bsdf.thin = p.pane = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) {
        p.bsdf.transmission = gather_field(records, &MaterialRecord::transmission, m);
        if constexpr (S.has(Feature::textures)) {
            p.bsdf.transmission = clamp01(F(p.bsdf.transmission * texture(&MaterialRecord::transmission_texture).x));
        }
        p.bsdf.thin = flag(material_thin);
        p.pane = flag(material_pane);
    }
    p.sigma_a = splat<F>(0.f);
    if constexpr (S.has(Feature::absorption)) p.sigma_a = gather_field3<F>(records, &MaterialRecord::sigma_a, m);

    p.tangent_normal = {F(0.f), F(0.f), F(1.f)};
    if constexpr (S.has(Feature::normal_maps)) p.tangent_normal = tangent_normal_at<F>(tables, m, at, active);
    read_layers<S, F>(p.bsdf.layers, tables.layers, m, layer_texture);
    p.clearcoat_tangent_normal = {F(0.f), F(0.f), F(1.f)};
    if constexpr (S.has(Feature::normal_maps) && S.has(Feature::clearcoat))
        p.clearcoat_tangent_normal = clearcoat_tangent_normal<F>(tables.layers, m, active, layer_texture);
    if constexpr (S.has(Feature::anisotropy)) p.anisotropy = anisotropy_at<S, F>(tables.layers, m, active, layer_texture);
    p.dispersion = F(0.f);
    if constexpr (S.has(Feature::dispersion)) p.dispersion = gather_field(tables.layers, &LayerRecord::dispersion, m);
    return p;
}

// Opacity in [0, 1], glTF 2.0 section 3.9.4: 1 if opaque, 0 or 1 if masked, else the alpha of factor, texture and vertex colour.
// Unfiltered, because ray filters and NEE evaluate points.
template <Features S, class F> F opacity_at(const MaterialTables& tables, const Int<F>& material, const TexturePoint<F>& at,
                                            const F& vertex_alpha, const Mask<F>& active) {
    const Int<F> m = select(active, material, Int<F>(0));
    const MaterialRecord* records = tables.materials;
    const Int<F> mode = gather_field(records, &MaterialRecord::alpha, m);
    const Mask<F> translucent = active && as_mask(mode != int32_t(alpha_opaque));
    if (!any(translucent)) return F(1.f);
    F alpha = gather_field(records, &MaterialRecord::opacity, m);
    if constexpr (S.has(Feature::textures))
        alpha = alpha * lookup<F>(tables.textures, gather_field(records, &MaterialRecord::base_color_texture, m), at, translucent).w;
    alpha = clamp01(F(alpha * vertex_alpha));
    const F masked = select(alpha >= gather_field(records, &MaterialRecord::alpha_cutoff, m), F(1.f), F(0.f));
    return select(translucent, select(as_mask(mode == int32_t(alpha_mask)), masked, alpha), F(1.f));
}

} // namespace blush::inline BLUSH_ISA
