// The places where a material can hold a texture, as a list to loop over.
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

inline constexpr std::array<TextureSlot, 7> texture_slots{{
    {"base colour texture", &Material::base_color_texture},
    {"metallic-roughness texture", &Material::metallic_roughness_texture},
    {"normal texture", &Material::normal_texture},
    {"emissive texture", &Material::emissive_texture},
    {"specular texture", &Material::specular_texture},
    {"specular colour texture", &Material::specular_color_texture},
    {"transmission texture", &Material::transmission_texture},
}};

// The UV sets that a material's textures are laid out by.
inline std::set<int> uv_sets_read(const Material& material) {
    std::set<int> sets;
    for (const TextureSlot& slot : texture_slots)
        if ((material.*slot.ref).texture) sets.insert((material.*slot.ref).uv_set);
    return sets;
}

} // namespace blush
