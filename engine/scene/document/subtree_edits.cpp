#include "scene/document/subtree_edits.h"

#include "scene/animation/pose.h"
#include "scene/texture_slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace blush {
namespace {

// Maps the ids of one scene to those of another.
template <class T> class IdMap {
public:
    void set(Id<T> from, Id<T> to) { to_[from.value] = to; }
    auto begin() const { return to_.begin(); }
    auto end() const { return to_.end(); }
    bool contains(Id<T> from) const { return to_.contains(from.value); }
    Id<T> operator()(Id<T> from) const {
        const auto it = to_.find(from.value);
        return it == to_.end() ? Id<T>{} : it->second;
    }

private:
    std::map<uint32_t, Id<T>> to_; // ordered, so that results are deterministic
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

// Removes the nodes of scenes that are not chosen.
Scene shown_scene(Scene scene) {
    if (scene.scene_names.empty()) return scene;
    const Table<Node> nodes = scene.nodes;
    for (auto [id, node] : nodes) {
        if (is_root_of_other_scene(scene, node)) remove_subtree(scene, id);
        node.only_in_scenes.clear();
        scene.nodes.set(id, std::move(node));
    }
    return scene;
}

template <class T> Id<T> copy_record(Table<T>& table, Id<T> id) {
    const T* record = table.find(id);
    return record ? table.add(T(*record)) : Id<T>{};
}

// Unique node name: "Lamp" -> "Lamp 2", "Lamp 2" -> "Lamp 3", the first that is free.
std::string fresh_name(const Scene& scene, const std::string& name) {
    const size_t digits = name.find_last_not_of("0123456789");
    const bool numbered = digits != name.npos && digits + 1 < name.size() && name[digits] == ' ';
    const std::string stem = numbered ? name.substr(0, digits) : name;
    std::unordered_set<std::string> taken;
    for (const auto& [id, node] : scene.nodes) taken.insert(node.name);
    for (int n = 2;; ++n)
        if (std::string candidate = fmt::format("{} {}", stem, n); !taken.contains(candidate)) return candidate;
}

// Duplicates use the duplicated joints if their skin's joints are in the subtree.
void copy_skins(Scene& scene, const IdMap<Node>& copies) {
    IdMap<Skin> skins;
    for (const auto& [original, copy] : copies) {
        Node node = *scene.nodes.find(copy);
        const Skin* skin = scene.skins.find(node.skin);
        if (!skin || std::ranges::none_of(skin->joints, [&](Id<Node> joint) { return copies.contains(joint); })) continue;
        if (!skins.contains(node.skin)) {
            Skin own = *skin;
            for (Id<Node>& joint : own.joints)
                if (copies.contains(joint)) joint = copies(joint);
            skins.set(node.skin, scene.skins.add(std::move(own)));
        }
        node.skin = skins(node.skin);
        scene.nodes.set(copy, std::move(node));
    }
}

void sort_channels(Clip& clip) {
    std::ranges::sort(clip.channels, {}, [](const Channel& c) { return std::pair(c.node, c.property); });
}

// Duplicates are animated like their originals.
void copy_channels(Scene& scene, const IdMap<Node>& copies) {
    const Table<Clip> clips = scene.clips;
    for (auto [id, clip] : clips) {
        const std::vector<Channel> before = clip.channels;
        for (const Channel& channel : before)
            if (copies.contains(channel.node)) clip.channels.push_back({copies(channel.node), channel.property, channel.keyframes});
        sort_channels(clip);
        scene.clips.set(id, std::move(clip));
    }
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
    copy_skins(scene, map);
    copy_channels(scene, map);
}

void remove_subtree(Scene& scene, Id<Node> root) {
    for (const Id<Node> id : subtree(scene, root)) scene.nodes.remove(id);
}

void merge(Scene& scene, const Scene& whole) {
    const Scene other = shown_scene(whole);
    const IdMap<Texture> textures = merge_table(scene.textures, other.textures, unchanged);
    const IdMap<Material> materials = merge_table(scene.materials, other.materials, [&](Material& m) {
        for (const TextureSlot& slot : texture_slots) (m.*slot.ref).texture = textures((m.*slot.ref).texture);
    });
    const IdMap<Mesh> meshes = merge_table(scene.meshes, other.meshes, [&](Mesh& mesh) {
        for (MeshPart& part : mesh.parts) {
            part.material = materials(part.material);
            part.by_variant.clear(); // keeps the current materials: variant indices differ between scenes
        }
    });
    const IdMap<Light> lights = merge_table(scene.lights, other.lights, unchanged);
    const IdMap<Camera> cameras = merge_table(scene.cameras, other.cameras, unchanged);
    const IdMap<Skin> skins = merge_table(scene.skins, other.skins, unchanged);
    const IdMap<Node> nodes = merge_table(scene.nodes, other.nodes, [&](Node& node) {
        node.mesh = meshes(node.mesh);
        node.skin = skins(node.skin);
        node.light = lights(node.light);
        node.camera = cameras(node.camera);
    });
    // A child may precede its parent in the table, so parents are set in a second pass.
    for (const auto& [old_id, old_node] : other.nodes) {
        Node node = *scene.nodes.find(nodes(old_id));
        node.parent = nodes(old_node.parent);
        scene.nodes.set(nodes(old_id), std::move(node));
    }
    for (const auto& [old_id, old_skin] : other.skins) {
        Skin skin = old_skin;
        for (Id<Node>& joint : skin.joints) joint = nodes(joint);
        scene.skins.set(skins(old_id), std::move(skin));
    }
    merge_table(scene.clips, other.clips, [&](Clip& clip) {
        for (Channel& channel : clip.channels) channel.node = nodes(channel.node);
        std::erase_if(clip.channels, [](const Channel& channel) { return !channel.node; });
        sort_channels(clip);
    });
}

} // namespace blush
