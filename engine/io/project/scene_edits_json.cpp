#include "io/project/scene_edits_json.h"

#include "io/gltf/read/uri.h"
#include "io/image/environment_image.h"
#include "io/image/ies.h"
#include "io/project/scene_json.h"
#include "scene/texture_slots.h"
#include "scene/validate.h"

#include <algorithm>

namespace blush {
namespace {

constexpr int edits_format_version = 1;

// --- differences -------------------------------------------------------------------------------------------------

// Of a mesh only the material assignments are stored.
Json mesh_materials(const Mesh& mesh) {
    Json materials = Json::array();
    for (const MeshPart& part : mesh.parts) materials.push_back(to_json(part.material));
    return materials;
}
// By part: the materials of its variants.
Json mesh_variants(const Mesh& mesh) {
    Json variants = Json::array();
    for (const MeshPart& part : mesh.parts) variants.push_back(to_json(part.by_variant));
    return variants;
}
Json changed_fields(const Mesh& before, const Mesh& now) {
    Json changed = Json::object();
    if (before.name != now.name) changed["name"] = now.name;
    if (mesh_materials(before) != mesh_materials(now)) changed["materials"] = mesh_materials(now);
    if (mesh_variants(before) != mesh_variants(now)) changed["variants"] = mesh_variants(now);
    return changed;
}

// The imported mesh with the same triangles, if any. An object that was made emissive has a copy with another material.
Id<Mesh> mesh_like(const Table<Mesh>& imported, const Mesh& mesh) {
    const auto same_triangles = [](const MeshPart& a, const MeshPart& b) { return a.geometry == b.geometry; };
    for (const auto& [id, candidate] : imported)
        if (std::ranges::equal(candidate.parts, mesh.parts, same_triangles)) return id;
    return {};
}

// The imported node with the same instance transforms, which are not stored either.
Id<Node> node_like(const Table<Node>& imported, const Node& node) {
    for (const auto& [id, candidate] : imported)
        if (candidate.instances == node.instances) return id;
    return {};
}

// True for a relative path without "..".
bool is_below_the_scene(const std::filesystem::path& file) {
    return !file.empty() && file.is_relative() && std::find(file.begin(), file.end(), "..") == file.end();
}

// `now` without content that JSON cannot store, so that the text can be read back: meshes and textures that the file lacks,
// references to them, an environment map without a file, an IES profile outside the scene's folder.
Scene without_payloads(const Scene& imported, Scene now, Json& left_out) {
    const Table<Mesh> meshes = now.meshes;
    for (const auto& [id, mesh] : meshes) {
        if (imported.meshes.contains(id) || mesh_like(imported.meshes, mesh)) continue;
        left_out.push_back(fmt::format("mesh \"{}\" was added: triangles are not kept as text", mesh.name));
        now.meshes.remove(id);
    }
    const Table<Texture> textures = now.textures;
    for (const auto& [id, texture] : textures) {
        const Texture* old_texture = imported.textures.find(id);
        if (old_texture && old_texture->image == texture.image) continue;
        left_out.push_back(fmt::format("texture \"{}\" has other pixels: pixels are not kept as text", texture.name));
        if (!old_texture) now.textures.remove(id);
    }
    for (const Id<Clip> id : Table<Clip>::changed(imported.clips, now.clips))
        if (const Clip* clip = now.clips.find(id))
            left_out.push_back(
                fmt::format("animation \"{}\" has other targets than in the file: keyframes are not kept as text", clip->name));
    if (!imported.clips.contains(now.scene_selection.clip)) now.scene_selection.clip = {};
    now.clips = imported.clips;
    now.skins = imported.skins;
    const Table<Node> nodes = now.nodes;
    for (auto [id, node] : nodes) {
        if (!now.meshes.contains(node.mesh)) node.mesh = {};
        if (node.instances && !node_like(imported.nodes, node)) {
            left_out.push_back(fmt::format("node \"{}\" has instances of its mesh: their transforms are not kept as text", node.name));
            node.instances = nullptr;
        }
        if (!now.skins.contains(node.skin)) node.skin = {};
        now.nodes.set(id, node);
    }
    const Table<Material> materials = now.materials;
    for (auto [id, material] : materials) {
        for (const TextureSlot& slot : texture_slots)
            if (TextureRef& ref = material.*slot.ref; ref.texture && !now.textures.contains(ref.texture)) ref = {};
        now.materials.set(id, material);
    }
    const Table<Light> lights = now.lights;
    for (auto [id, light] : lights) {
        const Light* old_light = imported.lights.find(id);
        if (!light.ies || is_below_the_scene(light.ies_file) || (old_light && old_light->ies == light.ies)) continue;
        left_out.push_back(fmt::format("light \"{}\" has an IES profile that is not a file in the scene's folder", light.name));
        light.ies = nullptr;
        light.ies_file.clear();
        now.lights.set(id, std::move(light));
    }
    const Environment& e = now.environment;
    if (e.kind == Environment::Kind::image && e.file.empty() && e.image != imported.environment.image) {
        left_out.push_back("the environment map has no file: pixels are not kept as text");
        now.environment = imported.environment;
    }
    return now;
}

template <class T> Json table_edits(const Table<T>& before, const Table<T>& now) {
    Json edits = Json::object();
    for (const Id<T> id : Table<T>::changed(before, now)) {
        const T* old_record = before.find(id);
        const T* record = now.find(id);
        if (!record) {
            edits["removed"].push_back(id.value);
        } else if (old_record) {
            const Json set = changed_fields(*old_record, *record);
            if (!set.empty()) edits["changed"].push_back({{"id", id.value}, {"name", record->name}, {"set", set}});
        } else if constexpr (std::same_as<T, Mesh>) {
            const Id<Mesh> like = mesh_like(before, *record);
            edits["added"].push_back({{"id", id.value}, {"like", like.value}, {"set", changed_fields(*before.find(like), *record)}});
        } else if constexpr (Fielded<T>) {
            Json added{{"id", id.value}, {"set", to_json(*record)}};
            if constexpr (std::same_as<T, Node>)
                if (record->instances) added["copies_like"] = node_like(before, *record).value;
            edits["added"].push_back(std::move(added));
        }
    }
    return edits;
}

// --- apply -----------------------------------------------------------------------------------------------------------

bool set_fields(const Json& json, Mesh& mesh) {
    size_t understood = 0;
    if (const auto it = json.find("name"); it != json.end() && read_json(*it, mesh.name)) ++understood;
    if (const auto it = json.find("materials"); it != json.end() && it->is_array() && it->size() == mesh.parts.size()) {
        bool read = true;
        for (size_t i = 0; i < mesh.parts.size(); ++i) read = read_json((*it)[i], mesh.parts[i].material) && read;
        if (read) ++understood;
    }
    if (const auto it = json.find("variants"); it != json.end() && it->is_array() && it->size() == mesh.parts.size()) {
        bool read = true;
        for (size_t i = 0; i < mesh.parts.size(); ++i) read = read_json((*it)[i], mesh.parts[i].by_variant) && read;
        if (read) ++understood;
    }
    return json.is_object() && understood == json.size();
}
template <Fielded T> bool set_fields(const Json& json, T& record) { return read_json(json, record); }

const Json& member(const Json& object, std::string_view key) {
    static const Json null;
    const auto it = object.find(key);
    return it == object.end() ? null : *it;
}

template <class T> Result<void> apply_changed(const Json& list, Table<T>& table, const std::string& where) {
    for (size_t i = 0; i < list.size(); ++i) {
        const std::string item_where = fmt::format("{}.changed[{}]", where, i);
        Id<T> id;
        const T* record = read_json(member(list[i], "id"), id) ? table.find(id) : nullptr;
        if (!record) return Error{"", "names a record that the scene does not have", item_where};
        T edited = *record;
        if (!set_fields(member(list[i], "set"), edited)) return Error{"", "an unknown field, or a value of the wrong type", item_where};
        table.set(id, std::move(edited));
    }
    return {};
}

template <Fielded T> bool read_added(const Json& item, const Table<T>&, T& record) {
    return !std::same_as<T, Texture> && set_fields(member(item, "set"), record);
}
bool read_added(const Json& item, const Table<Node>& imported, Node& node) {
    if (const Json& like = member(item, "copies_like"); !like.is_null()) {
        Id<Node> original;
        const Node* found = read_json(like, original) ? imported.find(original) : nullptr;
        if (!found) return false;
        node.instances = found->instances;
    }
    return set_fields(member(item, "set"), node);
}
bool read_added(const Json& item, const Table<Mesh>& imported, Mesh& mesh) {
    Id<Mesh> like;
    const Mesh* original = read_json(member(item, "like"), like) ? imported.find(like) : nullptr;
    if (original) mesh = *original;
    return original && set_fields(member(item, "set"), mesh);
}

template <class T> Result<void> apply_added(const Json& list, const Table<T>& imported, Table<T>& table, const std::string& where) {
    for (size_t i = 0; i < list.size(); ++i) {
        const std::string item_where = fmt::format("{}.added[{}]", where, i);
        Id<T> id;
        T record;
        if (!read_json(member(list[i], "id"), id) || !read_added(list[i], imported, record))
            return Error{"", "not a record that can be added", item_where};
        if (!table.insert(id, std::move(record))) return Error{"", "the id is already in use", item_where};
    }
    return {};
}

template <class T> Result<void> apply_removed(const Json& list, Table<T>& table, const std::string& where) {
    for (size_t i = 0; i < list.size(); ++i) {
        Id<T> id;
        if (!read_json(list[i], id) || !table.remove(id))
            return Error{"", "names a record that the scene does not have", fmt::format("{}.removed[{}]", where, i)};
    }
    return {};
}

template <class T> Result<void> apply_table(const Json& edits, Table<T>& table, const std::string& where) {
    if (!edits.is_null() && !edits.is_object()) return Error{"", "not an object", where};
    for (const char* key : {"removed", "added", "changed"})
        if (const Json& list = member(edits, key); !list.is_null() && !list.is_array()) return Error{"", "not a list", where + "." + key};
    const Table<T> imported = table;
    if (auto ok = apply_removed(member(edits, "removed"), table, where); !ok) return ok;
    if (auto ok = apply_added(member(edits, "added"), imported, table, where); !ok) return ok;
    return apply_changed(member(edits, "changed"), table, where);
}

Result<void> apply_environment(const Json& edits, Environment& environment, const std::filesystem::path& folder) {
    if (edits.is_null()) return {};
    const Environment before = environment;
    if (!read_json(edits, environment)) return Error{"", "an unknown field, or a value of the wrong type", "environment"};
    if (environment.kind != Environment::Kind::image || (environment.image && environment.file == before.file)) return {};
    const std::filesystem::path file(environment.file);
    Result<ImagePtr> image = read_environment_image(file.is_absolute() ? file : folder / file);
    if (!image) return image.error();
    environment.image = *std::move(image);
    return {};
}

// Reads the IES profiles of lights, in or below the scene's folder.
Result<void> read_named_profiles(const Table<Light>& before, Table<Light>& lights, const std::filesystem::path& folder) {
    const Table<Light> named = lights;
    for (auto [id, light] : named) {
        const Light* known = before.find(id);
        if (known && known->ies_file == light.ies_file) continue;
        light.ies = nullptr;
        if (!light.ies_file.empty()) {
            const std::string where = fmt::format("light \"{}\"", light.name);
            const Result<std::filesystem::path> file = resolve_uri(folder, light.ies_file);
            if (!file) return Error{light.ies_file, file.error().what, where};
            Result<IesPtr> profile = read_ies(*file);
            if (!profile) return profile.error();
            light.ies = *std::move(profile);
        }
        lights.set(id, std::move(light));
    }
    return {};
}

} // namespace

std::string edits_json(const Scene& imported, const Scene& edited) {
    Json json{{"format", edits_format_version}}, left_out = Json::array();
    const Scene now = without_payloads(imported, edited, left_out);
    const auto add = [&](const char* key, Json&& edits) {
        if (!edits.empty()) json[key] = std::move(edits);
    };
    add("nodes", table_edits(imported.nodes, now.nodes));
    add("meshes", table_edits(imported.meshes, now.meshes));
    add("materials", table_edits(imported.materials, now.materials));
    add("textures", table_edits(imported.textures, now.textures));
    add("lights", table_edits(imported.lights, now.lights));
    add("cameras", table_edits(imported.cameras, now.cameras));
    add("environment", changed_fields(imported.environment, now.environment));
    add("mix", changed_fields(imported.mix, now.mix));
    add("staging", changed_fields(imported.scene_selection, now.scene_selection));
    add("view", changed_fields(imported.view, now.view));
    add("left_out", std::move(left_out));
    return json_text(json);
}

size_t count_left_out(std::string_view text) {
    const Result<Json> json = parse_json_object(text);
    return json ? member(*json, "left_out").size() : 0;
}

Result<Scene> apply_edits_json(Scene scene, std::string_view text, const std::filesystem::path& folder) {
    const Result<Json> json = parse_json_object(text);
    if (!json) return json.error();
    int format = 0;
    if (!read_json(member(*json, "format"), format) || format != edits_format_version)
        return Error{"", fmt::format("edits of a format other than {}", edits_format_version), "format"};
    if (const auto ok = apply_table(member(*json, "nodes"), scene.nodes, "nodes"); !ok) return ok.error();
    if (const auto ok = apply_table(member(*json, "meshes"), scene.meshes, "meshes"); !ok) return ok.error();
    if (const auto ok = apply_table(member(*json, "materials"), scene.materials, "materials"); !ok) return ok.error();
    if (const auto ok = apply_table(member(*json, "textures"), scene.textures, "textures"); !ok) return ok.error();
    const Table<Light> lights_before = scene.lights;
    if (const auto ok = apply_table(member(*json, "lights"), scene.lights, "lights"); !ok) return ok.error();
    if (const auto ok = read_named_profiles(lights_before, scene.lights, folder); !ok) return ok.error();
    if (const auto ok = apply_table(member(*json, "cameras"), scene.cameras, "cameras"); !ok) return ok.error();
    if (const auto ok = apply_environment(member(*json, "environment"), scene.environment, folder); !ok) return ok.error();
    if (const Json& mix = member(*json, "mix"); !mix.is_null() && !read_json(mix, scene.mix))
        return Error{"", "an unknown field, or a value of the wrong type", "mix"};
    if (const Json& scene_selection = member(*json, "staging");
        !scene_selection.is_null() && !read_json(scene_selection, scene.scene_selection))
        return Error{"", "an unknown field, or a value of the wrong type", "staging"};
    if (const Json& view = member(*json, "view"); !view.is_null() && !read_json(view, scene.view))
        return Error{"", "an unknown field, or a value of the wrong type", "view"};
    if (const auto ok = validate(scene); !ok) return ok.error();
    return scene;
}

} // namespace blush
