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
// Everything that needs no texture coordinates.
inline constexpr Features untextured_features = all_features.without(Feature::textures)
                                                    .without(Feature::normal_maps)
                                                    .without(Feature::vertex_colors)
                                                    .without(Feature::unlit)
                                                    .without(Feature::energy_compensation)
                                                    .without(Feature::orthographic)
                                                    .without(Feature::links);
// The same without anything to see through.
inline constexpr Features opaque_features = untextured_features.without(Feature::transmission).without(Feature::absorption);

inline constexpr std::array<FeatureSet, 5> feature_sets{{
    {"lambert", lambert_features},
    {"mesh-lit", mesh_lit_features},
    {"opaque", opaque_features},
    {"untextured", untextured_features},
    {"full", all_features},
}};

} // namespace blush
