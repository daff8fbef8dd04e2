// KHR_materials_* layers of a material, compiled: read only by kernels for scenes that use them.
#pragma once

#include "shading/bsdf_types.h"
#include "shading/texture.h"

namespace blush {

// Parallel to the MaterialRecords, with the same rules. All 0: no layers.
struct LayerRecord {
    float clearcoat = 0, clearcoat_roughness = 0, clearcoat_normal_scale = 1;
    int32_t clearcoat_texture = -1;
    int32_t clearcoat_roughness_texture = -1;
    int32_t clearcoat_normal_texture = -1;
    Vec3 sheen_color{0, 0, 0};
    float sheen_roughness = 0;
    int32_t sheen_color_texture = -1;
    int32_t sheen_roughness_texture = -1;
    float anisotropy = 0;
    float anisotropy_cos = 1, anisotropy_sin = 0; // of its rotation
    int32_t anisotropy_texture = -1;
    float iridescence = 0, film_ior = 0;
    float film_thickness_minimum = 0, film_thickness_maximum = 0; // nanometres
    int32_t iridescence_texture = -1;
    int32_t film_thickness_texture = -1;
    float diffuse_transmission = 0;
    Vec3 diffuse_transmission_color{0, 0, 0};
    int32_t diffuse_transmission_texture = -1;
    int32_t diffuse_transmission_color_texture = -1;
    float dispersion = 0; // 20 / Abbe number
    bool operator==(const LayerRecord&) const = default;
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Decodes a normal map, glTF 2.0 section 3.9.3: texels map [0, 1] to [-1, 1], scale multiplies x and y. Normals below the surface
// are moved onto it. (0, 0, 1) outside of `mapped` and for zero vectors.
template <class F> Vec<F> decode_normal(const Vec<F>& color, const F& scale, const Mask<F>& mapped) {
    const Vec<F> texel = color * 2.f - splat<F>(1.f);
    const Vec<F> n{texel.x * scale, texel.y * scale, max(texel.z, F(0.f))};
    const F squared = length_squared(n);
    const Mask<F> usable = mapped && squared > F(1e-12f);
    return select(usable, n / sqrt(select(usable, squared, F(1.f))), Vec<F>{F(0.f), F(0.f), F(1.f)});
}

// Clear coat coverage at a point. texture(slot) looks up the texture of that member of the record.
template <Features S, class F, class Texture> F clearcoat_share(const LayerRecord* records, const Int<F>& m, const Texture& texture) {
    const F factor = gather_field(records, &LayerRecord::clearcoat, m);
    if constexpr (!S.has(Feature::textures))
        return factor;
    else
        return clamp01(F(factor * texture(&LayerRecord::clearcoat_texture).x));
}

// Sets the members of `layers` that S has, except directions, which need a frame.
template <Features S, class F, class Texture>
void read_layers(LayerParams<F>& layers, const LayerRecord* records, const Int<F>& m, const Texture& texture) {
    constexpr bool textured = S.has(Feature::textures);
    const auto factor = [&](float LayerRecord::*field) { return gather_field(records, field, m); };
    if constexpr (S.has(Feature::clearcoat)) {
        layers.clearcoat = clearcoat_share<S, F>(records, m, texture);
        layers.clearcoat_roughness = factor(&LayerRecord::clearcoat_roughness);
        if constexpr (textured)
            layers.clearcoat_roughness = clamp01(F(layers.clearcoat_roughness * texture(&LayerRecord::clearcoat_roughness_texture).y));
    }
    if constexpr (S.has(Feature::sheen)) {
        layers.sheen_color = gather_field3<F>(records, &LayerRecord::sheen_color, m);
        layers.sheen_roughness = factor(&LayerRecord::sheen_roughness);
        if constexpr (textured) {
            layers.sheen_color = clamp01(layers.sheen_color * rgb(texture(&LayerRecord::sheen_color_texture)));
            layers.sheen_roughness = clamp01(F(layers.sheen_roughness * texture(&LayerRecord::sheen_roughness_texture).w));
        }
    }
    if constexpr (S.has(Feature::iridescence)) {
        layers.iridescence = factor(&LayerRecord::iridescence);
        layers.film_ior = factor(&LayerRecord::film_ior);
        layers.film_thickness = factor(&LayerRecord::film_thickness_maximum);
        if constexpr (textured) {
            layers.iridescence = clamp01(F(layers.iridescence * texture(&LayerRecord::iridescence_texture).x));
            const F low = factor(&LayerRecord::film_thickness_minimum);
            // White, and no texture, give exactly the maximum.
            const F lack = 1.f - clamp01(texture(&LayerRecord::film_thickness_texture).y);
            layers.film_thickness = layers.film_thickness + (low - layers.film_thickness) * lack;
        }
    }
    if constexpr (S.has(Feature::diffuse_transmission)) {
        layers.diffuse_transmission = factor(&LayerRecord::diffuse_transmission);
        layers.diffuse_transmission_color = gather_field3<F>(records, &LayerRecord::diffuse_transmission_color, m);
        if constexpr (textured) {
            layers.diffuse_transmission = clamp01(F(layers.diffuse_transmission * texture(&LayerRecord::diffuse_transmission_texture).w));
            layers.diffuse_transmission_color =
                clamp01(layers.diffuse_transmission_color * rgb(texture(&LayerRecord::diffuse_transmission_color_texture)));
        }
    }
}

// Strength of the anisotropy, and its direction in the frame of tangent and bitangent.
template <class F> struct AnisotropyPoint {
    F strength;
    Vec2T<F> direction; // unit
};
template <Features S, class F, class Texture>
AnisotropyPoint<F> anisotropy_at(const LayerRecord* records, const Int<F>& m, const Mask<F>& active, const Texture& texture) {
    const auto factor = [&](float LayerRecord::*field) { return gather_field(records, field, m); };
    AnisotropyPoint<F> a{factor(&LayerRecord::anisotropy), {factor(&LayerRecord::anisotropy_cos), factor(&LayerRecord::anisotropy_sin)}};
    if constexpr (S.has(Feature::textures)) {
        const Mask<F> mapped = active && as_mask(gather_field(records, &LayerRecord::anisotropy_texture, m) >= 0);
        if (!any(mapped)) return a;
        const Vec4T<F> texel = texture(&LayerRecord::anisotropy_texture);
        const F x = texel.x * 2.f - 1.f, y = texel.y * 2.f - 1.f, squared = x * x + y * y;
        const Mask<F> turned = mapped && squared > F(1e-6f); // grey encodes no direction
        const F scale = 1.f / sqrt(select(turned, squared, F(1.f)));
        const F c = select(turned, x * scale, F(1.f)), s = select(turned, y * scale, F(0.f));
        const Vec2T<F> by = a.direction;
        a.direction = {c * by.x - s * by.y, c * by.y + s * by.x};
        a.strength = clamp01(F(a.strength * texel.z));
    }
    return a;
}

// The coat's normal in the frame of tangent, bitangent and shading normal.
template <class F, class Texture>
Vec<F> clearcoat_tangent_normal(const LayerRecord* records, const Int<F>& m, const Mask<F>& active, const Texture& texture) {
    const Mask<F> mapped = active && as_mask(gather_field(records, &LayerRecord::clearcoat_normal_texture, m) >= 0);
    if (!any(mapped)) return {F(0.f), F(0.f), F(1.f)};
    const F scale = gather_field(records, &LayerRecord::clearcoat_normal_scale, m);
    return decode_normal<F>(rgb(texture(&LayerRecord::clearcoat_normal_texture)), scale, mapped);
}

} // namespace blush::inline BLUSH_ISA
