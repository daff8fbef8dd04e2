#include "io/gltf/write/write.h"

#include "io/project/scene_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace blush {
namespace {

constexpr const char* visibility = "KHR_node_visibility";

// glTF requires a unit quaternion; a zero quaternion becomes the identity.
Quat normalized(const Quat& q) {
    const double size = std::sqrt(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w);
    if (std::abs(size - 1) <= 1e-6) return q;
    if (!(size > 0)) return {};
    return {float(q.x / size), float(q.y / size), float(q.z / size), float(q.w / size)};
}

void write_matrix(Json& object, const Affine& m) {
    for (const char* key : {"translation", "rotation", "scale"}) erase(object, key);
    set_vector(object, "matrix", {m.x.x, m.x.y, m.x.z, 0, m.y.x, m.y.y, m.y.z, 0, m.z.x, m.z.y, m.z.z, 0, m.t.x, m.t.y, m.t.z, 1}, {});
}

bool is_fallback_object(const Json& object) {
    return child_or_null(child_or_null(child_or_null(object, "extras"), "blush"), "fallback") == true;
}

// True for a node without any content, which validators and other programs may treat as an error.
bool is_bare(const Json& object) {
    return std::ranges::none_of(std::array{"children", "mesh", "camera", "extensions", "extras"},
                                [&](const char* key) { return object.contains(key); });
}

template <class T> int index_of(const std::map<Id<T>, int>& indices, Id<T> id) {
    const auto it = indices.find(id);
    return it == indices.end() ? -1 : it->second;
}

// Removes the nodes that have moved from the list `parent[key]` and appends the new ones. Light fallbacks stay with their node.
void write_children(GltfDocument& document, Json& parent, const char* key, const std::vector<int>& wanted) {
    const Json before = child_or_null(parent, key);
    const std::set<int> wanted_set(wanted.begin(), wanted.end());
    std::set<int> listed;
    Json now = Json::array();
    for (const Json& element : before) {
        const int index = element.get<int>();
        if (!wanted_set.contains(index) && !is_fallback_object(document.object("nodes", index))) continue;
        listed.insert(index);
        now.push_back(element);
    }
    for (const int index : wanted)
        if (!listed.contains(index)) now.push_back(index);
    if (now.empty())
        erase(parent, key);
    else if (now != before)
        parent[key] = std::move(now);
}

void write_light_reference(GltfDocument& document, Json& object, const Scene& scene, Id<Light> id) {
    const auto light = document.indices.lights.find(id);
    for (const auto list : light_lists) {
        const bool here = light != document.indices.lights.end() && light->second.list == list;
        if (here) {
            Json& extension = extension_of(object, list_name(list));
            set_index(extension, "light", light->second.index);
            if (list == GltfLight::List::measured)
                write_ies_instance(extension, *scene.lights.find(id), document.indices.profile_peaks.at(light->second.index));
            continue;
        }
        int now = -1;
        if (!read_json(child_or_null(child_or_null(child_or_null(object, "extensions"), list_name(list)), "light"), now)) continue;
        // Keeps lights of unsupported types.
        const bool shown = std::ranges::any_of(document.indices.lights, [&](const auto& e) { return e.second == GltfLight{list, now}; });
        if (shown || light != document.indices.lights.end()) erase_extension(object, list_name(list));
    }
}

// Writes the node's weights if they differ from those of the mesh.
void write_weights(GltfDocument& document, Json& object, const Node& node) {
    const auto same = [&](const Json& weights) {
        std::vector<float> now;
        return read_json(weights, now) && now == node.morph_weights;
    };
    const auto mesh = document.indices.meshes.find(node.mesh);
    const bool own = object.contains("weights");
    const Json& says = own || mesh == document.indices.meshes.end() ? child_or_null(object, "weights")
                                                                    : child_or_null(document.object("meshes", mesh->second), "weights");
    if (same(says) || (node.morph_weights.empty() && says.is_null())) return;
    erase(object, "weights");
    for (const float weight : node.morph_weights) object["weights"].push_back(json_number(weight));
}

void write_attachments(GltfDocument& document, Json& object, const Scene& scene, const Node& node) {
    set_index(object, "mesh", index_of(document.indices.meshes, node.mesh));
    if (!node.mesh) {
        erase(object, "skin");
        erase(object, "weights");
    } else {
        write_weights(document, object, node);
    }
    set_index(object, "camera", index_of(document.indices.cameras, node.camera));
    write_light_reference(document, object, scene, node.light);
}

} // namespace

void write_node(Json& object, const Node& node) {
    if (node.local.matrix) {
        write_matrix(object, *node.local.matrix);
    } else {
        erase(object, "matrix");
        const Transform& t = node.local;
        const Quat q = normalized(t.rotation);
        set_vector(object, "translation", {t.translation.x, t.translation.y, t.translation.z}, {0, 0, 0});
        set_vector(object, "rotation", {q.x, q.y, q.z, q.w}, {0, 0, 0, 1});
        set_vector(object, "scale", {t.scale.x, t.scale.y, t.scale.z}, {1, 1, 1});
    }
    const Json& now = child_or_null(child_or_null(object, "extensions"), visibility);
    if (node.visible ? child_or_null(now, "visible") == false : child_or_null(now, "visible") != false) {
        if (node.visible)
            erase_extension(object, visibility);
        else
            extension_of(object, visibility)["visible"] = false;
    }
}

void write_tree(GltfDocument& document, const Scene& scene) {
    // Detaches the remaining children of removed nodes.
    for (const auto& [id, index] : document.indices.nodes)
        if (!scene.nodes.contains(id)) write_children(document, document.object("nodes", index), "children", {});
    std::erase_if(document.indices.nodes, [&](const auto& entry) { return !scene.nodes.contains(entry.first); });
    for (const auto& [id, node] : scene.nodes)
        if (!document.indices.nodes.contains(id)) document.indices.nodes[id] = document.append("nodes", Json::object());
    std::map<Id<Node>, std::vector<int>> children;
    for (const auto& [id, node] : scene.nodes) children[node.parent].push_back(document.indices.nodes.at(id));
    for (const auto& [id, node] : scene.nodes) {
        Json& object = document.object("nodes", document.indices.nodes.at(id));
        const bool was_bare = is_bare(object) && !object.empty();
        write_children(document, object, "children", children[id]);
        write_attachments(document, object, scene, node);
        if (is_bare(object) && !was_bare) blush_of(object);
    }
    document.scene(); // creates the scene if missing
    Json& scenes = document.list("scenes");
    for (size_t s = 0; s < scenes.size(); ++s) {
        std::vector<int> roots;
        for (const auto& [id, node] : scene.nodes)
            if (!node.parent && (node.only_in_scenes.empty() || std::ranges::count(node.only_in_scenes, int32_t(s))))
                roots.push_back(document.indices.nodes.at(id));
        write_children(document, scenes[s], "nodes", roots);
    }
}

} // namespace blush
