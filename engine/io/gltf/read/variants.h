// Internal to io/gltf: reads and writes KHR_materials_variants.
#pragma once

#include "io/gltf/read/context.h"
#include "io/gltf/write/document.h"

#include <string>
#include <vector>

namespace blush {

// Names of the variants; those beyond a thousand are ignored with a warning.
std::vector<std::string> import_variants(const GltfContext& context);

// MeshPart::by_variant of a primitive with the default `material`; empty if no variant changes it. Errors: a material out of
// range.
Result<std::vector<Id<Material>>> materials_by_variant(const GltfContext& context, size_t mesh, size_t primitive, Id<Material> material,
                                                       const std::vector<Id<Material>>& materials, size_t variants);

// Writes the material mappings of a primitive where they differ from the document, which must hold all materials.
void write_variants(Json& primitive, const MeshPart& part, const std::map<Id<Material>, int>& materials);

} // namespace blush
