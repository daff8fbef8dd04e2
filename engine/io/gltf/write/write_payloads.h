// Internal to io/gltf: writes triangles and pixels that a document does not contain yet.
#pragma once

#include "core/result.h"
#include "io/gltf/write/document.h"

#include <set>
#include <span>

namespace blush {

// Records that are used by nodes, directly or through used meshes and materials.
struct UsedRecords {
    std::set<Id<Mesh>> meshes;
    std::set<Id<Material>> materials;
    std::set<Id<Texture>> textures;
    std::set<Id<Light>> lights;
    std::set<Id<Camera>> cameras;
};
UsedRecords used_records(const Scene& scene);

// Writes the used meshes, materials and textures that the document lacks or whose triangles or pixels differ from `has`, and the
// materials of all meshes. Errors: an image that cannot be encoded.
Result<void> write_payloads(GltfDocument& document, const GltfOrigin& has, const Scene& scene, const UsedRecords& used);

// Appends an accessor with its own buffer view; `components` per element. `with_bounds`: min and max, required for positions.
int append_floats(GltfDocument& document, const float* values, size_t count, int components, bool with_bounds);
int append_indices(GltfDocument& document, std::span<const uint32_t> indices);

} // namespace blush
