// Edits as JSON: the values of a scene that differ from the file it was imported from.
//
//   {"format": 1,
//    "lights": {"changed": [{"id": 1, "name": "Key", "set": {"intensity": 80.0}}],
//               "added":   [{"id": 3, "set": {...every field...}}],
//               "removed": [2]},
//    "nodes": ..., "materials": ..., "cameras": ..., "textures": ...,
//    "meshes": {"changed": [{"id": 4, "name": "Vase", "set": {"materials": [2, 0]}}]},
//    "environment": {"rotation_degrees": 90.0}, "view": {"lens": {...}}, "staging": {"clip": 1, "seconds": 1.5},
//    "left_out": ["mesh \"Chair\" was added: triangles are not kept as text"]}
// Ids are those of the import, which are deterministic; names are informative. Absent parts are unchanged. Environment maps and
// IES profiles are stored as file names and read again. References to records listed in left_out are omitted.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

std::string edits_json(const Scene& imported, const Scene& now);

// Number of entries in left_out; 0 if the text is not valid.
size_t count_left_out(std::string_view json);

// Restores the scene that edits_json was given as `now`, except for left_out. `folder`: base of a relative environment map path;
// IES profiles must be in or below it. Errors: invalid text, an id that the import does not have, a value of the wrong type or
// out of range, an environment map or IES profile that cannot be read.
Result<Scene> apply_edits_json(Scene imported, std::string_view json, const std::filesystem::path& folder = {});

} // namespace blush
