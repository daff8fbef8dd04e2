// Opacity of a triangle at a point: called by Embree's filter for every candidate hit on a material with alpha.
//
// The same bits as opacity_at (shading/material.h), which NEE of emitters uses. That reads colours as well; here alpha alone is read, of
// one point.
#pragma once

#include "core/math.h"
#include "render/integrator/texture_point.h"

#include <cstring>

namespace blush::inline BLUSH_ISA {

// Of a level with four channels.
inline float texel_alpha(const TextureLevel& level, int32_t column, int32_t row) {
    const size_t at = (size_t(row) * size_t(level.width) + size_t(column)) * 4 + 3;
    const auto* bytes = static_cast<const uint8_t*>(level.texels);
    if (level.encoding == encoding_half) {
        uint16_t half;
        std::memcpy(&half, bytes + at * sizeof half, sizeof half);
        return half_value<float>(half & 0x7fff);
    }
    if (level.encoding == encoding_float32) {
        float alpha;
        std::memcpy(&alpha, bytes + at * sizeof alpha, sizeof alpha);
        return alpha;
    }
    return float(bytes[at]) * (1.f / 255.f);
}

// Bilinear or nearest, not filtered over a footprint. `uv`: in the use's set.
inline float alpha_lookup(const TextureTables& tables, const TextureUse& use, const Vec2& uv) {
    const TextureRecord& texture = tables.textures[use.texture];
    const TextureLevel& level = tables.levels[texture.first_level];
    if (level.channels == 3) return 1;
    const float s = use.u_from_u * uv.x + use.u_from_v * uv.y + use.u_offset, t = use.v_from_u * uv.x + use.v_from_v * uv.y + use.v_offset;
    const bool nearest = texture.filter == filter_nearest;
    const TexturePair<float> x = texture_pair<float>(is_finite(s) ? s : 0, level.width, texture.wrap_u, nearest);
    const TexturePair<float> y = texture_pair<float>(is_finite(t) ? t : 0, level.height, texture.wrap_v, nearest);
    const auto row = [&](int32_t at) { return lerp(texel_alpha(level, x.first, at), texel_alpha(level, x.second, at), x.weight); };
    return lerp(row(y.first), row(y.second), y.weight);
}

// In [0, 1]; alpha masks give 0 or 1. u, v are the weights of vertices 1 and 2.
inline float opacity_at_hit(const SceneTables& scene, int32_t part_index, int32_t triangle, float u, float v) {
    const PartRecord& part = scene.parts[part_index];
    const MaterialRecord& material = scene.materials.materials[part.material];
    if (material.alpha == alpha_opaque) return 1;
    const uint32_t* index = scene.indices + part.first_index + 3 * triangle;
    const auto vertex = [&](int k) { return size_t(part.first_vertex + int32_t(index[k])); };
    const float weights[]{1 - u - v, u, v};
    float vertex_alpha = 1;
    if (part.flags & part_colors) {
        vertex_alpha = 0;
        for (int k = 0; k < 3; ++k) vertex_alpha += scene.colors[4 * vertex(k) + 3] * weights[k];
    }
    float alpha = material.opacity;
    if (material.base_color_texture >= 0) {
        const TextureUse& use = scene.materials.textures.uses[material.base_color_texture];
        Vec2 uv{0, 0};
        if (part.flags & part_uv << use.uv_set) {
            const float* uvs = scene.uv[size_t(use.uv_set)];
            const auto corner = [&](int k) { return Vec2{uvs[2 * vertex(k)], uvs[2 * vertex(k) + 1]}; };
            uv = corner(0) * weights[0] + corner(1) * weights[1] + corner(2) * weights[2];
        }
        alpha = alpha * alpha_lookup(scene.materials.textures, use, uv);
    }
    alpha = clamp01(alpha * vertex_alpha);
    return material.alpha == alpha_mask ? float(alpha >= material.alpha_cutoff) : alpha;
}

} // namespace blush::inline BLUSH_ISA
