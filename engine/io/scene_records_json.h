// A scene's records as text, without triangles, pixels and keyframes: what edits are compared with when their file has changed since.
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

// The scene that records_json was given. Triangles, pixels, copies and measured distributions are those of the records of `file` that have the
// same name or path (as merge_edits matches them); without such a record they are absent. Errors: not such text, an id that occurs twice.
Result<Scene> scene_of_records(std::string_view json, const Scene& file);

} // namespace blush
