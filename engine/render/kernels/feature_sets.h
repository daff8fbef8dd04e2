// The sets of features that kernels are compiled for, smallest first. A scene gets the first that has all it needs.
#pragma once

#include "shading/features.h"

#include <array>
#include <string_view>

namespace blush {

struct FeatureSet {
    std::string_view name;
    Features features;
};

// Matte rooms lit by meshes: the Cornell box.
inline constexpr Features lambert_features = no_features.with(Feature::emissive_triangles).with(Feature::instances);
// Rooms with metal and glass in them, lit by meshes alone.
inline constexpr Features mesh_lit_features = lambert_features.with(Feature::specular).with(Feature::transmission);
// Everything but rare materials. These share one kernel: it is the largest by far, and each combination of its own would cost as much
// again to compile for four instruction sets.
inline constexpr Features full_features{all_features.bits & ~layer_features.bits};
// Everything else that needs no texture coordinates.
inline constexpr Features untextured_features = full_features.without(Feature::textures)
                                                    .without(Feature::normal_maps)
                                                    .without(Feature::vertex_colors)
                                                    .without(Feature::unlit)
                                                    .without(Feature::energy_compensation)
                                                    .without(Feature::orthographic)
                                                    .without(Feature::links);
// The same without anything to see through.
inline constexpr Features opaque_features = untextured_features.without(Feature::transmission).without(Feature::absorption);

inline constexpr std::array<FeatureSet, 6> feature_sets{{
    {"lambert", lambert_features},
    {"mesh-lit", mesh_lit_features},
    {"opaque", opaque_features},
    {"untextured", untextured_features},
    {"full", full_features},
    {"layered", all_features},
}};

} // namespace blush
