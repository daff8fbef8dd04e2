#include "io/project/merge_edits.h"

#include "io/project/record_matching.h"
#include "io/project/scene_json.h"
#include "scene/texture_slots.h"
#include "scene/validate.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

// ---- maps ids of mine and base to ids of theirs

Material mapped(Material m, const RecordMap& map) {
    for (const TextureSlot& slot : texture_slots) (m.*slot.ref).texture = map.textures((m.*slot.ref).texture);
    return m;
}
Light mapped(Light light, const RecordMap& map) {
    for (ObjectSet* set : {&light.lit_objects, &light.shadow_casters}) {
        std::vector<Id<Node>> nodes;
        for (const Id<Node> id : set->nodes)
            if (const Id<Node> there = map.nodes(id)) nodes.push_back(there);
        std::ranges::sort(nodes);
        set->nodes = std::move(nodes);
    }
    return light;
}
Node mapped(Node node, const RecordMap& map) {
    node.parent = map.nodes(node.parent);
    node.mesh = map.meshes(node.mesh);
    node.light = map.lights(node.light);
    node.camera = map.cameras(node.camera);
    node.skin = map.skins(node.skin);
    return node;
}
Mesh mapped(Mesh mesh, const RecordMap& map) {
    for (MeshPart& part : mesh.parts) {
        part.material = map.materials(part.material);
        for (Id<Material>& id : part.by_variant) id = map.materials(id);
    }
    return mesh;
}
Skin mapped(Skin skin, const RecordMap& map) {
    for (Id<Node>& joint : skin.joints) joint = map.nodes(joint);
    return skin;
}
Clip mapped(Clip clip, const RecordMap& map) {
    for (Channel& channel : clip.channels) channel.node = map.nodes(channel.node);
    std::erase_if(clip.channels, [](const Channel& channel) { return !channel.node; });
    return clip;
}
Texture mapped(Texture texture, const RecordMap&) { return texture; }
Camera mapped(Camera camera, const RecordMap&) { return camera; }

// ---- merge of one record

class Merge {
public:
    explicit Merge(MergedEdits& out) : out_(out) {}

    void conflict(std::string sentence) { out_.conflicts.push_back(std::move(sentence)); }

    // Merges the named fields, then payloads behind pointers.
    template <Fielded T> void fields(const T& base, const T& mine, T& theirs, const std::string& what) {
        const Json b = to_json(base), m = to_json(mine), t = to_json(theirs);
        Json set = Json::object();
        for (const auto& [name, value] : m.items()) {
            if (b.at(name) == value) continue;
            set[name] = value;
            if (t.at(name) != b.at(name) && t.at(name) != value)
                conflict(fmt::format("{}: \"{}\" changed here and in the file; yours is kept", what, name));
        }
        read_json(set, theirs);
    }
    // Merges a value that is not a field. The caller passes `changed_in_file`, since reloaded payloads are different objects.
    template <class T>
    void value(const T& base, const T& mine, T& theirs, bool changed_in_file, const std::string& what, const char* name) {
        if (mine == base) return;
        if (changed_in_file) conflict(fmt::format("{}: {} changed here and in the file; yours is kept", what, name));
        theirs = mine;
    }

