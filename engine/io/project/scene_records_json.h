// The records of a scene as JSON without triangles, pixels and keyframes: base of a three-way merge if the file has changed.
//
//   {"nodes": [{"id": 1, "set": {"name": "Lamp", "light": 2}}], "meshes": [{"id": 1, "name": "Vase", "materials": [3], "variants": [[]]}],
//    "materials": ..., "textures": ..., "lights": ..., "cameras": ..., "skins": [{"id": 1, "name": "Fox"}], "clips": ...,
//    "scene_names": [], "variants": [], "environment": {...}, "mix": {...}, "view": {...}, "staging": {...}}
//
// Fields that have their default value are absent.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <string>
#include <string_view>

namespace blush {

std::string records_json(const Scene& scene);

// Restores the scene that records_json was given. Triangles, pixels, instances and IES profiles come from the matching records of
// `file` (matched as in merge_edits); absent without a match. Errors: invalid text, a duplicate id.
Result<Scene> scene_of_records(std::string_view json, const Scene& file);

} // namespace blush
