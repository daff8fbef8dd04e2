// Internal to gltf_*.cpp: triangles and pixels that a document does not have yet.
#pragma once

#include "core/result.h"
#include "io/gltf_document.h"

#include <set>
#include <span>

namespace blush {

// Which records of a scene something in it uses: a node, or a mesh or material that is used.
struct UsedRecords {
    std::set<Id<Mesh>> meshes;
    std::set<Id<Material>> materials;
    std::set<Id<Texture>> textures;
    std::set<Id<Light>> lights;
    std::set<Id<Camera>> cameras;
};
UsedRecords used_records(const Scene& scene);

// Objects for the used meshes, materials and textures that the document lacks or has with other triangles or pixels than `has`;
// and the materials of all meshes. Errors: an image that cannot be encoded.
Result<void> write_payloads(GltfDocument& document, const GltfOrigin& has, const Scene& scene, const UsedRecords& used);

// Accessors of views of their own; `components` per element. Bounds are what positions must have.
int append_floats(GltfDocument& document, const float* values, size_t count, int components, bool with_bounds);
int append_indices(GltfDocument& document, std::span<const uint32_t> indices);

} // namespace blush
