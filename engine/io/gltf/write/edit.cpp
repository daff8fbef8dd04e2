#include "io/gltf/write/edit.h"

#include "io/gltf/read/geometry/instancing.h"
#include "io/gltf/read/lights/image_based_light.h"
#include "io/gltf/write/edit_lights.h"
#include "io/gltf/write/prune.h"
#include "io/gltf/write/write.h"
#include "io/gltf/write/write_animations.h"
#include "io/gltf/write/write_extras.h"
#include "io/gltf/write/write_fallbacks.h"
#include "io/gltf/write/write_payloads.h"

#include <algorithm>
#include <set>

namespace blush {
namespace {

// Names of all extensions used in the document. Recursion is safe: the import limits nesting.
void find_extensions(const Json& value, std::set<std::string>& names) {
    for (auto it = value.begin(); it != value.end(); ++it) {
        if (!it->is_structured()) continue;
        const bool member = value.is_object();
        if (member && it.key() == "extras") continue;
        if (member && it.key() == "extensions" && it->is_object())
            for (const auto& [name, extension] : it->items()) names.insert(name);
        find_extensions(*it, names);
    }
}
std::set<std::string> extensions_in(const Json& root) {
    std::set<std::string> names;
    find_extensions(root, names);
    return names;
}

// Declares newly used extensions and removes declarations of extensions that are no longer used. Declarations that were unused
// before are kept.
void declare_extensions(Json& root, const std::set<std::string>& before) {
    const std::set<std::string> now = extensions_in(root);
    const auto gone = [&](const Json& name) {
        return name.is_string() && before.contains(name.get<std::string>()) && !now.contains(name.get<std::string>());
    };
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const auto list = root.find(key);
        if (list == root.end() || !list->is_array()) continue;
        Json left = Json::array();
        for (const Json& name : *list)
            if (!gone(name)) left.push_back(name);
        *list = std::move(left);
        if (list->empty()) root.erase(list);
    }
    for (const std::string& name : now) {
        Json& used = root["extensionsUsed"];
        if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
    }
}

template <class T> bool changed(const Table<T>& before, Id<T> id, const T& now) {
    const T* old = before.find(id);
    return !old || !(*old == now);
}

void write_cameras(GltfDocument& document, const Scene& read, const Scene& scene, const UsedRecords& used) {
    for (const auto& [id, camera] : scene.cameras) {
        const bool known = document.indices.cameras.contains(id);
        if (known ? !changed(read.cameras, id, camera) : !used.cameras.contains(id)) continue;
        if (!known) document.indices.cameras[id] = document.append("cameras", Json{{"name", camera.name}});
        Json& object = document.object("cameras", document.indices.cameras.at(id));
        clear_extras(object);
        write_camera(object, camera);
    }
}

void write_surfaces(GltfDocument& document, const Scene& read, const Scene& scene) {
    for (const auto& [id, index] : document.indices.textures) {
        Texture texture = *scene.textures.find(id);
        texture.image = nullptr;
        if (!changed(read.textures, id, texture)) continue;
        Json& object = document.object("textures", index);
        clear_extras(object);
        write_sampler(document, object, texture);
    }
    for (const auto& [id, index] : document.indices.materials) {
        const Material& material = *scene.materials.find(id);
        if (!changed(read.materials, id, material)) continue;
        Json& object = document.object("materials", index);
        clear_extras(object);
        write_material(document, object, material);
    }
}

void write_nodes(GltfDocument& document, const Scene& read, const Scene& scene) {
    for (const auto& [id, index] : document.indices.nodes) {
        Node node = *scene.nodes.find(id);
        node.instances = nullptr; // write_copies
        if (!changed(read.nodes, id, node)) continue;
        Json& object = document.object("nodes", index);
        clear_extras(object);
        write_node(object, node);
    }
}

// Writes instance transforms that the document lacks or has different.
void write_copies(GltfDocument& document, const GltfOrigin& has, const Scene& scene) {
    for (const auto& [id, index] : document.indices.nodes) {
        const Node* old = has.nodes.find(id);
        write_instances(document, document.object("nodes", index), old ? old->instances : nullptr, scene.nodes.find(id)->instances);
    }
}

template <class T, class Index> Table<T> kept(Table<T> table, const std::map<Id<T>, Index>& indices) {
    const Table<T> all = table;
    for (const auto& [id, record] : all)
        if (!indices.contains(id)) table.remove(id);
    return table;
}

// The scene that an import of the document gives, with the triangles and pixels of `scene`.
Scene as_saved(Scene scene, const GltfIndices& indices, const Scene& read) {
    scene.meshes = kept(scene.meshes, indices.meshes);
    scene.materials = kept(scene.materials, indices.materials);
    scene.textures = kept(scene.textures, indices.textures);
    scene.lights = kept(scene.lights, indices.lights);
    scene.cameras = kept(scene.cameras, indices.cameras);
    scene.skins = kept(scene.skins, indices.skins);
    scene.clips = kept(scene.clips, indices.clips);
    if (!scene.clips.contains(scene.scene_selection.clip)) scene.scene_selection.clip = {}, scene.scene_selection.seconds = 0;
    for (const auto& [id, texture] : read.textures)
        if (const Texture* now = scene.textures.find(id)) {
            Texture named = *now;
            named.source = texture.source;
            scene.textures.set(id, std::move(named));
        }
    // Sets dangling ids to none.
    const Table<Node> nodes = scene.nodes;
    for (auto [id, node] : nodes) {
        if (!scene.meshes.contains(node.mesh)) node.mesh = {};
        if (!scene.lights.contains(node.light)) node.light = {};
        if (!scene.cameras.contains(node.camera)) node.camera = {};
        if (!node.mesh || !scene.skins.contains(node.skin)) node.skin = {};
        if (!node.mesh) node.morph_weights.clear();
        scene.nodes.set(id, std::move(node));
    }
    const auto is_gone = [&](Id<Node> id) { return !scene.nodes.contains(id); };
    const Table<Light> lights = scene.lights;
    for (auto [id, light] : lights) {
        std::erase_if(light.lit_objects.nodes, is_gone);
        std::erase_if(light.shadow_casters.nodes, is_gone);
        scene.lights.set(id, std::move(light));
    }
    const Table<Skin> skins = scene.skins;
    for (auto [id, skin] : skins) {
        for (Id<Node>& joint : skin.joints)
            if (is_gone(joint)) joint = {};
        scene.skins.set(id, std::move(skin));
    }
    const Table<Clip> clips = scene.clips;
    for (auto [id, clip] : clips) {
        std::erase_if(clip.channels, [&](const Channel& channel) { return is_gone(channel.node); });
        scene.clips.set(id, std::move(clip));
    }
    return scene;
}

// Reports records that would be read back differently: only possible if an unknown extension changes them.
template <class T> void report_differences(const char* what, const Table<T>& read, const Table<T>& wanted, std::vector<Diagnostic>& found) {
    for (const Id<T> id : Table<T>::changed(read, wanted)) {
        const T* record = wanted.find(id);
        found.push_back({Diagnostic::Severity::warning,
                         fmt::format("{} \"{}\" will be read back differently", what, record ? record->name : std::to_string(id.value)),
                         ""});
    }
}

void report_differences(const Scene& read, Scene wanted, std::vector<Diagnostic>& found) {
    // Read back without triangles, pixels, instance transforms and IES profiles.
    for (const auto& [id, node] : Table<Node>(wanted.nodes)) {
        Node flat = node;
        flat.instances = nullptr;
        wanted.nodes.set(id, std::move(flat));
    }
    for (const auto& [id, texture] : Table<Texture>(wanted.textures)) {
        Texture flat = texture;
        flat.image = nullptr;
        wanted.textures.set(id, std::move(flat));
    }
    for (const auto& [id, light] : Table<Light>(wanted.lights)) {
        Light flat = light;
        flat.ies = nullptr;
        wanted.lights.set(id, std::move(flat));
    }
    for (const auto& [id, mesh] : Table<Mesh>(wanted.meshes)) {
        Mesh flat = mesh;
        for (MeshPart& part : flat.parts) part.geometry = nullptr;
        wanted.meshes.set(id, std::move(flat));
    }
    report_differences("node", read.nodes, wanted.nodes, found);
    report_differences("mesh", read.meshes, wanted.meshes, found);
    report_differences("material", read.materials, wanted.materials, found);
    report_differences("texture", read.textures, wanted.textures, found);
    report_differences("light", read.lights, wanted.lights, found);
    report_differences("camera", read.cameras, wanted.cameras, found);
}

} // namespace

