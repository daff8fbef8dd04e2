#include "scene/document/preview_scene.h"

#include "scene/texture_slots.h"

#include <algorithm>

namespace blush {
namespace {

constexpr float middle = 0.5f;          // mean texel of a linear texture
constexpr float middle_grey = 0.21404f; // mean texel of a colour texture: sRGB 0.5, linear

Material preview_scene(Material m, const Table<Texture>& textures) {
    const auto is_missing = [&](const TextureRef& ref) {
        const Texture* texture = textures.find(ref.texture);
        return ref.texture && (!texture || !texture->image);
    };
    const auto dim = [&](const TextureRef& texture, float& factor) {
        if (is_missing(texture)) factor *= middle;
    };
    const auto dim_color = [&](const TextureRef& texture, Vec3& factor) {
        if (is_missing(texture)) factor = {factor.x * middle_grey, factor.y * middle_grey, factor.z * middle_grey};
    };
    dim_color(m.base_color_texture, m.base_color);
    if (is_missing(m.metallic_roughness_texture)) m.metallic = 0;
    dim_color(m.emissive_texture, m.emissive);
    dim(m.specular_texture, m.specular);
    dim_color(m.specular_color_texture, m.specular_color);
    if (is_missing(m.specular_color_texture)) m.roughness = std::max(m.roughness, middle);
    dim(m.transmission_texture, m.transmission);
    dim(m.clearcoat_texture, m.clearcoat);
    dim(m.clearcoat_roughness_texture, m.clearcoat_roughness);
    dim_color(m.sheen_color_texture, m.sheen_color);
    dim(m.sheen_roughness_texture, m.sheen_roughness);
    dim(m.anisotropy_texture, m.anisotropy);
    dim(m.iridescence_texture, m.iridescence);
    dim(m.diffuse_transmission_texture, m.diffuse_transmission);
    dim_color(m.diffuse_transmission_color_texture, m.diffuse_transmission_color);
    for (const TextureSlot& slot : texture_slots)
        if (is_missing(m.*slot.ref)) m.*slot.ref = {};
    return m;
}

} // namespace

Scene preview_scene(Scene scene) {
    const Table<Material> textured = scene.materials;
    for (const auto& [id, material] : textured) scene.materials.set(id, preview_scene(material, scene.textures));
    const Table<Texture> textures = scene.textures;
    for (const auto& [id, texture] : textures)
        if (!texture.image) scene.textures.remove(id);
    return scene;
}

} // namespace blush