    void record(const Material& base, const Material& mine, Material& theirs, const std::string& what) { fields(base, mine, theirs, what); }
    void record(const Camera& base, const Camera& mine, Camera& theirs, const std::string& what) { fields(base, mine, theirs, what); }
    void record(const Texture& base, const Texture& mine, Texture& theirs, const std::string& what) {
        fields(base, mine, theirs, what);
        value(base.image, mine.image, theirs.image, false, what, "its pixels");
    }
    void record(const Light& base, const Light& mine, Light& theirs, const std::string& what) {
        const bool other_file = theirs.ies_file != base.ies_file;
        fields(base, mine, theirs, what);
        value(base.ies, mine.ies, theirs.ies, other_file, what, "its IES profile");
    }
    void record(const Node& base, const Node& mine, Node& theirs, const std::string& what) {
        fields(base, mine, theirs, what);
        const bool same = base.instances == theirs.instances ||
                          (base.instances && theirs.instances && base.instances->node_from_copy == theirs.instances->node_from_copy);
        value(base.instances, mine.instances, theirs.instances, !same, what, "its copies");
    }
    void record(const Mesh& base, const Mesh& mine, Mesh& theirs, const std::string& what) {
        if (mine.parts.size() != theirs.parts.size() || base.parts.size() != mine.parts.size())
            return conflict(what + " has different parts in the file; the file's materials are used");
        value(base.name, mine.name, theirs.name, theirs.name != base.name && theirs.name != mine.name, what, "the name");
        for (size_t i = 0; i < mine.parts.size(); ++i) {
            const std::string part = mine.parts.size() == 1 ? what : fmt::format("{}, part {}", what, i + 1);
            MeshPart& in_file = theirs.parts[i];
            const auto merge = [&](const auto& b, const auto& m, auto& t, const char* name) {
                value(b, m, t, t != b && t != m, part, name);
            };
            merge(base.parts[i].material, mine.parts[i].material, in_file.material, "the material");
            merge(base.parts[i].by_variant, mine.parts[i].by_variant, in_file.by_variant, "the materials of variants");
        }
    }
    // Edits replace these as a whole.
    template <class Whole> void record(const Whole& base, const Whole& mine, Whole& theirs, const std::string& what) {
        value(base, mine, theirs, theirs != base && theirs != mine, what, "it");
    }

private:
    MergedEdits& out_;
};

// ---- merge of tables

template <class T> std::string called(const char* kind, const Scene& scene, Id<T> id, const T& record) {
    if constexpr (std::same_as<T, Node>)
        return fmt::format("{} \"{}\"", kind, path_of(scene, id));
    else
        return fmt::format("{} \"{}\"", kind, record.name);
}

// Assigns ids in theirs to records added in mine (the same id if free), so that other records can refer to them.
template <class T> void reserve_added(const Table<T>& base, const Table<T>& mine, Table<T>& theirs, IdMap<T>& map) {
    for (const auto& [id, record] : mine) {
        if (base.contains(id)) continue;
        map.to[id.value] = theirs.insert(id, record) ? id.value : theirs.add(record).value;
    }
}

template <class T> void merge_table(Merge& merge, const char* kind, const Scene& base_scene, Table<T> Scene::*table,
                                    const Scene& mine_scene, const Scene& file, Scene& merged, const RecordMap& map, const IdMap<T>& ids) {
    const Table<T>&base = base_scene.*table, &mine = mine_scene.*table;
    for (const Id<T> id : Table<T>::changed(base, mine)) {
        const T *before = base.find(id), *now = mine.find(id);
        const Id<T> there = ids(id);
        const T* in_file = (file.*table).find(there);
        if (!before) {
            (merged.*table).set(there, mapped(*now, map));
            continue;
        }
        const std::string what = called(kind, base_scene, id, *before);
        if (!in_file) {
            if (now) merge.conflict(what + " was removed from the file; its edits are lost");
            continue;
        }
        if (!now) {
            (merged.*table).remove(there);
            continue;
        }
        T record = *in_file;
        merge.record(mapped(*before, map), mapped(*now, map), record, what);
        (merged.*table).set(there, std::move(record));
    }
}

// Sets references to removed records to none; removes nodes whose parent was removed.
void drop_dangling(Scene& scene) {
    for (bool again = true; std::exchange(again, false);) {
        const Table<Node> nodes = scene.nodes;
        for (const auto& [id, node] : nodes)
            if (node.parent && !scene.nodes.contains(node.parent)) again |= scene.nodes.remove(id);
    }
    const auto keep = [](auto& id, const auto& table) {
        if (id && !table.contains(id)) id = {};
    };
    for (auto [id, node] : Table<Node>(scene.nodes)) {
        keep(node.mesh, scene.meshes);
        keep(node.light, scene.lights);
        keep(node.camera, scene.cameras);
        keep(node.skin, scene.skins);
        if (!node.mesh) node.instances = nullptr;
        scene.nodes.set(id, std::move(node));
    }
    for (auto [id, mesh] : Table<Mesh>(scene.meshes)) {
        for (MeshPart& part : mesh.parts) {
            keep(part.material, scene.materials);
            for (Id<Material>& variant : part.by_variant) keep(variant, scene.materials);
        }
        scene.meshes.set(id, std::move(mesh));
    }
    for (auto [id, material] : Table<Material>(scene.materials)) {
        for (const TextureSlot& slot : texture_slots)
            if (TextureRef& ref = material.*slot.ref; ref.texture && !scene.textures.contains(ref.texture)) ref = {};
        scene.materials.set(id, std::move(material));
    }
    for (auto [id, light] : Table<Light>(scene.lights)) {
        for (ObjectSet* set : {&light.lit_objects, &light.shadow_casters})
            std::erase_if(set->nodes, [&](Id<Node> node) { return !scene.nodes.contains(node); });
        scene.lights.set(id, std::move(light));
    }
}

} // namespace

