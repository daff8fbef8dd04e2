#include "io/gltf/read/scene_selection.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/nodes.h"
#include "scene/document/scene_selection.h"

namespace blush {

void import_scene_names(const GltfContext& context, Scene& scene) {
    const auto& scenes = context.model().scenes;
    const auto shown = default_scene(context);
    if (scenes.size() < 2 || !shown) return;
    for (size_t i = 0; i < scenes.size(); ++i) {
        scene.scene_names.push_back(scenes[i].name.empty() ? fmt::format("Scene {}", i) : scenes[i].name);
        if (i != *shown && scenes[i].extensions.contains("EXT_lights_image_based"))
            context.warn("ignored: the environment of a scene that is not the file's default one", fmt::format("scenes[{}]", i));
    }
    scene.scene_selection.scene = int32_t(*shown);
}

void import_scene_selection(const GltfContext& context, size_t gltf_scene, const GltfIndices& indices, Scene& scene) {
    const std::string where = fmt::format("scenes[{}].extras.blush.staging", gltf_scene);
    const Json json = blush_fields(context, gltf_item(context.json(), "scenes", gltf_scene), "staging", where);
    if (json.is_null()) return;
    SceneSelection scene_selection{.scene = scene.scene_selection.scene};
    size_t animation = 0, understood = 0;
    for (const auto& [key, value] : json.items()) {
        if (key == "animation" && read_json(value, animation)) {
            const auto clips = ids_by_index(indices.clips, context.model().animations.size());
            scene_selection.clip = animation < clips.size() ? clips[animation] : Id<Clip>{};
            understood += bool(scene_selection.clip);
        } else {
            understood += (key == "seconds" && read_json(value, scene_selection.seconds)) ||
                          (key == "scene" && read_json(value, scene_selection.scene)) ||
                          (key == "variant" && read_json(value, scene_selection.variant));
        }
    }
    const auto valid = check_scene_selection(scene, scene_selection);
    if (understood < json.size() || !valid)
        context.warn("ignored: " + (valid ? "not a choice that the file offers" : valid.error().what), where);
    if (valid) scene = with_scene_selection(scene, scene_selection);
}

Json scene_selection_json(const Scene& scene, const GltfIndices& indices) {
    const SceneSelection& scene_selection = scene.scene_selection;
    Json json = Json::object();
    if (const auto clip = indices.clips.find(scene_selection.clip); clip != indices.clips.end())
        json = {{"animation", clip->second}, {"seconds", scene_selection.seconds}};
    if (!scene.scene_names.empty()) json["scene"] = scene_selection.scene;
    if (scene_selection.variant >= 0) json["variant"] = scene_selection.variant;
    return json;
}

} // namespace blush
