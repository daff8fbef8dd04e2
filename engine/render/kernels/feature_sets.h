// The feature sets that kernels are compiled for, smallest first. A scene uses the first that has all it needs. Each
// costs compile time for every instruction set.
#pragma once

#include "shading/features.h"

#include <array>
#include <string_view>

namespace blush {

struct FeatureSet {
    std::string_view name;
    Features features;
};

// Diffuse rooms lit by meshes: the Cornell box.
inline constexpr Features lambert_features = no_features.with(Feature::emissive_triangles).with(Feature::instances);
// Rooms with metal and glass, lit only by meshes.
inline constexpr Features mesh_lit_features = lambert_features.with(Feature::specular).with(Feature::transmission);
// Everything except rare materials. The rare layers share one kernel: it is the largest by far.
inline constexpr Features full_features{all_features.bits & ~layer_features.bits};
// All features of `full` that need no texture coordinates.
inline constexpr Features untextured_features = full_features.without(Feature::textures)
                                                    .without(Feature::normal_maps)
                                                    .without(Feature::vertex_colors)
                                                    .without(Feature::unlit)
                                                    .without(Feature::energy_compensation)
                                                    .without(Feature::orthographic)
                                                    .without(Feature::links);
// The same without transmission.
inline constexpr Features opaque_features = untextured_features.without(Feature::transmission).without(Feature::absorption);

inline constexpr std::array<FeatureSet, 8> feature_sets{{
    {"lambert", lambert_features},
    {"mesh-lit", mesh_lit_features},
    {"opaque", opaque_features},
    {"untextured", untextured_features},
    {"full", full_features},
    {"layered", all_features},
    {"light paths", untextured_features.with(Feature::light_paths)},
    {"light paths, layered", all_features.with(Feature::light_paths)},
}};
// For processors without AVX2 (scalar, v2): fewer, to keep the build cheap. Scenes without rare layers pay for them there.
inline constexpr std::array<FeatureSet, 3> fallback_feature_sets{{
    {"lambert", lambert_features},
    {"layered", all_features},
    {"light paths, layered", all_features.with(Feature::light_paths)},
}};

} // namespace blush
