#include "app/common/scene_overrides.h"

#include "app/common/assets_dir.h"
#include "core/text.h"
#include "io/image/environment_image.h"
#include "scene/animation/pose.h"
#include "scene/document/scene_selection.h"
#include "scene/validate.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace blush {
namespace {

// Removes a suffix ",NAME=number" of `text`; true if it was there.
Result<bool> take_suffix(std::string_view& text, std::string_view name, float& number) {
    const size_t comma = text.rfind(',');
    if (comma == text.npos) return false;
    const std::string_view last = text.substr(comma + 1);
    if (!last.starts_with(name) || last.size() == name.size() || last[name.size()] != '=') return false;
    const std::string_view value = last.substr(name.size() + 1);
    if (!parse_number(value, number) || !std::isfinite(number))
        return Error{.what = fmt::format("{} must be a number, not \"{}\"", name, value)};
    text = text.substr(0, comma);
    return true;
}

Result<Vec3> parse_color(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    Vec3 c{0, 0, 0};
    const bool good = parts.size() == 3 && parse_number(parts[0], c.x) && parse_number(parts[1], c.y) && parse_number(parts[2], c.z);
    if (!good) return Error{.what = fmt::format("a constant environment needs three numbers R,G,B, not \"{}\"", text)};
    return c;
}

std::vector<Id<Node>> camera_nodes(const Scene& scene) {
    std::vector<Id<Node>> ids;
    for (const auto& [id, node] : scene.nodes)
        if (node.camera && is_in_chosen_scene(scene, id)) ids.push_back(id);
    return ids;
}

std::string name_of_camera(const Scene& scene, Id<Node> id) {
    const Node& node = *scene.nodes.find(id);
    const Camera* camera = scene.cameras.find(node.camera);
    return node.name.empty() && camera ? camera->name : node.name;
}

bool is_called(const Scene& scene, Id<Node> id, const std::string& name) {
    const Node& node = *scene.nodes.find(id);
    const Camera* camera = scene.cameras.find(node.camera);
    return node.name == name || (camera && camera->name == name);
}

// A name has priority over an index, because a camera may be named "2".
Result<Id<Node>> find_camera(const Scene& scene, const std::string& wanted) {
    const std::vector<Id<Node>> ids = camera_nodes(scene);
    for (const Id<Node> id : ids)
        if (is_called(scene, id, wanted)) return id;
    size_t index = 0;
    if (parse_number(wanted, index) && index < ids.size()) return ids[index];
    if (ids.empty()) return Error{.what = fmt::format("there is no camera \"{}\": the scene has none", wanted)};
    std::string names;
    for (const Id<Node> id : ids) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name_of_camera(scene, id));
    return Error{.what = fmt::format("there is no camera \"{}\" (there are {})", wanted, names)};
}

Result<Environment> make_environment(const EnvironmentChoice& choice) {
    Environment environment;
    environment.kind = choice.kind;
    environment.color = choice.color;
    environment.intensity = choice.intensity;
    environment.rotation_degrees = choice.rotation_degrees;
    if (choice.kind == Environment::Kind::image) {
        Result<ImagePtr> image = read_environment_image(choice.file);
        if (!image) return image.error();
        environment.file = choice.file.string();
        environment.image = *std::move(image);
    }
    if (Result<void> valid = validate(environment); !valid) return valid.error();
    return environment;
}

Result<void> light_up(std::optional<LightRig> light, Scene& scene, std::vector<Diagnostic>* warnings) {
    const auto warn = [&](std::string what) {
        if (warnings) warnings->push_back({Diagnostic::Severity::warning, std::move(what), ""});
    };
    const bool asked = light && *light != LightRig::none;
    if (has_light(scene)) {
        if (asked) warn(fmt::format("--light {} is ignored: the scene has its own lights", to_string(*light)));
        return {};
    }
    if (!light) warn("no light in this file: the image is black (use --light studio or --light sky)");
    if (!asked) return {};
    Result<Scene> lit = with_light_rig(scene, *light, studio_map());
    if (!lit) return lit.error();
    scene = *std::move(lit);
    return {};
}

// The camera node that has the view's pose; null id: a free view.
Id<Node> light_camera(const Scene& scene) {
    for (const Id<Node> id : camera_nodes(scene)) {
        View seen = view_through(scene, id);
        seen.lens = scene.view.lens;
        if (seen == scene.view) return id;
    }
    return {};
}

} // namespace

