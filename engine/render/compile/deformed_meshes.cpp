#include "render/compile/deformed_meshes.h"

#include <algorithm>

namespace blush {

void DeformedMeshes::deform(Scene& posed, const Workers* workers) {
    std::map<Id<Node>, Entry> used;
    WorldTransforms transforms(posed);
    const Table<Node> nodes = posed.nodes;
    for (const auto& [id, node] : nodes) {
        if (!node.skin && node.morph_weights.empty()) continue;
        std::optional<Deformation> how = transforms(id).visible ? deformation_of(posed, transforms, id, node) : std::nullopt;
        if (!how) continue;
        Mesh mesh = *posed.meshes.find(node.mesh);
        const auto before = known_.find(id);
        const auto same_shape = [](const MeshPart& a, const MeshPart& b) { return a.geometry == b.geometry; };
        Entry entry;
        if (before != known_.end() && before->second.deformation == *how &&
            std::ranges::equal(before->second.rest, mesh.parts, same_shape)) {
            entry = std::move(before->second);
        } else {
            entry.rest = mesh.parts;
            for (const MeshPart& part : mesh.parts)
                entry.parts.push_back(part.geometry ? deformed(*part.geometry, *how, workers) : nullptr);
            entry.deformation = *std::move(how);
        }
        for (size_t i = 0; i < mesh.parts.size(); ++i) mesh.parts[i].geometry = entry.parts[i];
        posed.meshes.insert(Id<Mesh>{deformed_id_bit | id.value}, std::move(mesh));
        Node deformed_node = node;
        deformed_node.mesh = Id<Mesh>{deformed_id_bit | id.value};
        deformed_node.morph_weights.clear();
        if (entry.deformation.joints.empty()) deformed_node.skin = {};
        posed.nodes.set(id, std::move(deformed_node));
        used.emplace(id, std::move(entry));
    }
    known_ = std::move(used);
}

Affined world_from_mesh(const Scene& expanded, WorldTransforms& transforms, Id<Node> id, const Node& node) {
    const bool hangs = node.skin && node.mesh.value & deformed_id_bit;
    if (!hangs) return transforms(id).world_from_node;
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, transforms(expanded.skins.find(node.skin)->joints.front()).world_from_node.t};
}

} // namespace blush