MergedEdits merge_edits(const Scene& base, const Scene& mine, const Scene& theirs) {
    MergedEdits out{theirs, {}};
    Merge merge(out);
    RecordMap map = match_records(base, theirs);
    Scene& scene = out.scene;
    reserve_added(base.nodes, mine.nodes, scene.nodes, map.nodes);
    reserve_added(base.meshes, mine.meshes, scene.meshes, map.meshes);
    reserve_added(base.materials, mine.materials, scene.materials, map.materials);
    reserve_added(base.textures, mine.textures, scene.textures, map.textures);
    reserve_added(base.lights, mine.lights, scene.lights, map.lights);
    reserve_added(base.cameras, mine.cameras, scene.cameras, map.cameras);
    reserve_added(base.skins, mine.skins, scene.skins, map.skins);
    reserve_added(base.clips, mine.clips, scene.clips, map.clips);

    merge_table(merge, "object", base, &Scene::nodes, mine, theirs, scene, map, map.nodes);
    merge_table(merge, "mesh", base, &Scene::meshes, mine, theirs, scene, map, map.meshes);
    merge_table(merge, "material", base, &Scene::materials, mine, theirs, scene, map, map.materials);
    merge_table(merge, "texture", base, &Scene::textures, mine, theirs, scene, map, map.textures);
    merge_table(merge, "light", base, &Scene::lights, mine, theirs, scene, map, map.lights);
    merge_table(merge, "camera", base, &Scene::cameras, mine, theirs, scene, map, map.cameras);
    merge_table(merge, "skin", base, &Scene::skins, mine, theirs, scene, map, map.skins);
    merge_table(merge, "animation", base, &Scene::clips, mine, theirs, scene, map, map.clips);

    merge.fields(base.environment, mine.environment, scene.environment, "environment");
    merge.value(base.environment.image, mine.environment.image, scene.environment.image, false, "environment", "the image");
    merge.fields(base.mix, mine.mix, scene.mix, "light mix");
    scene.view = mine.view;
    SceneSelection scene_selection = mine.scene_selection;
    scene_selection.clip = map.clips(scene_selection.clip);
    if (!scene_selection.clip) scene_selection.seconds = 0;
    if (scene_selection.scene >= int32_t(std::max<size_t>(theirs.scene_names.size(), 1)))
        scene_selection.scene = theirs.scene_selection.scene;
    if (scene_selection.variant >= int32_t(theirs.variants.size())) scene_selection.variant = -1;
    scene.scene_selection = scene_selection;

    drop_dangling(scene);
    if (const auto valid = validate(scene); !valid) {
        out.conflicts.push_back("the edits cannot be applied to the file any more (" + valid.error().text() +
                                "); the file is shown without them");
        out.scene = theirs;
    }
    return out;
}

Scene without_lighting_missing_in(const Scene& theirs, const Scene& saved) {
    Scene base = saved;
    const RecordMap map = match_records(saved, theirs);
    for (const auto& [id, light] : saved.lights)
        if (!map.lights(id)) base.lights.remove(id);
    for (const auto& [id, node] : saved.nodes) {
        if (!node.light || map.lights(node.light)) continue;
        if (map.nodes(id)) {
            Node bare = node;
            bare.light = {};
            base.nodes.set(id, bare);
        }
        // A light needs its parents.
        const Node* n = &node;
        for (Id<Node> up = id; n && !map.nodes(up) && base.nodes.remove(up); n = saved.nodes.find(up)) up = n->parent;
    }
    if (saved.environment != Environment{}) base.environment = theirs.environment;
    if (saved.mix != LightMix{}) base.mix = theirs.mix;
    return base;
}

} // namespace blush
