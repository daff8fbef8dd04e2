// Internal to io/gltf: writes the edits of a scene into the document that it was read from.
#pragma once

#include "core/result.h"
#include "io/gltf/write/document.h"
#include "scene/document/edit.h"

#include <vector>

namespace blush {

struct EditedGltf {
    GltfDocument document;
    Scene scene; // as an import of the document gives it, with the triangles and pixels of the edited scene
    std::vector<Diagnostic> diagnostics;
};

// `store_display`: as save_gltf. Errors: a document that cannot be read back, an image that cannot be encoded. Throws
// nlohmann::json::exception.
Result<EditedGltf> edited_gltf(const GltfOrigin& origin, const Project& project, bool store_display);

} // namespace blush
