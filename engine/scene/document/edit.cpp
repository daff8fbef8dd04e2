#include "scene/document/edit.h"

#include "scene/document/scene_selection.h"
#include "scene/document/subtree_edits.h"
#include "scene/reference_check.h"
#include "scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace blush {
namespace {

template <class T> Error missing(std::string_view kind, Id<T> id) {
    return Error{.what = fmt::format("there is no {} {}", kind, id.value)};
}

template <class T> Result<void> set_record(Table<T>& table, Id<T> id, const T& value, std::string_view kind) {
    if (!table.contains(id)) return missing(kind, id);
    if (Result<void> valid = validate(value); !valid) return valid;
    table.set(id, value);
    return {};
}

// One overload per edit; the caller discards `p` after an error.

Result<void> apply_to(Project& p, const SetNode& e) {
    if (auto known = check_references(p.scene, e.node); !known) return known;
    if (is_below(p.scene, e.node.parent, e.id))
        return Error{.what = "a node cannot be its own ancestor", .where = fmt::format("node \"{}\"", e.node.name)};
    return set_record(p.scene.nodes, e.id, e.node, "node");
}

Result<void> apply_to(Project& p, const SetMaterial& e) {
    if (auto known = check_references(p.scene, e.material); !known) return known;
    return set_record(p.scene.materials, e.id, e.material, "material");
}

Result<void> apply_to(Project& p, const SetLight& e) { return set_record(p.scene.lights, e.id, e.light, "light"); }
Result<void> apply_to(Project& p, const SetCamera& e) { return set_record(p.scene.cameras, e.id, e.camera, "camera"); }
Result<void> apply_to(Project& p, const SetTexture& e) { return set_record(p.scene.textures, e.id, e.texture, "texture"); }

Result<void> apply_to(Project& p, const AssignMaterial& e) {
    const Mesh* mesh = p.scene.meshes.find(e.mesh);
    if (!mesh) return missing("mesh", e.mesh);
    if (e.part < 0 || size_t(e.part) >= mesh->parts.size())
        return Error{.what = fmt::format("there is no part {}", e.part), .where = fmt::format("mesh \"{}\"", mesh->name)};
    Mesh changed = *mesh;
    assign_material(p.scene, changed.parts[size_t(e.part)], e.material);
    if (auto known = check_references(p.scene, changed); !known) return known;
    p.scene.meshes.set(e.mesh, std::move(changed));
    return {};
}

Result<void> apply_to(Project& p, const MakeEmissive& e) {
    const Node* record = p.scene.nodes.find(e.node);
    if (!record) return missing("node", e.node);
    const Mesh* shape = p.scene.meshes.find(record->mesh);
    if (!shape) return Error{.what = "the node has no mesh to make emissive", .where = fmt::format("node \"{}\"", record->name)};
    Node node = *record;
    Mesh mesh = *shape;
    std::map<Id<Material>, Id<Material>> copies;
    for (MeshPart& part : mesh.parts) {
        const auto [copy, is_new] = copies.try_emplace(part.material);
        if (is_new) {
            const Material* old_material = p.scene.materials.find(part.material);
            Material material = old_material ? *old_material : Material{};
            material.name = node.name.empty() ? material.name : node.name;
            material.emissive = {1, 1, 1};
            material.emissive_strength = e.nits;
            if (auto valid = validate(material); !valid) return valid;
            copy->second = p.scene.materials.add(std::move(material));
        }
        assign_material(p.scene, part, copy->second);
    }
    const bool is_shared = std::ranges::count_if(p.scene.nodes, [&](const auto& n) { return n.value.mesh == node.mesh; }) > 1;
    if (!is_shared) {
        p.scene.meshes.set(node.mesh, std::move(mesh));
        return {};
    }
    node.mesh = p.scene.meshes.add(std::move(mesh));
    p.scene.nodes.set(e.node, std::move(node));
    return {};
}

template <class T> Result<void> replace(T& target, const T& value) {
    if (Result<void> valid = validate(value); !valid) return valid;
    target = value;
    return {};
}

Result<void> apply_to(Project& p, const SetEnvironment& e) { return replace(p.scene.environment, e.environment); }
Result<void> apply_to(Project& p, const SetMix& e) { return replace(p.scene.mix, e.mix); }
Result<void> apply_to(Project& p, const BakeMix& e) { return replace(p.scene, e.scene); }
Result<void> apply_to(Project& p, const SetLens& e) { return replace(p.scene.view.lens, e.lens); }
Result<void> apply_to(Project& p, const SetSceneSelection& e) {
    if (auto valid = check_scene_selection(p.scene, e.scene_selection); !valid) return valid;
    p.scene = with_scene_selection(p.scene, e.scene_selection);
    return {};
}
Result<void> apply_to(Project& p, const SetRender& e) { return replace(p.render, e.settings); }
Result<void> apply_to(Project& p, const SetView& e) { return replace(p.view, e.settings); }

Result<void> apply_to(Project& p, const AddLight& e) {
    if (auto valid = validate(e.light); !valid) return valid;
    if (auto valid = validate(e.node); !valid) return valid;
    Node node = e.node;
    node.light = p.scene.lights.add(e.light);
    if (auto known = check_references(p.scene, node); !known) return known;
    p.scene.nodes.add(std::move(node));
    return {};
}

Result<void> apply_to(Project& p, const DuplicateNode& e) {
    if (!p.scene.nodes.contains(e.id)) return missing("node", e.id);
    duplicate_subtree(p.scene, e.id);
    return {};
}

Result<void> apply_to(Project& p, const RemoveNode& e) {
    if (!p.scene.nodes.contains(e.id)) return missing("node", e.id);
    remove_subtree(p.scene, e.id);
    return {};
}

Result<void> apply_to(Project& p, const Import& e) {
    if (auto valid = validate(e.scene); !valid) return valid;
    merge(p.scene, e.scene);
    return {};
}

Result<void> apply_to(Project& p, const LookThrough& e) {
    const Node* node = p.scene.nodes.find(e.camera_node);
    if (!node) return missing("node", e.camera_node);
    if (!p.scene.cameras.contains(node->camera))
        return Error{.what = "the node has no camera", .where = fmt::format("node \"{}\"", node->name)};
    p.scene.view = view_through(p.scene, e.camera_node);
    return {};
}

Result<void> apply_to(Project& p, const Restore& e) {
    if (auto valid = validate(e.project.scene); !valid) return valid;
    if (auto valid = validate(e.project.render); !valid) return valid;
    if (auto valid = validate(e.project.view); !valid) return valid;
    p = e.project;
    return {};
}

template <class T> std::string name_of(const Table<T>& table, Id<T> id) {
    const T* record = table.find(id);
    return record ? record->name : std::string();
}

struct Labeller {
    const Project& p;

