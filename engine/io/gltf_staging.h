// Internal to gltf_*.cpp: what was chosen of what the file offers, in `extras.blush.staging` of the scene that is shown by default:
//
//   {"animation": 0, "seconds": 1.5, "scene": 1, "variant": 2}     indices; what is absent is not chosen
#pragma once

#include "io/gltf_source.h"
#include "io/json_fields.h"

namespace blush {

// What there is to choose from, and which of them the file shows.
void import_scene_names(const GltfContext& context, Scene& scene);
// Sets scene.staging. What makes no sense is left as the file has it, with a warning.
void import_staging(const GltfContext& context, size_t gltf_scene, const GltfIndices& indices, Scene& scene);

Json staging_json(const Scene& scene, const GltfIndices& indices);

} // namespace blush
