#include "scene/document/scene_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Index into by_variant of the part's material for a variant.
size_t slot_of(const MeshPart& part, int32_t variant) {
    const size_t slot = size_t(variant + 1);
    return slot < part.by_variant.size() && part.by_variant[slot] ? slot : 0;
}

void apply_variant(Scene& scene) {
    const Table<Mesh> meshes = scene.meshes;
    for (const auto& [id, mesh] : meshes) {
        if (std::ranges::all_of(mesh.parts, [](const MeshPart& part) { return part.by_variant.empty(); })) continue;
        Mesh dressed = mesh;
        for (MeshPart& part : dressed.parts)
            if (!part.by_variant.empty()) part.material = part.by_variant[slot_of(part, scene.scene_selection.variant)];
        scene.meshes.set(id, std::move(dressed));
    }
}

// The camera node that the view looks through; none if the view was navigated away.
Id<Node> current_camera(const Scene& scene) {
    for (const auto& [id, node] : scene.nodes) {
        if (!node.camera) continue;
        const View eye = view_of_camera(scene, id);
        if (eye.position == scene.view.position && eye.rotation == scene.view.rotation) return id;
    }
    return {};
}

} // namespace

Result<void> check_scene_selection(const Scene& scene, const SceneSelection& s) {
    const auto number = [](size_t count) { return int32_t(std::min<size_t>(count, INT32_MAX)); };
    if (s.clip && !scene.clips.contains(s.clip)) return Error{.what = fmt::format("there is no animation {}", s.clip.value)};
    if (!std::isfinite(s.seconds) || s.seconds < 0) return Error{.what = fmt::format("a time must be a number from 0, not {}", s.seconds)};
    if (s.scene < 0 || s.scene >= std::max(1, number(scene.scene_names.size())))
        return Error{.what = fmt::format("there is no scene {}", s.scene)};
    if (s.variant < -1 || s.variant >= number(scene.variants.size()))
        return Error{.what = fmt::format("there is no variant {}", s.variant)};
    return {};
}

Scene with_scene_selection(const Scene& scene, const SceneSelection& scene_selection) {
    Scene next = scene;
    next.scene_selection = scene_selection;
    if (!scene_selection.clip) next.scene_selection.seconds = 0;
    if (scene_selection.variant != scene.scene_selection.variant) apply_variant(next);
    if (scene_selection.clip == scene.scene_selection.clip && scene_selection.seconds == scene.scene_selection.seconds) return next;
    if (const Id<Node> camera = current_camera(scene)) {
        const View eye = view_of_camera(next, camera);
        next.view.position = eye.position;
        next.view.rotation = eye.rotation;
    }
    return next;
}

std::string scene_selection_label(const Scene& scene, const SceneSelection& scene_selection) {
    const auto name = [](const std::vector<std::string>& names, int32_t i) {
        return i >= 0 && size_t(i) < names.size() ? names[size_t(i)] : "none";
    };
    const SceneSelection& now = scene.scene_selection;
    if (scene_selection.variant != now.variant) return "Choose variant " + name(scene.variants, scene_selection.variant);
    if (scene_selection.scene != now.scene) return "Choose scene " + name(scene.scene_names, scene_selection.scene);
    const Clip* clip = scene.clips.find(scene_selection.clip);
    if (scene_selection.clip != now.clip) return clip ? "Choose animation " + clip->name : "Choose no animation";
    return "Change time";
}

void assign_material(const Scene& scene, MeshPart& part, Id<Material> material) {
    part.material = material;
    if (part.by_variant.empty()) return;
    part.by_variant[slot_of(part, scene.scene_selection.variant)] = material;
    part.material = part.by_variant[slot_of(part, scene.scene_selection.variant)]; // the default if the variant has no material
}

} // namespace blush
