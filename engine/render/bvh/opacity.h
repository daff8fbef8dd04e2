// Opacity of a triangle at a point: called by Embree's filter for every candidate hit on a material with alpha.
#pragma once

#include "core/math.h"
#include "render/integrator/texture_point.h"

namespace blush::inline BLUSH_ISA {

// In [0, 1]; alpha masks give 0 or 1. u, v are the weights of vertices 1 and 2.
inline float opacity_at_hit(const SceneTables& scene, int32_t part_index, int32_t triangle, float u, float v) {
    const PartRecord& part = scene.parts[part_index];
    const uint32_t* index = scene.indices + part.first_index + 3 * triangle;
    const auto vertex = [&](int k) { return part.first_vertex + int32_t(index[k]); };
    const std::array<int32_t, 3> vertices{vertex(0), vertex(1), vertex(2)};
    const std::array<float, 3> weights{1 - u - v, u, v};
    float alpha = part.flags & part_colors ? 0.f : 1.f;
    if (part.flags & part_colors)
        for (size_t k = 0; k < 3; ++k) alpha += scene.colors[4 * vertices[k] + 3] * weights[k];
    return opacity_at<all_features, float>(scene.materials, part.material, texture_point<float>(scene, part.flags, vertices, weights, true),
                                           alpha, true);
}

} // namespace blush::inline BLUSH_ISA