Result<EditedGltf> edited_gltf(const GltfOrigin& origin, const Project& project, bool store_display) {
    const Scene& scene = project.scene;
    EditedGltf edited;
    GltfDocument& document = edited.document;
    document.root = Json::parse(*origin.json);
    document.indices = origin.indices;
    const GltfObjects used_before = used_objects(document);
    const auto counts_before = count_objects(document);
    const std::set<std::string> extensions_before = extensions_in(document.root);
    const Result<ImportedScene> before = read_back(document);
    if (!before) return before.error();

    const UsedRecords used = used_records(scene);
    if (const auto ok = write_payloads(document, origin, scene, used); !ok) return ok.error();
    write_lights(document, before->scene, scene, used, edited.diagnostics);
    write_image_light(document, before->scene.environment, scene.environment);
    write_cameras(document, before->scene, scene, used);
    write_surfaces(document, before->scene, scene);
    write_tree(document, scene);
    write_copies(document, origin, scene);
    write_skins(document, scene);
    write_nodes(document, before->scene, scene);
    write_animations(document, scene);
    write_fallbacks(document, scene);
    if (const int unused = prune_unused(document, used_before, counts_before))
        edited.diagnostics.push_back(
            {Diagnostic::Severity::note,
             fmt::format("{} unused objects stay in the file: it has unknown extensions that may refer to them", unused), ""});
    // Unused meshes are not imported, even if they had to stay in the document.
    std::erase_if(document.indices.meshes, [&](const auto& entry) { return !used.meshes.contains(entry.first); });
    write_ids(document);
    const Result<ImportedScene> plain = read_back(document);
    if (!plain) return plain.error();
    edited.scene = as_saved(scene, document.indices, plain->scene);
    write_extra_fields(document, plain->scene, edited.scene);
    write_scene_extras(document, *plain, project, store_display);
    declare_extensions(document.root, extensions_before);
    const Result<ImportedScene> after = read_back(document);
    if (!after) return after.error();
    report_differences(after->scene, edited.scene, edited.diagnostics);
    return edited;
}

} // namespace blush
