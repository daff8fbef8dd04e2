// Internal to io/gltf: imports materials and their extensions.
#pragma once

#include "io/gltf/read/context.h"

#include <vector>

namespace blush {

// Adds the file's materials to the scene; result[i] is the id of glTF material i. `textures` as TextureImport::add_to returns them.
// Values outside of their range are clamped with a warning. Errors: a texture index out of range.
Result<std::vector<Id<Material>>> import_materials(const GltfContext& context, const std::vector<Id<Texture>>& textures, Scene& scene);

// True if the conversion of some material needs the texels of its textures.
bool depend_on_pixels(const GltfContext& context);

} // namespace blush
