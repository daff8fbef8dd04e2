// Saves a scene into the glTF document that it was read from.
// Edits are written into the original document. Everything else (objects, members, extras, unknown extensions) is kept in place.
// Lights are written to KHR_lights_punctual, rectangles and disks to EXT_lights_area with an emissive mesh as a fallback for
// other programs, hidden nodes to KHR_node_visibility. Values that glTF cannot express, the view and the settings are written to
// extras.blush, so that loading gives the same scene with the same ids. Objects that become unused are pruned, unless the
// document has unknown extensions that may reference them. Added triangles and pixels get a buffer of their own.
#pragma once

#include "core/result.h"
#include "io/gltf/read/geometry/indices.h"
#include "scene/document/edit.h"

#include <filesystem>
#include <vector>

namespace blush {

struct SavedGltf {
    GltfOrigin origin; // of the written file, for the next save
    Scene scene;       // as an import of it gives it, without unused records; shares triangles and pixels
    std::vector<Diagnostic> diagnostics;
};

// Writes a .gltf or .glb, by the extension of `file`. A .glb contains all buffers and images. A .gltf gets copies of its buffers
// and images beside it; both get a copy of the environment map. Atomic: after an error the old file is unchanged and no new files
// remain. Other files are never overwritten: a free name is used. Errors: an unknown extension, a referenced file that cannot be
// read, a folder that cannot be written, more than 4 GB.
// `store_display`: writes the display settings even if they are the defaults, so that opening the file does not meter the exposure.
Result<SavedGltf> save_gltf(const GltfOrigin& origin, const Project& project, const std::filesystem::path& file,
                            bool store_display = false);

} // namespace blush
