#include "io/gltf/read/lights/lights.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/ids.h"
#include "io/gltf/read/object.h"
#include "io/gltf/read/uri.h"
#include "io/image/environment_image.h"
#include "io/image/ies.h"

#include <fmt/format.h>
#include <numbers>
#include <optional>
#include <utility>

namespace blush {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float radians_per_degree = pi / 180;
constexpr float min_side = 1e-6f; // metres: a rectangle without area cannot emit

void read_cone(const GltfContext& context, const tinygltf::SpotLight& spot, Light& light, const std::string& where) {
    light.outer_cone_radians = checked(context, spot.outerConeAngle, light.outer_cone_radians, 0, pi / 2, where + ".spot.outerConeAngle");
    light.inner_cone_radians = checked(context, spot.innerConeAngle, 0, 0, pi / 2, where + ".spot.innerConeAngle");
    if (light.inner_cone_radians <= light.outer_cone_radians) return;
    context.warn(fmt::format("the inner cone, {:.4g} rad, is wider than the outer one, {:.4g} rad: both end at the outer one",
                             light.inner_cone_radians, light.outer_cone_radians),
                 where + ".spot");
    light.inner_cone_radians = light.outer_cone_radians;
}

void read_legacy_extras(const GltfObject& blush, Light& light) {
    light.angle_radians = blush.number("angle_degrees", 0, 0, 180) * radians_per_degree;
    light.radius = blush.number("radius", 0, 0, any_float);
    if (const GltfObject rectangle = blush.object("rectangle")) {
        light.kind = Light::Kind::rectangle;
        light.width = rectangle.number("width", 1, min_side, any_float);
        light.height = rectangle.number("height", 1, min_side, any_float);
        light.two_sided = rectangle.boolean("two_sided", false);
    }
}

std::optional<Light::Kind> light_kind(const std::string& type) {
    if (type == "point") return Light::Kind::point;
    if (type == "spot") return Light::Kind::spot;
    if (type == "directional") return Light::Kind::sun;
    return std::nullopt;
}

void read_map(const GltfContext& context, const std::filesystem::path& file, Environment& environment, const std::string& where) {
    const Result<ImagePtr> image = read_environment_image(file);
    if (image) {
        environment.image = *image;
        return;
    }
    context.warn("environment map not read, its colour is used instead: " + image.error().what, where);
    environment.kind = Environment::Kind::constant;
}

// Reads the IES profile that extras name, in or below the scene's folder. If it cannot be read, the light has no profile.
void read_profile(const GltfContext& context, Light& light, const std::string& where) {
    if (light.ies_file.empty() || context.known) return;
    const auto file = resolve_uri(context.source.folder, light.ies_file);
    const Result<IesPtr> profile = file ? read_ies(*file) : Result<IesPtr>(file.error());
    if (profile)
        light.ies = *profile;
    else
        context.warn("IES profile not read: " + profile.error().text(), where);
}

std::optional<Light> read_punctual(const GltfContext& context, size_t i) {
    const tinygltf::Light& source = context.model().lights[i];
    const std::string where = fmt::format("extensions.KHR_lights_punctual.lights[{}]", i);
    const auto kind = light_kind(source.type);
    if (!kind) {
        context.warn("ignored: unknown light type '" + source.type.substr(0, 100) + "'", where);
        return std::nullopt;
    }
    Light light;
    light.name = source.name.empty() ? fmt::format("Light {}", i) : source.name;
    light.kind = *kind;
    light.color = checked(context, source.color, {1, 1, 1}, 0, any_float, where + ".color");
    light.intensity = checked(context, source.intensity, 1, 0, any_float, where + ".intensity");
    if (*kind == Light::Kind::spot) read_cone(context, source.spot, light, where);
    if (source.range != 0) context.note("ignored: the light's range; light falls off with the square of the distance", where);
    read_legacy_extras(GltfObject(context, source.extras, where + ".extras").object("blush"), light);
    read_extras(context, gltf_light(context.json(), "KHR_lights_punctual", i), light, where);
    read_profile(context, light, where);
    return light;
}

// EXT_lights_area is a Khronos draft: https://github.com/KhronosGroup/glTF/pull/2525
std::optional<Light> read_area(const GltfContext& context, const ParsedGltf& source, size_t i) {
    const std::string where = fmt::format("extensions.EXT_lights_area.lights[{}]", i);
    const auto number = [&](const ParsedGltf& object, const char* key, double otherwise) {
        const ParsedGltf& value = gltf_member(object, key);
        return value.is_number() ? value.get<double>() : otherwise;
    };
    const ParsedGltf& type = gltf_member(source, "type");
    if (type != "rect" && type != "disk") {
        context.warn("ignored: a type of area light other than 'rect' and 'disk'", where);
        return std::nullopt;
    }
    Light light;
    light.kind = type == "disk" ? Light::Kind::disk : Light::Kind::rectangle;
    const ParsedGltf& name = gltf_member(source, "name");
    light.name = name.is_string() && !name.empty() ? name.get<std::string>() : fmt::format("Area light {}", i);
    std::vector<double> color;
    for (const ParsedGltf& component : gltf_member(source, "color"))
        if (component.is_number()) color.push_back(component.get<double>());
    light.color = checked(context, color, {1, 1, 1}, 0, any_float, where + ".color");
    light.intensity = checked(context, number(source, "intensity", 1000), 1000, 0, any_float, where + ".intensity");
    const double size = number(source, "size", 1), aspect = number(gltf_member(source, "rect"), "aspect", 1);
    if (light.kind == Light::Kind::disk) {
        light.radius = checked(context, size / 2, 0.5f, min_side, any_float, where + ".size");
    } else {
        light.width = checked(context, size * aspect, 1, min_side, any_float, where + ".rect.aspect");
        light.height = checked(context, size, 1, min_side, any_float, where + ".size");
    }
    read_extras(context, source, light, where);
    return light;
}

} // namespace

