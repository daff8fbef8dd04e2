#include "io/gltf/write/write_extras.h"

#include "io/gltf/read/cameras.h"
#include "io/gltf/read/context.h"
#include "io/gltf/read/convert.h"
#include "io/gltf/read/extras.h"
#include "io/gltf/read/scene_selection.h"
#include "io/gltf/read/source.h"
#include "io/project/settings_json.h"

#include <optional>
#include <set>
#include <utility>

namespace blush {
namespace {

void merge_into(Json& fields, const Json& more) {
    for (const auto& [name, value] : more.items()) {
        Json& field = fields[name];
        if (field.is_object() && value.is_object())
            merge_into(field, value);
        else
            field = value;
    }
}

void write_name(Json& object, const std::string& read, const std::string& wanted) {
    if (read != wanted && !wanted.empty()) object["name"] = wanted;
}

// Names are members of the glTF objects; an empty name is written to extras, since glTF treats it as absent.
template <Fielded T> void write_record_fields(Json& object, const T& read, const T& wanted) {
    write_name(object, read.name, wanted.name);
    Json fields = extra_fields(to_json(read), to_json(wanted));
    if (!wanted.name.empty()) erase(fields, "name");
    if (!fields.empty()) merge_into(child(blush_of(object), "fields"), fields);
}

template <class T, class Object> void write_table_fields(const Table<T>& read, const Table<T>& wanted, const Object& object_of) {
    for (const Id<T> id : Table<T>::changed(read, wanted)) {
        const T* before = read.find(id);
        const T* now = wanted.find(id);
        if (!before || !now) continue; // unused record
        if constexpr (Fielded<T>)
            write_record_fields(object_of(id), *before, *now);
        else
            write_name(object_of(id), before->name, now->name);
    }
}

// In the order in which the importer assigns ids.
struct Numbered {
    Json* object; // null: has no place for an id and needs none
    uint32_t id;
};
void write_ids_of(const std::vector<Numbered>& records) {
    uint32_t before = 0;
    for (const auto& [object, id] : records) {
        if (!object) {
            // Next id in the importer's sequence.
        } else if (id == before + 1)
            erase_blush(*object, "id");
        else if (const Json& now = child_or_null(child_or_null(child_or_null(*object, "extras"), "blush"), "id"); now != id)
            blush_of(*object)["id"] = id;
        before = id;
    }
}

template <class T> void write_ids_of(GltfDocument& document, std::string_view list, const std::map<Id<T>, int>& indices) {
    std::vector<Numbered> records;
    const Json* objects = document.find_list(list);
    if (!objects) return;
    const std::vector<Id<T>> ids = ids_by_index(indices, objects->size());
    for (size_t i = 0; i < ids.size(); ++i)
        if (ids[i]) records.push_back({&document.object(list, int(i)), ids[i].value});
    write_ids_of(records);
}

std::map<Id<Light>, int> lights_in(const GltfDocument& document, GltfLight::List list) {
    std::map<Id<Light>, int> indices;
    for (const auto& [id, light] : document.indices.lights)
        if (light.list == list) indices[id] = light.index;
    return indices;
}

// Parents before children, as in the importer.
std::vector<Numbered> nodes_in_order(GltfDocument& document) {
    std::vector<Numbered> records;
    const std::vector<Id<Node>> ids = ids_by_index(document.indices.nodes, document.list("nodes").size());
    std::vector<int> waiting;
    const auto push_all = [&](const Json& indices) {
        for (auto it = indices.rbegin(); it != indices.rend(); ++it) waiting.push_back(it->get<int>());
    };
    document.scene(); // creates the scene if missing
    const Json& scenes = document.list("scenes");
    for (auto scene = scenes.rbegin(); scene != scenes.rend(); ++scene) push_all(child_or_null(*scene, "nodes"));
    std::set<int> seen; // a root of several scenes is read at its first occurrence
    while (!waiting.empty()) {
        const int index = waiting.back();
        waiting.pop_back();
        Json& object = document.object("nodes", index);
        if (!ids[size_t(index)] || !seen.insert(index).second) continue;
        records.push_back({&object, ids[size_t(index)].value});
        push_all(child_or_null(object, "children"));
    }
    return records;
}

// Writes a member of the scene's extras.blush if it differs from the value read.
template <class T> void write_scene_member(Json& scene, const char* key, const T& read, const T& wanted, const Json& json) {
    if (!(read == wanted)) blush_of(scene)[key] = json;
}

} // namespace

Result<ImportedScene> read_back(const GltfDocument& document) {
    const Result<GltfSource> source = load_gltf_records(json_text(document.root));
    if (!source) return source.error();
    ImportedScene imported;
    const ImportOptions options;
    const GltfContext context{*source, options, imported.report, &document.indices};
    if (const auto ok = convert_gltf(context, imported); !ok) return ok.error();
    return imported;
}

void clear_extras(Json& object) {
    for (const char* key : {"fields", "angle_degrees", "radius", "rectangle", "aperture_radius", "focus_distance"})
        erase_blush(object, key);
}

void write_ids(GltfDocument& document) {
    write_ids_of(nodes_in_order(document));
    write_ids_of(document, "meshes", document.indices.meshes);
    write_ids_of(document, "materials", document.indices.materials);
    write_ids_of(document, "textures", document.indices.textures);
    write_ids_of(document, "cameras", document.indices.cameras);
    write_ids_of(document, "skins", document.indices.skins);
    write_ids_of(document, "animations", document.indices.clips);
    // The importer assigns ids of all light lists in one sequence.
    std::vector<Numbered> lights;
    for (const auto list : light_lists) {
        std::set<std::pair<int, Id<Light>>> by_index;
        for (const auto& [id, index] : lights_in(document, list)) by_index.emplace(index, id);
        int last = -1;
        for (const auto& [index, id] : by_index) {
            const bool first = std::exchange(last, index) != index;
            lights.push_back({first ? &document.object(list_name(list), index) : nullptr, id.value});
        }
    }
    write_ids_of(lights);
}

void write_extra_fields(GltfDocument& document, const Scene& read, const Scene& scene) {
    const GltfIndices& indices = document.indices;
    const auto in = [&](std::string_view list, const auto& places) {
        return [&document, list, &places](const auto& id) -> Json& { return document.object(list, places.at(id)); };
    };
    write_table_fields(read.nodes, scene.nodes, in("nodes", indices.nodes));
    write_table_fields(read.meshes, scene.meshes, in("meshes", indices.meshes));
    write_table_fields(read.materials, scene.materials, in("materials", indices.materials));
    write_table_fields(read.textures, scene.textures, in("textures", indices.textures));
    write_table_fields(read.cameras, scene.cameras, in("cameras", indices.cameras));
    write_table_fields(read.lights, scene.lights, [&](Id<Light> id) -> Json& {
        const GltfLight& light = indices.lights.at(id);
        return document.object(list_name(light.list), light.index);
    });
}

void write_scene_extras(GltfDocument& document, const ImportedScene& read, const Project& project, bool store_display) {
    Json& scene = document.scene();
    Environment environment = project.scene.environment;
    environment.image = read.scene.environment.image; // pixels are compared by file
    write_scene_member(scene, "environment", read.scene.environment, environment, to_json(environment));
    write_scene_member(scene, "staging", read.scene.scene_selection, project.scene.scene_selection,
                       scene_selection_json(project.scene, document.indices));
    write_scene_member(scene, "mix", read.scene.mix, project.scene.mix, to_json(project.scene.mix));
    // Without a saved view the importer computes one from the scene.
    Scene seen = read.scene;
    seen.meshes = project.scene.meshes;
    seen.clips = project.scene.clips;
    seen.skins = project.scene.skins;
    seen.scene_selection = project.scene.scene_selection;
    write_scene_member(scene, "view", read.has_view ? read.scene.view : initial_view(seen), project.scene.view,
                       to_json(project.scene.view));
    write_scene_member(scene, "render", read.render.value_or(RenderSettings{}), project.render,
                       Json::parse(render_settings_json(project.render)));
    const std::optional<ViewSettings> display_read = store_display ? read.view : read.view.value_or(ViewSettings{});
    write_scene_member(scene, "display", display_read, std::optional(project.view), Json::parse(view_settings_json(project.view)));
}

} // namespace blush
