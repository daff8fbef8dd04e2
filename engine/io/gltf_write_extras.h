// Internal to gltf_*.cpp: what a document does not say of its records, added to extras.blush (gltf_extras.h) by looking at what
// the importer makes of it. No field can be forgotten: whatever does not come back is written there.
#pragma once

#include "core/result.h"
#include "io/gltf_document.h"
#include "io/gltf_import.h"
#include "scene/edit.h"

namespace blush {

// What the importer makes of a document: all but triangles and pixels. Its ids are those of document.indices if write_ids has run.
Result<ImportedScene> read_back(const GltfDocument& document);

// Takes out what earlier saves, or we by hand, have written beside a record, before it is written anew.
void clear_extras(Json& object);

// Ids of the records, where counting would give others.
void write_ids(GltfDocument& document);
// Names, and fields that did not come back in `read`. Records must have the ids of `scene`.
void write_extra_fields(GltfDocument& document, const Scene& read, const Scene& scene);
// Environment, light mix, view and settings, where they differ from what was read.
void write_scene_extras(GltfDocument& document, const ImportedScene& read, const Project& project);

} // namespace blush
