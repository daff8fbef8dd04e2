// Inspector sections of the material layers: clear coat, sheen, anisotropy, thin film, translucency.
#pragma once

#include "scene/scene.h"
#include "ui/widgets/widgets.h"

#include <array>

namespace blush {

NumberStyle unit_interval(float reset, const char* tip);

// One section per layer, open if the material uses it.
void draw_material_layers(Fields& f, UiState& ui, Material& m);

struct LayerTexture {
    const char* label;
    TextureRef Material::*ref;
    const char* tip;
};
inline constexpr std::array layer_textures{
    LayerTexture{"Coat map", &Material::clearcoat_texture, "Red multiplies the clear coat."},
    LayerTexture{"Coat roughness map", &Material::clearcoat_roughness_texture, "Green multiplies the coat's roughness."},
    LayerTexture{"Coat normal map", &Material::clearcoat_normal_texture,
                 "Normal map of the coat. Without it the coat has the mesh's normals; the base normal map does not apply."},
    LayerTexture{"Sheen map", &Material::sheen_color_texture, "Multiplies the sheen's colour."},
    LayerTexture{"Sheen roughness map", &Material::sheen_roughness_texture, "Its alpha multiplies the sheen's roughness."},
    LayerTexture{"Anisotropy map", &Material::anisotropy_texture,
                 "Red and green: direction of the stretch; grey is no direction. Blue multiplies the anisotropy."},
    LayerTexture{"Film map", &Material::iridescence_texture, "Red multiplies the iridescence."},
    LayerTexture{"Film thickness map", &Material::iridescence_thickness_texture, "Green: thickness, from minimum (0) to maximum (1)."},
    LayerTexture{"Translucency map", &Material::diffuse_transmission_texture, "Its alpha multiplies the translucency."},
    LayerTexture{"Translucency tint map", &Material::diffuse_transmission_color_texture, "Multiplies the colour of the transmitted light."},
};

} // namespace blush
