#include "io/project/scene_records_json.h"

#include "io/project/record_matching.h"
#include "io/project/scene_json.h"

namespace blush {
namespace {

// --- write

template <Fielded T> Json record_json(const T& record) { return {{"set", changed_fields(T{}, record)}}; }
Json record_json(const Mesh& mesh) {
    Json materials = Json::array(), variants = Json::array();
    for (const MeshPart& part : mesh.parts) {
        materials.push_back(to_json(part.material));
        variants.push_back(to_json(part.by_variant));
    }
    return {{"name", mesh.name}, {"materials", materials}, {"variants", variants}, {"targets", mesh.target_names}};
}
// The contents of these cannot be edited, only the choice.
Json record_json(const Skin& skin) { return {{"name", skin.name}}; }
Json record_json(const Clip& clip) { return {{"name", clip.name}}; }

template <class T> Json table_json(const Table<T>& table) {
    Json list = Json::array();
    for (const auto& [id, record] : table) {
        Json json = record_json(record);
        json["id"] = id.value;
        list.push_back(std::move(json));
    }
    return list;
}

// --- read

template <class T> bool read_member(const Json& object, const char* key, T& value) {
    const auto it = object.find(key);
    return it != object.end() && read_json(*it, value);
}

template <Fielded T> bool read_record(const Json& json, T& record) { return read_member(json, "set", record); }
bool read_record(const Json& json, Mesh& mesh) {
    std::vector<Id<Material>> materials;
    std::vector<std::vector<Id<Material>>> variants;
    if (!read_member(json, "name", mesh.name) || !read_member(json, "materials", materials) || !read_member(json, "variants", variants) ||
        !read_member(json, "targets", mesh.target_names) || materials.size() != variants.size())
        return false;
    for (size_t i = 0; i < materials.size(); ++i) mesh.parts.push_back({{}, materials[i], std::move(variants[i])});
    return true;
}
bool read_record(const Json& json, Skin& skin) { return read_member(json, "name", skin.name); }
bool read_record(const Json& json, Clip& clip) { return read_member(json, "name", clip.name); }

template <class T> bool read_table(const Json& object, const char* key, Table<T>& table) {
    const auto list = object.find(key);
    if (list == object.end() || !list->is_array()) return false;
    for (const Json& item : *list) {
        Id<T> id;
        T record;
        if (!item.is_object() || !read_member(item, "id", id) || !read_record(item, record) || !table.insert(id, std::move(record)))
            return false;
    }
    return true;
}

// --- payloads, taken from the current file

void take_payloads(Scene& scene, const Scene& file) {
    const RecordMap there = match_records(scene, file);
    for (auto [id, mesh] : Table<Mesh>(scene.meshes)) {
        const Mesh* now = file.meshes.find(there.meshes(id));
        if (!now || now->parts.size() != mesh.parts.size()) continue;
        for (size_t i = 0; i < mesh.parts.size(); ++i) mesh.parts[i].geometry = now->parts[i].geometry;
        scene.meshes.set(id, std::move(mesh));
    }
    for (auto [id, texture] : Table<Texture>(scene.textures)) {
        const Texture* now = file.textures.find(there.textures(id));
        if (!now) continue;
        texture.image = now->image;
        scene.textures.set(id, std::move(texture));
    }
    for (auto [id, node] : Table<Node>(scene.nodes)) {
        const Node* now = file.nodes.find(there.nodes(id));
        if (!now || !now->instances) continue;
        node.instances = now->instances;
        scene.nodes.set(id, std::move(node));
    }
    for (auto [id, light] : Table<Light>(scene.lights)) {
        const Light* now = file.lights.find(there.lights(id));
        if (!now || now->ies_file != light.ies_file) continue;
        light.ies = now->ies;
        scene.lights.set(id, std::move(light));
    }
    Environment& e = scene.environment;
    if (e.kind != Environment::Kind::image) return;
    e.image = file.environment.image;
    // Placeholder pixels: validation requires an environment map to have some. They are never shown, since edits do not change
    // them.
    if (!e.image) e.image = std::make_shared<const Image>(Image{.width = 1, .height = 1, .channels = 3, .bytes = {}, .floats = {0, 0, 0}});
}

} // namespace

std::string records_json(const Scene& scene) {
    return json_text({{"nodes", table_json(scene.nodes)},
                      {"meshes", table_json(scene.meshes)},
                      {"materials", table_json(scene.materials)},
                      {"textures", table_json(scene.textures)},
                      {"lights", table_json(scene.lights)},
                      {"cameras", table_json(scene.cameras)},
                      {"skins", table_json(scene.skins)},
                      {"clips", table_json(scene.clips)},
                      {"scene_names", scene.scene_names},
                      {"variants", scene.variants},
                      {"staging", to_json(scene.scene_selection)},
                      {"environment", to_json(scene.environment)},
                      {"mix", to_json(scene.mix)},
                      {"view", to_json(scene.view)}});
}

Result<Scene> scene_of_records(std::string_view text, const Scene& file) {
    const Result<Json> json = parse_json_object(text);
    if (!json) return json.error();
    Scene scene;
    const bool whole = read_table(*json, "nodes", scene.nodes) && read_table(*json, "meshes", scene.meshes) &&
                       read_table(*json, "materials", scene.materials) && read_table(*json, "textures", scene.textures) &&
                       read_table(*json, "lights", scene.lights) && read_table(*json, "cameras", scene.cameras) &&
                       read_table(*json, "skins", scene.skins) && read_table(*json, "clips", scene.clips) &&
                       read_member(*json, "scene_names", scene.scene_names) && read_member(*json, "variants", scene.variants) &&
                       read_member(*json, "staging", scene.scene_selection) && read_member(*json, "environment", scene.environment) &&
                       read_member(*json, "mix", scene.mix) && read_member(*json, "view", scene.view);
    if (!whole) return Error{"", "not the records of a scene, or a duplicate id", ""};
    take_payloads(scene, file);
    return scene;
}

} // namespace blush
