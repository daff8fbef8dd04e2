// Table of all texture references of a material, for loops over them.
#pragma once

#include "scene/scene.h"

#include <array>
#include <set>
#include <string_view>

namespace blush {

struct TextureSlot {
    std::string_view name;
    TextureRef Material::*ref;
};

inline constexpr std::array<TextureSlot, 17> texture_slots{{
    {"base colour texture", &Material::base_color_texture},
    {"metallic-roughness texture", &Material::metallic_roughness_texture},
    {"normal texture", &Material::normal_texture},
    {"emissive texture", &Material::emissive_texture},
    {"specular texture", &Material::specular_texture},
    {"specular colour texture", &Material::specular_color_texture},
    {"transmission texture", &Material::transmission_texture},
    {"clear coat texture", &Material::clearcoat_texture},
    {"clear coat roughness texture", &Material::clearcoat_roughness_texture},
    {"clear coat normal texture", &Material::clearcoat_normal_texture},
    {"sheen colour texture", &Material::sheen_color_texture},
    {"sheen roughness texture", &Material::sheen_roughness_texture},
    {"anisotropy texture", &Material::anisotropy_texture},
    {"iridescence texture", &Material::iridescence_texture},
    {"iridescence thickness texture", &Material::iridescence_thickness_texture},
    {"diffuse transmission texture", &Material::diffuse_transmission_texture},
    {"diffuse transmission colour texture", &Material::diffuse_transmission_color_texture},
}};

// UV sets that a material's textures use.
inline std::set<int> uv_sets_read(const Material& material) {
    std::set<int> sets;
    for (const TextureSlot& slot : texture_slots)
        if ((material.*slot.ref).texture) sets.insert((material.*slot.ref).uv_set);
    return sets;
}

} // namespace blush
