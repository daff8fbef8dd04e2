// A scene back into the glTF document that it was read from.
//
// Edits are written into the original document: what they do not touch (objects, members, extras, extensions that nobody here
// knows) stays where and as it was. Lights go to KHR_lights_punctual, rectangles to EXT_lights_area with a glowing quad for programs that
// know neither; hidden nodes to KHR_node_visibility. What glTF cannot say, and view and settings, go to extras.blush: reading the file
// gives the very same scene, ids included. Objects that an edit leaves without a use go, unless the document has extensions that may name
// them in ways that are not known; added triangles and pixels go into a buffer of their own.
#pragma once

#include "core/result.h"
#include "io/gltf_indices.h"
#include "scene/edit.h"

#include <filesystem>
#include <vector>

namespace blush {

struct SavedGltf {
    GltfOrigin origin; // of the written file: what the next save starts from
    Scene scene;       // as an import of it gives it, sharing triangles and pixels: without records that nothing used
    std::vector<Diagnostic> diagnostics;
};

// Writes a .gltf or .glb, by the extension of `file`. All buffers of a .glb are in it, images too; a .gltf has beside it copies of the
// buffers and images that it names, and so have both of an environment map. Atomic: upon failure the old file is there
// as it was, and nothing new. Files beside it that have other contents are never overwritten: another name is taken.
// Errors: an unknown extension, a file that the original names and that cannot be read, a folder that cannot be written, more than 4 GB.
Result<SavedGltf> save_gltf(const GltfOrigin& origin, const Project& project, const std::filesystem::path& file);

} // namespace blush
