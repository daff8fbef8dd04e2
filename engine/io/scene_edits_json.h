// What an editing session changed, as text: the values of a scene that differ from the file it was imported from.
//
//   {"format": 1,
//    "lights": {"changed": [{"id": 1, "name": "Key", "set": {"intensity": 80.0}}],
//               "added":   [{"id": 3, "set": {...every field...}}],
//               "removed": [2]},
//    "nodes": ..., "materials": ..., "cameras": ..., "textures": ...,
//    "meshes": {"changed": [{"id": 4, "name": "Vase", "set": {"materials": [2, 0]}}]},
//    "environment": {"rotation_degrees": 90.0}, "view": {"lens": {...}}, "staging": {"clip": 1, "seconds": 1.5},
//    "left_out": ["mesh \"Chair\" was added: triangles are not kept as text"]}
//
// Ids are those of the import, which numbers a file's records the same each time; names are for people. Absent parts are
// unchanged. An environment map and a light's measured distribution are named by their files and read again. What is left out is left out of everything that refers to it.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

std::string edits_json(const Scene& imported, const Scene& now);

// How many things it lists as left out; 0 for what is no such text.
size_t edits_left_out(std::string_view json);

// The scene that edits_json was given as `now`, apart from what it lists as left out. `folder` is where a relative path of an
// environment map begins; measured distributions lie in or below it. Errors: not such text, an id that the import does not have, a value
// of the wrong type or out of range, an environment map or a measured distribution that cannot be read.
Result<Scene> apply_edits_json(Scene imported, std::string_view json, const std::filesystem::path& folder = {});

} // namespace blush
