// Internal to io/gltf: EXT_lights_image_based, an environment as a cube map that is prefiltered for rasterizers.
#pragma once

#include "io/gltf/read/context.h"
#include "io/gltf/write/document.h"

namespace blush {

// The environment of a glTF scene: the finest mip level of the cube as a lat-long map without a file name. A rotation about +Y
// becomes the environment's rotation; any other is baked into the pixels. Returns no environment if the scene has none or, with a
// warning, if it cannot be read. Without pixels for a document that is being saved.
Environment import_image_light(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where);

// Writes the changes since `read` into the image-based light of the default scene, as far as the extension can express them. If
// the environment was replaced, removes the reference from the scene.
void write_image_light(GltfDocument& document, const Environment& read, const Environment& wanted);

} // namespace blush
