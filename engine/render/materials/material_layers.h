// The layers of KHR_materials_* as records for kernels.
#pragma once

#include "render/materials/material_factors.h"
#include "shading/features.h"
#include "shading/material_layers.h"

#include <array>

namespace blush {

// From the factors only; textures are not read yet.
LayerRecord layer_factors_of(const Material& material);
Features layer_features_of(const Material& material);
// True if the material has a normal map for its clear coat.
bool has_coat_normal_map(const Material& material);

inline bool is_coated(const Material& m) { return !m.unlit && m.clearcoat > 0; }
inline bool has_sheen(const Material& m) { return !m.unlit && std::max({m.sheen_color.x, m.sheen_color.y, m.sheen_color.z}) > 0; }
inline bool is_anisotropic(const Material& m) { return reflects(m) && m.anisotropy > 0; }
inline bool has_film(const Material& m) { return reflects(m) && m.iridescence > 0; }
// Only refracting solids disperse; ior 0 means an infinite index, which lets no light in.
inline bool disperses(const Material& m) { return transmits(m) && !is_thin(m) && m.dispersion > 0 && m.ior > 1; }

inline constexpr std::array layer_texture_slots{
    CompiledSlot<LayerRecord>{&Material::clearcoat_texture, &LayerRecord::clearcoat_texture, false, is_coated},
    CompiledSlot<LayerRecord>{&Material::clearcoat_roughness_texture, &LayerRecord::clearcoat_roughness_texture, false, is_coated},
    CompiledSlot<LayerRecord>{&Material::clearcoat_normal_texture, &LayerRecord::clearcoat_normal_texture, false, has_coat_normal_map},
    CompiledSlot<LayerRecord>{&Material::sheen_color_texture, &LayerRecord::sheen_color_texture, true, has_sheen},
    CompiledSlot<LayerRecord>{&Material::sheen_roughness_texture, &LayerRecord::sheen_roughness_texture, false, has_sheen},
    CompiledSlot<LayerRecord>{&Material::anisotropy_texture, &LayerRecord::anisotropy_texture, false, is_anisotropic},
    CompiledSlot<LayerRecord>{&Material::iridescence_texture, &LayerRecord::iridescence_texture, false, has_film},
    CompiledSlot<LayerRecord>{&Material::iridescence_thickness_texture, &LayerRecord::film_thickness_texture, false, has_film},
    CompiledSlot<LayerRecord>{&Material::diffuse_transmission_texture, &LayerRecord::diffuse_transmission_texture, false, is_translucent},
    CompiledSlot<LayerRecord>{&Material::diffuse_transmission_color_texture, &LayerRecord::diffuse_transmission_color_texture, true,
                              is_translucent},
};

} // namespace blush
