// Internal to gltf_*.cpp: the edits of a scene in the document that it was read from.
#pragma once

#include "core/result.h"
#include "io/gltf_document.h"
#include "scene/edit.h"

#include <vector>

namespace blush {

struct EditedGltf {
    GltfDocument document;
    Scene scene; // as an import of the document gives it, with the triangles and pixels of the edited one
    std::vector<Diagnostic> diagnostics;
};

// Errors: a document that cannot be read back, an image that cannot be encoded. Throws what nlohmann's JSON throws.
Result<EditedGltf> edited_gltf(const GltfOrigin& origin, const Project& project);

} // namespace blush