Environment studio_map() {
    Environment map;
    const std::filesystem::path file = assets_dir() / "environments" / "studio.hdr";
    if (Result<ImagePtr> image = read_environment_image(file)) {
        map.kind = Environment::Kind::image;
        map.file = file.string();
        map.image = *std::move(image);
    }
    return map;
}

Result<EnvironmentChoice> parse_environment(std::string_view text) {
    EnvironmentChoice choice;
    for (bool more = true; more;) {
        more = false;
        const std::pair<std::string_view, float*> suffixes[] = {{"intensity", &choice.intensity}, {"rotate", &choice.rotation_degrees}};
        for (const auto& [name, number] : suffixes) {
            const Result<bool> taken = take_suffix(text, name, *number);
            if (!taken) return taken.error();
            more = more || *taken;
        }
    }
    constexpr std::string_view constant = "constant=";
    if (text.empty()) return Error{.what = "an environment must be FILE, none or constant=R,G,B"};
    if (text == "none") return choice;
    if (text.starts_with(constant)) {
        const Result<Vec3> color = parse_color(text.substr(constant.size()));
        if (!color) return color.error();
        choice.kind = Environment::Kind::constant;
        choice.color = *color;
    } else {
        choice.kind = Environment::Kind::image;
        choice.file = std::filesystem::path(text);
    }
    return choice;
}

Result<std::optional<LightMix::Grouping>> parse_grouping(std::string_view text) {
    using Grouping = LightMix::Grouping;
    constexpr std::pair<std::string_view, Grouping> known[] = {{"off", Grouping::none},
                                                               {"by-light", Grouping::by_light},
                                                               {"by-object", Grouping::by_object},
                                                               {"by-material", Grouping::by_material},
                                                               {"by-hand", Grouping::by_hand}};
    for (const auto& [word, grouping] : known)
        if (text == word) return std::optional(grouping);
    return Error{.what = fmt::format("must be off, by-light, by-object, by-material or by-hand, not \"{}\"", text)};
}

Result<std::optional<LightRig>> parse_light(std::string_view text) {
    const Result<LightRig> rig = parse_light_rig(text);
    if (!rig) return rig.error();
    return std::optional(*rig);
}

Result<void> apply_overrides(const SceneOverrides& overrides, Scene& scene, float aspect, bool has_view,
                             std::vector<Diagnostic>* warnings) {
    const Result<SceneSelection> scene_selection = find_scene_selection(overrides.scene_selection, scene);
    if (!scene_selection) return scene_selection.error();
    const bool other_scene = scene_selection->scene != scene.scene_selection.scene;
    scene = with_scene_selection(scene, *scene_selection);
    const std::vector<Id<Node>> cameras = camera_nodes(scene);
    if (!overrides.camera.empty()) {
        const Result<Id<Node>> camera = find_camera(scene, overrides.camera);
        if (!camera) return camera.error();
        scene.view = view_through(scene, *camera);
    } else if (other_scene && !cameras.empty()) {
        scene.view = view_through(scene, cameras.front());
    } else if ((other_scene || !has_view) && cameras.empty()) {
        scene.view = framed(scene.view, world_bounds(scene), aspect);
    }
    if (overrides.aperture) scene.view.lens.aperture_radius = *overrides.aperture;
    if (overrides.focus) scene.view.lens.focus_distance = *overrides.focus;
    if (overrides.environment) {
        Result<Environment> environment = make_environment(*overrides.environment);
        if (!environment) return environment.error();
        scene.environment = *std::move(environment);
    }
    if (const Result<void> lit = light_up(overrides.light, scene, warnings); !lit) return lit.error();
    if (overrides.groups) scene.mix.grouping = *overrides.groups;
    return validate(scene.view.lens);
}

float aspect_of_camera(const std::map<Id<Camera>, float>& aspects, const Scene& scene) {
    if (aspects.empty()) return 0;
    const Id<Node> node = light_camera(scene);
    const auto found = node ? aspects.find(scene.nodes.find(node)->camera) : aspects.end();
    return found == aspects.end() ? 0 : found->second;
}

std::string camera_name(const Scene& scene) {
    const Id<Node> node = light_camera(scene);
    return node ? name_of_camera(scene, node) : std::string();
}

} // namespace blush
