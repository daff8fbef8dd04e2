#include "scene/reference_check.h"

#include "scene/texture_slots.h"

#include <fmt/format.h>

#include <string_view>

namespace blush {
namespace {

template <class T>
Result<void> none_or_known(const Table<T>& table, Id<T> id, std::string_view what, std::string_view kind, const std::string& name) {
    if (!id || table.contains(id)) return {};
    return Error{.what = fmt::format("there is no {} {}", what, id.value), .where = fmt::format("{} \"{}\"", kind, name)};
}

} // namespace

Result<void> check_references(const Scene& scene, const Node& node) {
    if (auto known = none_or_known(scene.nodes, node.parent, "parent node", "node", node.name); !known) return known;
    if (auto known = none_or_known(scene.meshes, node.mesh, "mesh", "node", node.name); !known) return known;
    if (auto known = none_or_known(scene.lights, node.light, "light", "node", node.name); !known) return known;
    if (auto known = none_or_known(scene.skins, node.skin, "skin", "node", node.name); !known) return known;
    for (const int32_t s : node.only_in_scenes)
        if (s < 0 || size_t(s) >= scene.scene_names.size())
            return Error{.what = fmt::format("there is no scene {}", s), .where = fmt::format("node \"{}\"", node.name)};
    return none_or_known(scene.cameras, node.camera, "camera", "node", node.name);
}

Result<void> check_references(const Scene& scene, const Mesh& mesh) {
    for (const MeshPart& part : mesh.parts) {
        if (auto known = none_or_known(scene.materials, part.material, "material", "mesh", mesh.name); !known) return known;
        for (const Id<Material> material : part.by_variant)
            if (auto known = none_or_known(scene.materials, material, "material", "mesh", mesh.name); !known) return known;
        if (!part.by_variant.empty() && part.by_variant.size() != scene.variants.size() + 1)
            return Error{.what = fmt::format("{} materials for {} variants", part.by_variant.size() - 1, scene.variants.size()),
                         .where = fmt::format("mesh \"{}\"", mesh.name)};
    }
    return {};
}

Result<void> check_references(const Scene& scene, const Material& material) {
    for (const TextureSlot& slot : texture_slots)
        if (auto known = none_or_known(scene.textures, (material.*slot.ref).texture, slot.name, "material", material.name); !known)
            return known;
    return {};
}

bool is_below(const Scene& scene, Id<Node> node, Id<Node> ancestor) {
    for (size_t steps = 0; node && steps <= scene.nodes.size(); ++steps) {
        if (node == ancestor) return true;
        const Node* n = scene.nodes.find(node);
        node = n ? n->parent : Id<Node>{};
    }
    return false;
}

} // namespace blush
