// Internal to io/gltf: reads and writes the scene selection, in `extras.blush.staging` of the default scene:
//
//   {"animation": 0, "seconds": 1.5, "scene": 1, "variant": 2}     indices; absent: not chosen
#pragma once

#include "io/gltf/read/context.h"
#include "io/project/json_fields.h"

namespace blush {

// Reads the names of the scenes and the default scene.
void import_scene_names(const GltfContext& context, Scene& scene);
// Sets scene.scene_selection. Invalid values are ignored with a warning.
void import_scene_selection(const GltfContext& context, size_t gltf_scene, const GltfIndices& indices, Scene& scene);

Json scene_selection_json(const Scene& scene, const GltfIndices& indices);

} // namespace blush