Result<LightIds> import_lights(const GltfContext& context, const std::vector<int>& nodes, Scene& scene) {
    std::vector<std::optional<Light>> lights;
    std::vector<uint32_t> wanted;
    const size_t punctual = context.model().lights.size();
    for (size_t i = 0; i < punctual; ++i) {
        lights.push_back(read_punctual(context, i));
        wanted.push_back(requested_id(gltf_light(context.json(), "KHR_lights_punctual", i)));
    }
    const ParsedGltf& area = gltf_member(gltf_member(gltf_member(context.json(), "extensions"), "EXT_lights_area"), "lights");
    for (size_t i = 0; i < area.size() && area.is_array(); ++i) {
        lights.push_back(read_area(context, area[i], i));
        wanted.push_back(requested_id(area[i]));
    }
    const auto first_measured = std::ptrdiff_t(lights.size());
    Result<IesLights> measured = read_ies_lights(context, nodes);
    if (!measured) return measured.error();
    const ParsedGltf& profiles = gltf_member(gltf_member(gltf_member(context.json(), "extensions"), "EXT_lights_ies"), "lights");
    for (size_t i = 0; i < measured->lights.size(); ++i) {
        const bool first_of_profile = i == 0 || measured->profiles[i] != measured->profiles[i - 1];
        lights.push_back(std::move(measured->lights[i]));
        wanted.push_back(first_of_profile ? requested_id(gltf_element(profiles, size_t(measured->profiles[i]))) : 0);
    }
    const std::vector<Id<Light>> ids = add_with_ids(scene.lights, std::move(lights), wanted);
    const auto middle = ids.begin() + std::ptrdiff_t(punctual), end = ids.begin() + first_measured;
    return LightIds{{ids.begin(), middle}, {middle, end}, {end, ids.end()}, *std::move(measured)};
}

void index_lights(const LightIds& ids, GltfIndices& indices) {
    const auto add = [&](const std::vector<Id<Light>>& list, GltfLight::List name, const auto& index_of) {
        for (size_t i = 0; i < list.size(); ++i)
            if (list[i]) indices.lights[list[i]] = {name, index_of(i)};
    };
    add(ids.punctual, GltfLight::List::punctual, [](size_t i) { return int(i); });
    add(ids.area, GltfLight::List::area, [](size_t i) { return int(i); });
    add(ids.measured, GltfLight::List::measured, [&](size_t i) { return ids.ies_lights.profiles[i]; });
    indices.profile_peaks = ids.ies_lights.peaks;
}

Result<Environment> import_environment(const GltfContext& context, const ParsedGltf& gltf_scene, const std::string& scene_where,
                                       const Environment& otherwise) {
    const std::string where = scene_where + ".extras.blush.environment";
    Environment environment = otherwise;
    read_extra_fields(context, blush_fields(context, gltf_scene, "environment", where), environment, where);
    // The image is read last, and only if the rest is valid.
    const Environment::Kind kind = std::exchange(environment.kind, Environment::Kind::none);
    if (const auto valid = validate(environment); !valid) {
        context.warn("ignored: " + valid.error().what, where);
        return otherwise;
    }
    environment.kind = kind;
    const bool keeps_image = kind == Environment::Kind::image && environment.file.empty() && otherwise.kind == kind;
    if (!keeps_image) environment.image = nullptr;
    if (keeps_image || kind != Environment::Kind::image || context.known) return environment;
    const auto file = resolve_uri(context.source.folder, environment.file);
    if (!file) return context.error(file.error().what, where + ".file");
    read_map(context, *file, environment, where);
    return environment;
}

} // namespace blush
