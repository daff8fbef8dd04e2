#include "io/gltf_lights.h"

#include "io/environment_image.h"
#include "io/gltf_object.h"
#include "io/gltf_uri.h"

#include <fmt/format.h>
#include <numbers>
#include <optional>

namespace blush {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float radians_per_degree = pi / 180;
constexpr float smallest_side = 1e-6f; // metres: a rectangle without area cannot emit

void read_cone(const GltfContext& context, const tinygltf::SpotLight& spot, Light& light, const std::string& where) {
    light.outer_cone_radians = checked(context, spot.outerConeAngle, light.outer_cone_radians, 0, pi / 2, where + ".spot.outerConeAngle");
    light.inner_cone_radians = checked(context, spot.innerConeAngle, 0, 0, light.outer_cone_radians, where + ".spot.innerConeAngle");
}

void read_extras(const GltfObject& blush, Light& light) {
    light.angle_radians = blush.number("angle_degrees", 0, 0, 180) * radians_per_degree;
    light.radius = blush.number("radius", 0, 0, any_float);
    if (const GltfObject rectangle = blush.object("rectangle")) {
        light.kind = Light::Kind::rectangle;
        light.width = rectangle.number("width", 1, smallest_side, any_float);
        light.height = rectangle.number("height", 1, smallest_side, any_float);
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
    context.warn("environment map not read, its colour is used alone: " + image.error().what, where);
    environment.kind = Environment::Kind::constant;
}

} // namespace

std::vector<Id<Light>> import_lights(const GltfContext& context, Scene& scene) {
    std::vector<Id<Light>> ids(context.model().lights.size());
    for (size_t i = 0; i < ids.size(); ++i) {
        const tinygltf::Light& source = context.model().lights[i];
        const std::string where = fmt::format("extensions.KHR_lights_punctual.lights[{}]", i);
        const auto kind = light_kind(source.type);
        if (!kind) {
            context.warn("ignored: unknown light type '" + source.type.substr(0, 100) + "'", where);
            continue;
        }
        Light light;
        light.name = source.name.empty() ? fmt::format("Light {}", i) : source.name;
        light.kind = *kind;
        light.color = checked(context, source.color, {1, 1, 1}, 0, any_float, where + ".color");
        light.intensity = checked(context, source.intensity, 1, 0, any_float, where + ".intensity");
        if (*kind == Light::Kind::spot) read_cone(context, source.spot, light, where);
        if (source.range != 0) context.note("ignored: the light's range; light falls off with the square of the distance for ever", where);
        read_extras(GltfObject(context, source.extras, where + ".extras").object("blush"), light);
        ids[i] = scene.lights.add(std::move(light));
    }
    return ids;
}

Result<Environment> import_environment(const GltfContext& context, const tinygltf::Scene& gltf_scene, const std::string& where) {
    Environment environment;
    const GltfObject source = GltfObject(context, gltf_scene.extras, where + ".extras").object("blush").object("environment");
    if (!source) return environment;
    const std::string kind = source.text("kind");
    if (kind == "constant")
        environment.kind = Environment::Kind::constant;
    else if (kind == "image")
        environment.kind = Environment::Kind::image;
    else if (kind != "none")
        context.warn("unknown kind of environment; none is used", source.where());
    environment.color = source.vector3("color", {1, 1, 1}, 0, any_float);
    environment.intensity = source.number("intensity", 1, 0, any_float);
    environment.rotation_degrees = source.number("rotation_degrees", 0, -any_float, any_float);
    environment.visible_to_camera = source.boolean("visible_to_camera", true);
    if (environment.kind != Environment::Kind::image) return environment;
    environment.file = source.text("file");
    const auto file = resolve_uri(context.source.folder, environment.file);
    if (!file) return context.error(file.error().what, source.where() + ".file");
    read_map(context, *file, environment, source.where());
    return environment;
}

} // namespace blush
