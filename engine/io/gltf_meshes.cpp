#include "io/gltf_meshes.h"

#include "io/gltf_extras.h"
#include "io/gltf_geometry.h"
#include "io/gltf_numbering.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

struct MeshReader {
    const GltfContext& context;
    const std::vector<Id<Material>>& materials;
    const Scene& scene;
    std::vector<Id<Mesh>> known; // by index, for a document that is read without its triangles

    // Its parts' primitives are added to `primitives`.
    Result<Mesh> read(size_t index, std::vector<int>& primitives) const {
        const tinygltf::Mesh& source = context.model().meshes[index];
        Mesh mesh;
        mesh.name = source.name.empty() ? fmt::format("Mesh {}", index) : source.name;
        for (size_t p = 0; p < source.primitives.size(); ++p) {
            if (context.cancelled()) return context.cancel_error();
            const tinygltf::Primitive& primitive = source.primitives[p];
            const std::string where = fmt::format("meshes[{}].primitives[{}]", index, p);
            if (primitive.material >= 0 && size_t(primitive.material) >= materials.size())
                return context.error(fmt::format("material {} does not exist; there are {}", primitive.material, materials.size()), where);
            const Id<Material> material = primitive.material >= 0 ? materials[size_t(primitive.material)] : Id<Material>();
            const Result<GeometryPtr> geometry = context.known ? GeometryPtr() : import_geometry(primitive, material, where);
            if (!geometry) return geometry.error();
            if (!*geometry && !is_known_part(index, p)) continue;
            mesh.parts.push_back({*geometry, material});
            primitives.push_back(int(p));
        }
        return mesh;
    }

    bool is_known_part(size_t mesh, size_t primitive) const {
        if (!context.known) return false;
        const auto parts = context.known->primitives.find(known[mesh]);
        return parts != context.known->primitives.end() && std::count(parts->second.begin(), parts->second.end(), int(primitive)) > 0;
    }

    Result<GeometryPtr> import_geometry(const tinygltf::Primitive& primitive, Id<Material> material, const std::string& where) const {
        const Material* found = scene.materials.find(material);
        const int tangent_uv_set = found && found->normal_texture.texture ? found->normal_texture.uv_set : -1;
        return import_primitive(context, primitive, tangent_uv_set, where);
    }
};

} // namespace

Result<ImportedMeshes> import_meshes(const GltfContext& context, const std::vector<int>& nodes, const std::vector<Id<Material>>& materials,
                                     Scene& scene) {
    const auto& sources = context.model().meshes;
    std::vector<bool> used(sources.size());
    for (const int node : nodes) {
        const int mesh = context.model().nodes[size_t(node)].mesh;
        if (mesh >= 0 && size_t(mesh) < sources.size()) used[size_t(mesh)] = true; // out of range: an error when the node is read
    }
    const auto total = std::max<std::ptrdiff_t>(1, std::count(used.begin(), used.end(), true));
    const auto known = context.known ? ids_by_index(context.known->meshes, sources.size()) : std::vector<Id<Mesh>>();
    const MeshReader reader{context, materials, scene, known};
    ImportedMeshes imported;
    imported.primitives.resize(sources.size());
    std::vector<std::optional<Mesh>> meshes(sources.size());
    std::vector<uint32_t> wanted(sources.size());
    std::ptrdiff_t done = 0;
    for (size_t i = 0; i < sources.size(); ++i) {
        if (!used[i]) continue;
        Result<Mesh> mesh = reader.read(i, imported.primitives[i]);
        if (!mesh) return mesh.error();
        meshes[i] = *std::move(mesh);
        wanted[i] = wanted_id(gltf_item(context.json(), "meshes", i));
        context.progress(0.6 + 0.4 * double(++done) / double(total), "meshes");
    }
    imported.ids = add_numbered(scene.meshes, std::move(meshes), wanted);
    return imported;
}

} // namespace blush
