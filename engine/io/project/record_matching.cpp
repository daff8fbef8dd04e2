#include "io/project/record_matching.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace blush {
namespace {

// Match key: name, and number of earlier records with that name.
template <class T, class NameOf> std::map<std::pair<std::string, int>, Id<T>> named(const Table<T>& table, const NameOf& name_of) {
    std::map<std::string, int> count;
    std::map<std::pair<std::string, int>, Id<T>> keys;
    for (const auto& [id, record] : table) {
        const std::string name = name_of(id, record);
        keys.emplace(std::pair(name, count[name]++), id);
    }
    return keys;
}

template <class T, class NameFrom, class NameTo>
IdMap<T> match(const Table<T>& from, const Table<T>& to, const NameFrom& name_from, const NameTo& name_to) {
    IdMap<T> map;
    const auto theirs = named(to, name_to);
    for (const auto& [key, id] : named(from, name_from))
        if (const auto it = theirs.find(key); it != theirs.end()) map.to.emplace(id.value, it->second.value);
    return map;
}

// Name of a record, or the path of the first node that uses it.
template <class T> auto name_or_user(const Scene& scene, Id<T> Node::*use) {
    std::map<Id<T>, std::string> users;
    for (const auto& [id, node] : scene.nodes)
        if (node.*use && !users.contains(node.*use)) users.emplace(node.*use, path_of(scene, id));
    return [users = std::move(users)](Id<T> id, const T& record) {
        if (!record.name.empty()) return record.name;
        const auto it = users.find(id);
        return it == users.end() ? std::string() : "\n" + it->second; // the line break separates paths from names
    };
}
template <class T> std::string plain_name(Id<T>, const T& record) { return record.name; }
std::string texture_name(Id<Texture>, const Texture& texture) { return texture.name + "\n" + texture.source; }

} // namespace

std::string path_of(const Scene& scene, Id<Node> node) {
    std::string path;
    // Limited by the table size, so that a cycle ends.
    for (size_t depth = 0; depth <= scene.nodes.size(); ++depth) {
        const Node* n = scene.nodes.find(node);
        if (!n) break;
        path = path.empty() ? n->name : n->name + "/" + path;
        node = n->parent;
    }
    return path;
}

RecordMap match_records(const Scene& from, const Scene& to) {
    RecordMap map;
    map.nodes = match(
        from.nodes, to.nodes, [&](Id<Node> id, const Node&) { return path_of(from, id); },
        [&](Id<Node> id, const Node&) { return path_of(to, id); });
    map.meshes = match(from.meshes, to.meshes, name_or_user(from, &Node::mesh), name_or_user(to, &Node::mesh));
    map.lights = match(from.lights, to.lights, name_or_user(from, &Node::light), name_or_user(to, &Node::light));
    map.cameras = match(from.cameras, to.cameras, name_or_user(from, &Node::camera), name_or_user(to, &Node::camera));
    map.materials = match(from.materials, to.materials, plain_name<Material>, plain_name<Material>);
    map.textures = match(from.textures, to.textures, texture_name, texture_name);
    map.skins = match(from.skins, to.skins, plain_name<Skin>, plain_name<Skin>);
    map.clips = match(from.clips, to.clips, plain_name<Clip>, plain_name<Clip>);
    return map;
}

} // namespace blush
