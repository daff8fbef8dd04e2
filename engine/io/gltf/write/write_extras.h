// Internal to io/gltf: adds values that glTF cannot express to extras.blush (io/gltf/read/extras.h). Imports the document and writes
// every field that is not read back correctly, so that no field is lost.
#pragma once

#include "core/result.h"
#include "io/gltf/read/import.h"
#include "io/gltf/write/document.h"
#include "scene/document/edit.h"

namespace blush {

// Imports the document without triangles and pixels. Its ids are those of document.indices if write_ids has run.
Result<ImportedScene> read_back(const GltfDocument& document);

// Removes existing extras.blush entries of a record before they are written again.
void clear_extras(Json& object);

// Writes the ids of records that are not the next in sequence.
void write_ids(GltfDocument& document);
// Writes names, and fields that differ in `read`. Records must have the ids of `scene`.
void write_extra_fields(GltfDocument& document, const Scene& read, const Scene& scene);
// Writes environment, light mix, view and settings where they differ from `read`. `store_display`: as save_gltf.
void write_scene_extras(GltfDocument& document, const ImportedScene& read, const Project& project, bool store_display);

} // namespace blush
