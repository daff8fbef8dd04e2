// Internal to gltf_*.cpp: KHR_materials_variants.
#pragma once

#include "io/gltf_document.h"
#include "io/gltf_source.h"

#include <string>
#include <vector>

namespace blush {

// Their names; beyond a thousand there are none, with a warning.
std::vector<std::string> import_variants(const GltfContext& context);

// Of a primitive that wears `material` without a variant: as MeshPart::by_variant has it; empty if it wears nothing else. Errors: a material
// out of range.
Result<std::vector<Id<Material>>> materials_by_variant(const GltfContext& context, size_t mesh, size_t primitive, Id<Material> material,
                                                       const std::vector<Id<Material>>& materials, size_t variants);

// What a primitive wears under which variant, where that is not what it says. The document has all of the materials.
void write_variants(Json& primitive, const MeshPart& part, const std::map<Id<Material>, int>& materials);

} // namespace blush
