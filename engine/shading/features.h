// The features that a scene uses. A kernel is instantiated for a feature set and contains no code of others; any superset of a
// scene's features gives a bit-identical image.
#pragma once

#include <cstdint>

namespace blush {

enum class Feature : uint32_t {
    specular = 1u << 0,     // some material has a GGX reflection lobe (all but KHR_materials_specular 0)
    transmission = 1u << 1, // some material transmits
    absorption = 1u << 2,   // some solid has an attenuation colour
    textures = 1u << 3,     // some material reads a texture
    normal_maps = 1u << 4,
    vertex_colors = 1u << 5,
    unlit = 1u << 6,
    emissive_triangles = 1u << 7,
    point_lights = 1u << 8, // point and spot lights of zero size
    suns = 1u << 9,
    environment = 1u << 10,
    instances = 1u << 11, // some mesh is instanced
    energy_compensation = 1u << 12,
    thin_lens = 1u << 13,
    orthographic = 1u << 14,
    sphere_lights = 1u << 15,  // sphere lights, and point and spot lights with a radius
    light_profiles = 1u << 16, // some light's emission depends on direction: spots, spread, IES profiles
    light_tree = 1u << 17,     // several lights: selected at the receiver
    links = 1u << 18,          // some light is linked to objects for illumination or shadows
    clearcoat = 1u << 19,      // some material has a clear coat
    sheen = 1u << 20,
    anisotropy = 1u << 21,
    iridescence = 1u << 22,
    diffuse_transmission = 1u << 23,
    dispersion = 1u << 24,
    light_paths = 1u << 25, // light paths are connected to the camera (light_paths.h)
};

// A set of features; usable as a template argument.
struct Features {
    uint32_t bits = 0;

    constexpr bool has(Feature f) const { return bits & uint32_t(f); }
    constexpr Features with(Feature f) const { return {bits | uint32_t(f)}; }
    constexpr Features without(Feature f) const { return {bits & ~uint32_t(f)}; }
    constexpr bool contains(Features other) const { return (bits & other.bits) == other.bits; }
    constexpr bool operator==(const Features&) const = default;
};

inline constexpr Features no_features{};
// Of scenes. Light paths are chosen by a pilot, and have kernels of their own.
inline constexpr Features all_features{(1u << 25) - 1};
// KHR_materials_* layers on top of the metallic-roughness material, which few scenes use.
inline constexpr Features layer_features = no_features.with(Feature::clearcoat)
                                               .with(Feature::sheen)
                                               .with(Feature::anisotropy)
                                               .with(Feature::iridescence)
                                               .with(Feature::diffuse_transmission)
                                               .with(Feature::dispersion);

} // namespace blush
