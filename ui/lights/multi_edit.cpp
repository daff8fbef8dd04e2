#include "ui/lights/multi_edit.h"

#include "scene/document/subtree_edits.h"
#include "scene/node_name.h"
#include "scene/reference_check.h"

#include <algorithm>

namespace blush {
namespace {

template <class T> void take_over(T Light::*field, Light& light, const Light& before, const Light& after) {
    if (before.*field != after.*field) light.*field = after.*field;
}

} // namespace

std::vector<Id<Node>> subtree_roots(const Scene& scene, std::span<const Id<Node>> nodes) {
    std::vector<Id<Node>> found;
    for (const Id<Node> id : nodes) {
        const auto above = [&](Id<Node> other) { return other != id && is_below(scene, id, other); };
        if (std::ranges::none_of(nodes, above)) found.push_back(id);
    }
    return found;
}

std::vector<Id<Light>> lights_of(const Scene& scene, std::span<const Id<Node>> nodes) {
    std::vector<Id<Light>> lights;
    for (const Id<Node> root : nodes)
        for (const Id<Node> id : subtree(scene, root)) {
            const Id<Light> light = scene.nodes.find(id)->light;
            if (scene.lights.contains(light) && !std::ranges::count(lights, light)) lights.push_back(light);
        }
    return lights;
}

Light apply_same_edit(const Light& other, const Light& before, const Light& after) {
    Light light = other;
    if (before.intensity != after.intensity)
        light.intensity = before.intensity > 0 ? other.intensity * (after.intensity / before.intensity) : after.intensity;
    const auto take = [&](auto... fields) { (take_over(fields, light, before, after), ...); };
    take(&Light::color, &Light::use_temperature, &Light::kelvin, &Light::green_tint, &Light::keep_power, &Light::visible_to_camera,
         &Light::enabled, &Light::solo, &Light::group, &Light::lit_objects, &Light::shadow_casters);
    if (other.kind != before.kind) return light;
    take(&Light::kind, &Light::unit, &Light::radius, &Light::angle_radians, &Light::inner_cone_radians, &Light::outer_cone_radians,
         &Light::width, &Light::height, &Light::two_sided, &Light::spread_radians, &Light::ies, &Light::ies_file);
    light.inner_cone_radians = std::min(light.inner_cone_radians, light.outer_cone_radians);
    return light;
}

std::vector<Edit> change_lights(const Scene& scene, std::span<const Id<Light>> lights, const std::function<void(Light&)>& change) {
    std::vector<Edit> edits;
    for (const Id<Light> id : lights) {
        const Light* light = scene.lights.find(id);
        if (!light) continue;
        Light changed = *light;
        change(changed);
        if (changed != *light) edits.push_back(SetLight{id, std::move(changed)});
    }
    return edits;
}

std::vector<std::string> differing_fields(const Scene& scene, std::span<const Id<Light>> lights) {
    std::vector<std::string> fields;
    const auto look_at = [&](const char* name, auto field) {
        const auto differs = [&](Id<Light> id) { return scene.lights.find(id)->*field != scene.lights.find(lights[0])->*field; };
        if (std::ranges::any_of(lights, differs)) fields.push_back(name);
    };
    look_at("type", &Light::kind);
    look_at("being on", &Light::enabled);
    look_at("intensity", &Light::intensity);
    look_at("colour", &Light::color);
    look_at("temperature", &Light::kelvin);
    look_at("radius", &Light::radius);
    look_at("angle", &Light::angle_radians);
    look_at("cone", &Light::outer_cone_radians);
    look_at("width", &Light::width);
    look_at("height", &Light::height);
    look_at("group", &Light::group);
    return fields;
}

std::string label_for(const std::string& what, const Scene& scene, std::span<const Id<Light>> lights, std::span<const Id<Node>> nodes) {
    if (lights.size() != 1) return what + " " + std::to_string(lights.size()) + " lights";
    for (const Id<Node> root : nodes)
        for (const Id<Node> id : subtree(scene, root))
            if (const Node& node = *scene.nodes.find(id); node.light == lights[0]) return what + " light " + node_name(scene, id, node);
    for (const auto& [id, node] : scene.nodes)
        if (node.light == lights[0]) return what + " light " + node_name(scene, id, node);
    return what + " light";
}

} // namespace blush
