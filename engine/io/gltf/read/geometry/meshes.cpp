#include "io/gltf/read/geometry/meshes.h"

#include "io/gltf/check/size_limits.h"
#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/geometry.h"
#include "io/gltf/read/geometry/parallel_read.h"
#include "io/gltf/read/ids.h"
#include "io/gltf/read/variants.h"
#include "scene/geometry/tangents.h"
#include "scene/texture_slots.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace blush {
namespace {

struct MeshReader {
    const GltfContext& context;
    const std::vector<Id<Material>>& materials;
    const Scene& scene;
    std::vector<int> uv_sets;    // to keep
    std::vector<Id<Mesh>> known; // by index, for a document that is read without its triangles

    // Returns none if there is nothing to render. Thread-safe.
    Result<std::optional<MeshPart>> read(const GltfContext& own, size_t index, size_t p) const {
        const tinygltf::Primitive& primitive = own.model().meshes[index].primitives[p];
        const std::string where = fmt::format("meshes[{}].primitives[{}]", index, p);
        if (primitive.material >= 0 && size_t(primitive.material) >= materials.size())
            return own.error(fmt::format("material {} does not exist; there are {}", primitive.material, materials.size()), where);
        const Id<Material> material = primitive.material >= 0 ? materials[size_t(primitive.material)] : Id<Material>();
        Result<std::vector<Id<Material>>> by_variant = materials_by_variant(own, index, p, material, materials, scene.variants.size());
        if (!by_variant) return by_variant.error();
        Result<GeometryPtr> geometry = own.known ? GeometryPtr() : import_geometry(own, primitive, material, *by_variant, where);
        if (!geometry) return geometry.error();
        if (!*geometry && !is_known_part(index, p)) return std::optional<MeshPart>();
        return std::optional(MeshPart{*std::move(geometry), material, *std::move(by_variant)});
    }

    // The mesh without its parts.
    Mesh named(size_t index) const {
        const tinygltf::Mesh& source = context.model().meshes[index];
        Mesh mesh;
        mesh.name = source.name.empty() ? fmt::format("Mesh {}", index) : source.name;
        mesh.target_names = target_names(index);
        return mesh;
    }

private:
    // Conventional place of the target names.
    std::vector<std::string> target_names(size_t index) const {
        std::vector<std::string> names;
        const size_t targets =
            context.model().meshes[index].primitives.empty() ? 0 : context.model().meshes[index].primitives.front().targets.size();
        for (const ParsedGltf& name : gltf_member(gltf_member(gltf_item(context.json(), "meshes", index), "extras"), "targetNames"))
            if (names.size() < targets) names.push_back(name.is_string() ? name.get<std::string>() : std::string());
        return names;
    }

    bool is_known_part(size_t mesh, size_t primitive) const {
        if (!context.known) return false;
        const auto parts = context.known->primitives.find(known[mesh]);
        return parts != context.known->primitives.end() && std::count(parts->second.begin(), parts->second.end(), int(primitive)) > 0;
    }

    Result<GeometryPtr> import_geometry(const GltfContext& own, const tinygltf::Primitive& primitive, Id<Material> material,
                                        const std::vector<Id<Material>>& by_variant, const std::string& where) const {
        const Material* found = scene.materials.find(material);
        const int tangents = tangent_uv_set(scene, {nullptr, material, by_variant});
        Result<GeometryPtr> geometry = import_primitive(own, primitive, {uv_sets, tangents}, where);
        if (!geometry || !*geometry || !found) return geometry;
        for (const int set : uv_sets_read(*found))
            if (!(*geometry)->has_uv_set(set))
                own.warn(fmt::format("textures use TEXCOORD_{}, which is missing: one texel covers the whole surface", set), where);
        return geometry;
    }
};

// UV sets to keep: the first two, so that textures can be assigned later, and those that textures use. Limited, since meshes with
// shared data could multiply the size of a small file.
std::vector<int> kept_uv_sets(const GltfContext& context, const Scene& scene) {
    constexpr size_t max_kept_uv_sets = 8;
    std::set<int> sets{0, 1};
    for (const auto& [id, material] : scene.materials)
        for (const int set : uv_sets_read(material))
            if (sets.size() < max_kept_uv_sets || sets.contains(set))
                sets.insert(set);
            else
                context.warn(fmt::format("ignored: TEXCOORD_{}; textures use more than {} UV sets", set, max_kept_uv_sets), "materials");
    return {sets.begin(), sets.end()};
}

// A primitive and its converted part.
struct Part {
    size_t mesh = 0, primitive = 0;
    std::optional<MeshPart> read = {};
};

std::vector<Part> parts_of(const GltfContext& context, const std::vector<bool>& used) {
    std::vector<Part> parts;
    for (size_t mesh = 0; mesh < used.size(); ++mesh)
        for (size_t p = 0; used[mesh] && p < context.model().meshes[mesh].primitives.size(); ++p) parts.push_back({mesh, p});
    return parts;
}

Result<void> read_parts(const MeshReader& reader, std::vector<Part>& parts) {
    constexpr int64_t large = int64_t(1) << 26; // bytes: conversion needs as much again
    const GltfContext& context = reader.context;
    GltfPieces pieces{{}, large, "meshes", 0.3, 0.6, context.known ? 1 : context.options.threads};
    for (const Part& part : parts)
        pieces.sizes.push_back(int64_t(decoded_bytes(context, context.model().meshes[part.mesh].primitives[part.primitive])));
    return read_in_parallel(context, pieces, [&](const GltfContext& own, size_t i) -> Result<void> {
        auto read = reader.read(own, parts[i].mesh, parts[i].primitive);
        if (!read) return read.error();
        parts[i].read = *std::move(read);
        return {};
    });
}

} // namespace

Result<ImportedMeshes> import_meshes(const GltfContext& context, const std::vector<int>& nodes, const std::vector<Id<Material>>& materials,
                                     Scene& scene) {
    const auto& sources = context.model().meshes;
    std::vector<bool> used(sources.size());
    for (const int node : nodes) {
        const int mesh = context.model().nodes[size_t(node)].mesh;
        if (mesh >= 0 && size_t(mesh) < sources.size()) used[size_t(mesh)] = true; // out of range: an error when the node is read
    }
    const auto known = context.known ? ids_by_index(context.known->meshes, sources.size()) : std::vector<Id<Mesh>>();
    const MeshReader reader{context, materials, scene, kept_uv_sets(context, scene), known};
    std::vector<Part> parts = parts_of(context, used);
    if (const auto ok = read_parts(reader, parts); !ok) return ok.error();

    ImportedMeshes imported;
    imported.primitives.resize(sources.size());
    std::vector<std::optional<Mesh>> meshes(sources.size());
    std::vector<uint32_t> wanted(sources.size());
    for (size_t i = 0; i < sources.size(); ++i) {
        if (!used[i]) continue;
        meshes[i] = reader.named(i);
        wanted[i] = requested_id(gltf_item(context.json(), "meshes", i));
    }
    for (Part& part : parts) {
        if (!part.read) continue;
        meshes[part.mesh]->parts.push_back(*std::move(part.read));
        imported.primitives[part.mesh].push_back(int(part.primitive));
    }
    imported.ids = add_with_ids(scene.meshes, std::move(meshes), wanted);
    return imported;
}

} // namespace blush
