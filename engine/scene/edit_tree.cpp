#include "scene/edit_tree.h"

#include "scene/texture_slots.h"

#include <fmt/format.h>

#include <unordered_map>
#include <unordered_set>

namespace blush {
namespace {

// From the ids of one scene to those of another.
template <class T> class IdMap {
public:
    void set(Id<T> from, Id<T> to) { to_[from.value] = to; }
    bool contains(Id<T> from) const { return to_.contains(from.value); }
    Id<T> operator()(Id<T> from) const {
        const auto it = to_.find(from.value);
        return it == to_.end() ? Id<T>{} : it->second;
    }

private:
    std::unordered_map<uint32_t, Id<T>> to_;
};

template <class T, class Fix> IdMap<T> merge_table(Table<T>& table, const Table<T>& other, const Fix& fix) {
    IdMap<T> map;
    for (const auto& [id, value] : other) {
        T copy = value;
        fix(copy);
        map.set(id, table.add(std::move(copy)));
    }
    return map;
}

constexpr auto unchanged = [](const auto&) {};

template <class T> Id<T> copy_record(Table<T>& table, Id<T> id) {
    const T* record = table.find(id);
    return record ? table.add(T(*record)) : Id<T>{};
}

// "Lamp" -> "Lamp 2", "Lamp 2" -> "Lamp 3": the first that no node has.
std::string fresh_name(const Scene& scene, const std::string& name) {
    const size_t digits = name.find_last_not_of("0123456789");
    const bool numbered = digits != name.npos && digits + 1 < name.size() && name[digits] == ' ';
    const std::string stem = numbered ? name.substr(0, digits) : name;
    std::unordered_set<std::string> taken;
    for (const auto& [id, node] : scene.nodes) taken.insert(node.name);
    for (int n = 2;; ++n)
        if (std::string candidate = fmt::format("{} {}", stem, n); !taken.contains(candidate)) return candidate;
}

} // namespace

std::vector<Id<Node>> subtree(const Scene& scene, Id<Node> root) {
    std::vector<Id<Node>> found;
    if (!scene.nodes.contains(root)) return found;
    std::unordered_map<uint32_t, std::vector<Id<Node>>> children;
    for (const auto& [id, node] : scene.nodes) children[node.parent.value].push_back(id);
    found.push_back(root);
    for (size_t next = 0; next < found.size(); ++next)
        if (const auto it = children.find(found[next].value); it != children.end())
            found.insert(found.end(), it->second.begin(), it->second.end());
    return found;
}

void duplicate_subtree(Scene& scene, Id<Node> root) {
    IdMap<Node> map;
    for (const Id<Node> id : subtree(scene, root)) {
        Node copy = *scene.nodes.find(id);
        if (map.contains(copy.parent)) copy.parent = map(copy.parent);
        if (id == root) copy.name = fresh_name(scene, copy.name);
        copy.light = copy_record(scene.lights, copy.light);
        copy.camera = copy_record(scene.cameras, copy.camera);
        map.set(id, scene.nodes.add(std::move(copy)));
    }
}

void remove_subtree(Scene& scene, Id<Node> root) {
    for (const Id<Node> id : subtree(scene, root)) scene.nodes.remove(id);
}

void merge(Scene& scene, const Scene& other) {
    const IdMap<Texture> textures = merge_table(scene.textures, other.textures, unchanged);
    const IdMap<Material> materials = merge_table(scene.materials, other.materials, [&](Material& m) {
        for (const TextureSlot& slot : texture_slots) (m.*slot.ref).texture = textures((m.*slot.ref).texture);
    });
    const IdMap<Mesh> meshes = merge_table(scene.meshes, other.meshes, [&](Mesh& mesh) {
        for (MeshPart& part : mesh.parts) part.material = materials(part.material);
    });
    const IdMap<Light> lights = merge_table(scene.lights, other.lights, unchanged);
    const IdMap<Camera> cameras = merge_table(scene.cameras, other.cameras, unchanged);
    const IdMap<Node> nodes = merge_table(scene.nodes, other.nodes, [&](Node& node) {
        node.mesh = meshes(node.mesh);
        node.light = lights(node.light);
        node.camera = cameras(node.camera);
    });
    // A child may come before its parent, so parents are known only now.
    for (const auto& [old_id, old_node] : other.nodes) {
        Node node = *scene.nodes.find(nodes(old_id));
        node.parent = nodes(old_node.parent);
        scene.nodes.set(nodes(old_id), std::move(node));
    }
}

} // namespace blush
