// Edits that add and remove textures of materials. Pure, except for the document.
#pragma once

#include "scene/document/document.h"

#include <string>

namespace blush {

// Puts an image into a texture slot of a material, as one undo step; keeps the slot's UV transform. Errors: the material was
// deleted, or the document refuses the edit.
Result<void> set_map(Document& document, Id<Material> material, TextureRef Material::*slot, const std::string& label, Texture texture,
                     Gesture gesture);
// True if any mesh with this material has texture coordinates.
bool has_texture_coordinates(const Scene& scene, Id<Material> material);

} // namespace blush
