// Internal to gltf_*.cpp: EXT_lights_image_based, an environment as a cube map that is filtered for programs that cannot trace rays.
#pragma once

#include "io/gltf_document.h"
#include "io/gltf_source.h"

namespace blush {

// The environment that a glTF scene names: the sharpest level of the cube, as a lat-long map without a file's name. A turn about +Y becomes the
// map's rotation, any other is in its pixels. Without one, or, with a warning, where it cannot be read, no environment. Of a document that is
// being saved: without pixels.
Environment import_image_light(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where);

// Into the image-based light of the scene that is shown, what has changed of it since it was `read`, as far as it can say that. If the
// environment is another one by now, the scene names it no more.
void write_image_light(GltfDocument& document, const Environment& read, const Environment& wanted);

} // namespace blush
