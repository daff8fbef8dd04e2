// Images on materials, put there and taken away: edits of the document. Pure but for the document.
#pragma once

#include "scene/document.h"

#include <string>

namespace blush {

// Puts an image into a slot of a material, as one step of the history; how it is placed there stays. Errors: a material that is no longer there,
// what the document refuses.
Result<void> set_map(Document& document, Id<Material> material, TextureRef Material::*slot, const std::string& label, Texture texture,
                     Gesture gesture);
// Some mesh with this material says where on an image its vertices lie.
bool has_texture_coordinates(const Scene& scene, Id<Material> material);

} // namespace blush
