#include "io/gltf/read/variants.h"

#include "io/gltf/read/extras.h"

namespace blush {
namespace {

constexpr const char* extension = "KHR_materials_variants";
constexpr size_t max_variants = 1000;

// Material index by variant; the first mapping of a variant wins.
std::map<int, int> said_by(const Json& primitive) {
    std::map<int, int> said;
    for (const Json& mapping : child_or_null(child_or_null(child_or_null(primitive, "extensions"), extension), "mappings")) {
        int material = -1, variant = -1;
        if (!read_json(child_or_null(mapping, "material"), material)) continue;
        for (const Json& index : child_or_null(mapping, "variants"))
            if (read_json(index, variant)) said.emplace(variant, material);
    }
    return said;
}

} // namespace

std::vector<std::string> import_variants(const GltfContext& context) {
    std::vector<std::string> names;
    const ParsedGltf& list = gltf_member(gltf_member(gltf_member(context.json(), "extensions"), extension), "variants");
    if (!list.is_array()) return names;
    if (list.size() > max_variants)
        context.warn(fmt::format("ignored: variants beyond the first {}", max_variants), fmt::format("extensions.{}", extension));
    for (size_t i = 0; i < std::min(list.size(), max_variants); ++i) {
        const ParsedGltf& name = gltf_member(list[i], "name");
        names.push_back(name.is_string() ? name.get<std::string>() : fmt::format("Variant {}", i));
    }
    return names;
}

Result<std::vector<Id<Material>>> materials_by_variant(const GltfContext& context, size_t mesh, size_t primitive, Id<Material> material,
                                                       const std::vector<Id<Material>>& materials, size_t variants) {
    const std::string where = fmt::format("meshes[{}].primitives[{}].extensions.{}", mesh, primitive, extension);
    const ParsedGltf& object = gltf_element(gltf_member(gltf_item(context.json(), "meshes", mesh), "primitives"), primitive);
    const ParsedGltf& mappings = gltf_member(gltf_member(gltf_member(object, "extensions"), extension), "mappings");
    std::vector<Id<Material>> by_variant;
    if (!mappings.is_array() || mappings.empty() || variants == 0) return by_variant;
    by_variant.resize(variants + 1);
    by_variant[0] = material;
    for (const ParsedGltf& mapping : mappings) {
        const ParsedGltf& index = gltf_member(mapping, "material");
        if (!index.is_number_unsigned() || index.get<uint64_t>() >= materials.size())
            return context.error(fmt::format("a mapping to a material that does not exist; there are {}", materials.size()), where);
        for (const ParsedGltf& variant : gltf_member(mapping, "variants")) {
            if (!variant.is_number_unsigned() || variant.get<uint64_t>() >= variants)
                context.warn("ignored: a mapping for a variant that does not exist", where);
            else if (Id<Material>& slot = by_variant[variant.get<size_t>() + 1]; !slot)
                slot = materials[index.get<size_t>()];
        }
    }
    return by_variant;
}

void write_variants(Json& primitive, const MeshPart& part, const std::map<Id<Material>, int>& materials) {
    std::map<int, int> wanted;
    for (size_t slot = 1; slot < part.by_variant.size(); ++slot)
        if (const auto material = materials.find(part.by_variant[slot]); material != materials.end())
            wanted[int(slot) - 1] = material->second;
    if (said_by(primitive) == wanted) return;
    erase_extension(primitive, extension);
    std::map<int, std::vector<int>> by_material;
    for (const auto& [variant, material] : wanted) by_material[material].push_back(variant);
    for (const auto& [material, variants] : by_material)
        extension_of(primitive, extension)["mappings"].push_back({{"material", material}, {"variants", variants}});
}

} // namespace blush
