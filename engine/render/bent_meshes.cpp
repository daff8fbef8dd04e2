#include "render/bent_meshes.h"

#include <algorithm>

namespace blush {

void BentMeshes::bend(Scene& posed) {
    std::map<Id<Node>, Entry> used;
    Placements placements(posed);
    const Table<Node> nodes = posed.nodes;
    for (const auto& [id, node] : nodes) {
        if (!node.skin && node.morph_weights.empty()) continue;
        std::optional<Bend> how = placements(id).visible ? bend_of(posed, placements, id, node) : std::nullopt;
        if (!how) continue;
        Mesh mesh = *posed.meshes.find(node.mesh);
        const auto before = known_.find(id);
        const auto same_shape = [](const MeshPart& a, const MeshPart& b) { return a.geometry == b.geometry; };
        Entry entry;
        if (before != known_.end() && before->second.bend == *how && std::ranges::equal(before->second.rest, mesh.parts, same_shape)) {
            entry = std::move(before->second);
        } else {
            entry.rest = mesh.parts;
            for (const MeshPart& part : mesh.parts) entry.parts.push_back(part.geometry ? bent(*part.geometry, *how) : nullptr);
            entry.bend = *std::move(how);
        }
        for (size_t i = 0; i < mesh.parts.size(); ++i) mesh.parts[i].geometry = entry.parts[i];
        posed.meshes.insert(Id<Mesh>{bent_bit | id.value}, std::move(mesh));
        Node bent_node = node;
        bent_node.mesh = Id<Mesh>{bent_bit | id.value};
        bent_node.morph_weights.clear();
        if (entry.bend.joints.empty()) bent_node.skin = {};
        posed.nodes.set(id, std::move(bent_node));
        used.emplace(id, std::move(entry));
    }
    known_ = std::move(used);
}

Affined world_from_mesh(const Scene& lowered, Placements& placements, Id<Node> id, const Node& node) {
    const bool hangs = node.skin && node.mesh.value & bent_bit;
    if (!hangs) return placements(id).world_from_node;
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, placements(lowered.skins.find(node.skin)->joints.front()).world_from_node.t};
}

} // namespace blush
