#include "io/gltf_meshes.h"

#include "io/gltf_geometry.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

Result<Mesh> import_mesh(const GltfContext& context, size_t index, const std::vector<Id<Material>>& materials, const Scene& scene) {
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
        const Material* found = scene.materials.find(material);
        const int tangent_uv_set = found && found->normal_texture.texture ? found->normal_texture.uv_set : -1;
        const Result<GeometryPtr> geometry = import_primitive(context, primitive, tangent_uv_set, where);
        if (!geometry) return geometry.error();
        if (*geometry) mesh.parts.push_back({*geometry, material});
    }
    return mesh;
}

} // namespace

Result<std::vector<Id<Mesh>>> import_meshes(const GltfContext& context, const std::vector<int>& nodes,
                                            const std::vector<Id<Material>>& materials, Scene& scene) {
    const auto& meshes = context.model().meshes;
    std::vector<bool> used(meshes.size());
    for (const int node : nodes) {
        const int mesh = context.model().nodes[size_t(node)].mesh;
        if (mesh >= 0 && size_t(mesh) < meshes.size()) used[size_t(mesh)] = true; // out of range: an error when the node is read
    }
    const auto wanted = std::max<std::ptrdiff_t>(1, std::count(used.begin(), used.end(), true));
    std::vector<Id<Mesh>> ids(meshes.size());
    for (size_t i = 0; i < meshes.size(); ++i) {
        if (!used[i]) continue;
        Result<Mesh> mesh = import_mesh(context, i, materials, scene);
        if (!mesh) return mesh.error();
        ids[i] = scene.meshes.add(*std::move(mesh));
        context.progress(0.6 + 0.4 * double(scene.meshes.size()) / double(wanted), "meshes");
    }
    return ids;
}

} // namespace blush
