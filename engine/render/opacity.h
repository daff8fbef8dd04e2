// How opaque a triangle is at a point: what Embree's filter asks for every candidate hit on an alpha material.
#pragma once

#include "core/math.h"
#include "render/scene_tables.h"

namespace blush::inline BLUSH_ISA {

// In [0, 1]; alpha masks give 0 or 1. u, v are the weights of vertices 1 and 2.
inline float opacity_at_hit(const SceneTables& scene, int32_t part_index, int32_t triangle, float u, float v) {
    const PartRecord& part = scene.parts[part_index];
    const uint32_t* index = scene.indices + part.first_index + 3 * triangle;
    const float weight[3] = {1 - u - v, u, v};
    Vec2 uv0{0, 0}, uv1{0, 0};
    Vec4 color{1, 1, 1, part.flags & part_colors ? 0.f : 1.f};
    for (int k = 0; k < 3; ++k) {
        const size_t vertex = size_t(part.first_vertex) + index[k];
        if (part.flags & part_uv0) uv0 = uv0 + Vec2{scene.uv0[2 * vertex], scene.uv0[2 * vertex + 1]} * weight[k];
        if (part.flags & part_uv1) uv1 = uv1 + Vec2{scene.uv1[2 * vertex], scene.uv1[2 * vertex + 1]} * weight[k];
        if (part.flags & part_colors) color.w += scene.colors[4 * vertex + 3] * weight[k];
    }
    return opacity_at(scene.materials, part.material, uv0, uv1, color.w);
}

} // namespace blush::inline BLUSH_ISA
