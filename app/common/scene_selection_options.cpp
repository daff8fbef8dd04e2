#include "app/common/scene_selection_options.h"

#include "core/text.h"
#include "scene/document/scene_selection.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace blush {
namespace {

Result<size_t> find_named(const char* kind, const std::vector<std::string>& names, const std::string& wanted) {
    if (const auto found = std::ranges::find(names, wanted); found != names.end()) return size_t(found - names.begin());
    size_t index = 0;
    if (parse_number(wanted, index) && index < names.size()) return index;
    std::string known;
    for (const std::string& name : names) known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", name);
    return Error{.what =
                     fmt::format("there is no {} \"{}\" ({})", kind, wanted, known.empty() ? "the file has none" : "there are " + known)};
}

Result<Id<Clip>> find_clip(const Scene& scene, const std::string& wanted) {
    std::vector<std::string> names;
    std::vector<Id<Clip>> ids;
    for (const auto& [id, clip] : scene.clips) {
        names.push_back(clip.name);
        ids.push_back(id);
    }
    const Result<size_t> index = find_named("animation", names, wanted);
    if (index) return ids[*index];
    if (wanted == "none") return Id<Clip>{};
    return index.error();
}

// A file with a single scene has no list of names, but index 0 is valid.
Result<size_t> find_scene(const Scene& scene, const std::string& wanted) {
    if (scene.scene_names.empty() && wanted == "0") return size_t(0);
    return find_named("scene", scene.scene_names, wanted);
}

} // namespace

Result<SceneSelection> find_scene_selection(const SceneSelectionOptions& choice, const Scene& scene) {
    SceneSelection scene_selection = scene.scene_selection;
    if (!choice.animation.empty()) {
        const Result<Id<Clip>> clip = find_clip(scene, choice.animation);
        if (!clip) return clip.error();
        scene_selection.clip = *clip;
        scene_selection.seconds = 0;
    }
    if (choice.seconds && !scene_selection.clip) return Error{.what = "--animation-time needs --animation"};
    if (choice.seconds) scene_selection.seconds = *choice.seconds;
    if (!choice.scene.empty()) {
        const Result<size_t> index = find_scene(scene, choice.scene);
        if (!index) return index.error();
        scene_selection.scene = int32_t(*index);
    }
    if (!choice.variant.empty()) {
        const Result<size_t> index = find_named("variant of materials", scene.variants, choice.variant);
        if (!index && choice.variant != "none") return index.error();
        scene_selection.variant = index ? int32_t(*index) : -1;
    }
    if (const Result<void> valid = check_scene_selection(scene, scene_selection); !valid) return valid.error();
    return scene_selection;
}

void add_scene_selection_options(CLI::App& app, SceneSelectionOptions& choice) {
    app.add_option("--animation", choice.animation, "Animation clip [none: rest pose]")->type_name("NAME|INDEX|none");
    app.add_option("--animation-time", choice.seconds, "Time of the animation in seconds [0]")->type_name("S");
    app.add_option("--scene", choice.scene, "Scene of the file [its default]")->type_name("NAME|INDEX");
    app.add_option("--material-variant", choice.variant, "Material variant [none]")->type_name("NAME|INDEX|none");
}

} // namespace blush
