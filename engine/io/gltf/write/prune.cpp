#include "io/gltf/write/prune.h"

#include "io/gltf/write/references.h"

#include <algorithm>

namespace blush {
namespace {

void mark(GltfDocument& document, std::vector<std::pair<std::string_view, int>> waiting, GltfObjects& used) {
    while (!waiting.empty()) {
        const auto [list, index] = waiting.back();
        waiting.pop_back();
        Json* objects = document.find_list(list);
        if (!objects || index < 0 || size_t(index) >= objects->size() || !used.insert({list, index}).second) continue;
        visit_references(list, (*objects)[size_t(index)],
                         [&](std::string_view target, Json& reference) { waiting.emplace_back(target, reference.get<int>()); });
    }
}

std::vector<std::pair<std::string_view, int>> all_of(GltfDocument& document, std::string_view list) {
    std::vector<std::pair<std::string_view, int>> objects;
    const Json* found = document.find_list(list);
    for (int i = 0; found && i < int(found->size()); ++i) objects.emplace_back(list, i);
    return objects;
}

bool all_references_known(const Json& root) {
    return std::ranges::all_of(child_or_null(root, "extensionsUsed"), [](const Json& name) {
        return name.is_string() && finds_all_references(name.get_ref<const std::string&>());
    });
}

// New index of each object of a list; -1: removed.
using Moves = std::map<std::string_view, std::vector<int>>;

template <class Key> void move(std::map<Id<Key>, int>& indices, const std::vector<int>& moves) {
    for (auto& [id, index] : indices) index = moves[size_t(index)];
    std::erase_if(indices, [](const auto& entry) { return entry.second < 0; });
}

void move_indices(GltfDocument& document, Moves& moves) {
    GltfIndices& indices = document.indices;
    move(indices.nodes, moves["nodes"]);
    move(indices.meshes, moves["meshes"]);
    move(indices.materials, moves["materials"]);
    move(indices.textures, moves["textures"]);
    move(indices.cameras, moves["cameras"]);
    move(indices.skins, moves["skins"]);
    move(indices.clips, moves["animations"]);
    for (auto& [id, light] : indices.lights) light.index = moves[list_name(light.list)][size_t(light.index)];
    std::erase_if(indices.lights, [](const auto& entry) { return entry.second.index < 0; });
    std::map<int, float> peaks;
    for (const auto& [index, peak] : indices.profile_peaks)
        if (const int now = moves[list_name(GltfLight::List::measured)][size_t(index)]; now >= 0) peaks[now] = peak;
    indices.profile_peaks = std::move(peaks);
    std::erase_if(indices.primitives, [&](const auto& entry) { return !indices.meshes.contains(entry.first); });
    if (document.added_buffer >= 0) document.added_buffer = moves["buffers"][size_t(document.added_buffer)];
}

// glTF does not allow empty lists.
void erase_empty_list(GltfDocument& document, std::string_view list) {
    const Json* objects = document.find_list(list);
    if (!objects || !objects->empty()) return;
    if (is_extension_list(list))
        erase_extension(document.root, list);
    else
        erase(document.root, list);
}

} // namespace

GltfObjects used_objects(GltfDocument& document) {
    GltfObjects used;
    mark(document, all_of(document, "scenes"), used);
    mark(document, all_of(document, "animations"), used);
    return used;
}

std::map<std::string_view, int> count_objects(GltfDocument& document) {
    std::map<std::string_view, int> counts;
    for (const std::string_view list : gltf_lists) counts[list] = int(all_of(document, list).size());
    return counts;
}

int prune_unused(GltfDocument& document, const GltfObjects& used_before, const std::map<std::string_view, int>& counts_before) {
    GltfObjects kept = used_objects(document);
    for (const std::string_view list : gltf_lists)
        for (int i = 0; i < counts_before.at(list); ++i)
            if (!used_before.contains({list, i})) mark(document, {{list, i}}, kept);

    Moves moves;
    int unused = 0;
    for (const std::string_view list : gltf_lists) {
        int next = 0;
        for (const auto& object : all_of(document, list)) moves[list].push_back(kept.contains(object) ? next++ : -1);
        unused += int(moves[list].size()) - next;
    }
    if (unused == 0) return 0;
    if (!all_references_known(document.root)) return unused;

    for (const std::string_view list : gltf_lists) {
        Json* objects = document.find_list(list);
        if (!objects) continue;
        Json left = Json::array();
        for (size_t i = 0; i < objects->size(); ++i) {
            if (moves[list][i] < 0) continue;
            visit_references(list, (*objects)[i], [&](std::string_view target, Json& reference) {
                const std::vector<int>& to = moves[target];
                const int index = reference.get<int>();
                if (index >= 0 && size_t(index) < to.size()) reference = to[size_t(index)];
            });
            left.push_back(std::move((*objects)[i]));
        }
        *objects = std::move(left);
    }
    move_indices(document, moves);
    for (const std::string_view list : gltf_lists) erase_empty_list(document, list);
    return 0;
}

} // namespace blush