    std::string with_name(std::string text, const std::string& name) const { return name.empty() ? text : text + " " + name; }

    std::string operator()(const SetNode& e) const { return with_name("Change object", e.node.name); }
    std::string operator()(const SetMaterial& e) const { return with_name("Change material", e.material.name); }
    std::string operator()(const SetLight& e) const { return with_name("Change light", e.light.name); }
    std::string operator()(const SetCamera& e) const { return with_name("Change camera", e.camera.name); }
    std::string operator()(const SetTexture& e) const { return with_name("Change texture", e.texture.name); }
    std::string operator()(const AssignMaterial& e) const { return with_name("Assign material", name_of(p.scene.materials, e.material)); }
    std::string operator()(const MakeEmissive& e) const { return with_name("Make a light of", name_of(p.scene.nodes, e.node)); }
    std::string operator()(const SetEnvironment&) const { return "Change environment"; }
    std::string operator()(const SetMix&) const { return "Change light mix"; }
    std::string operator()(const BakeMix&) const { return "Bake light mix"; }
    std::string operator()(const SetLens&) const { return "Change lens"; }
    std::string operator()(const SetSceneSelection& e) const { return scene_selection_label(p.scene, e.scene_selection); }
    std::string operator()(const SetRender&) const { return "Change render settings"; }
    std::string operator()(const SetView&) const { return "Change display settings"; }
    std::string operator()(const AddLight& e) const { return with_name("Add light", e.node.name.empty() ? e.light.name : e.node.name); }
    std::string operator()(const DuplicateNode& e) const { return with_name("Duplicate", name_of(p.scene.nodes, e.id)); }
    std::string operator()(const RemoveNode& e) const { return with_name("Delete", name_of(p.scene.nodes, e.id)); }
    std::string operator()(const Import& e) const { return with_name("Import", e.name); }
    std::string operator()(const Restore& e) const { return with_name("Restore", e.name); }
    std::string operator()(const LookThrough& e) const { return with_name("Look through", name_of(p.scene.nodes, e.camera_node)); }
};

} // namespace

std::string label(const Edit& edit, const Project& project) { return std::visit(Labeller{project}, edit); }

Result<Project> apply(const Project& project, const Edit& edit) {
    Project next = project;
    const Result<void> applied = std::visit([&](const auto& e) { return apply_to(next, e); }, edit);
    if (!applied) return applied.error();
    return next;
}

} // namespace blush
