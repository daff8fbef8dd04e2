#include "io/gltf/write/write.h"

#include "core/math.h"
#include "io/gltf/read/uri.h"
#include "scene/lights/color_temperature.h"

#include <algorithm>

namespace blush {
namespace {

const char* type_of(Light::Kind kind) {
    switch (kind) {
    case Light::Kind::spot: return "spot";
    case Light::Kind::sun: return "directional";
    default: return "point";
    }
}

void write_type(Json& object, const char* type) {
    if (child_or_null(object, "type") != type) object["type"] = type;
}

void write_emission(Json& object, const Light& light, float intensity_otherwise) {
    const PlainEmission e = plain_emission(light);
    set_vector(object, "color", {e.color.x, e.color.y, e.color.z}, {1, 1, 1});
    set_number(object, "intensity", e.intensity, intensity_otherwise);
}

// KHR_lights_punctual requires 0 <= inner < outer <= pi / 2.
void write_cone(Json& object, const Light& light) {
    constexpr float min_cone = 1e-4f;
    Json& spot = child(object, "spot");
    const float outer = std::clamp(light.outer_cone_radians, min_cone, pi / 2);
    set_number(spot, "outerConeAngle", outer, pi / 4);
    set_number(spot, "innerConeAngle", std::clamp(light.inner_cone_radians, 0.0f, outer * 0.999f), 0);
}

} // namespace

PlainEmission plain_emission(const Light& light) {
    const Vec3 color = light.use_temperature ? light.color * black_body_color(light.kelvin, light.green_tint) : light.color;
    const float largest = std::max({color.x, color.y, color.z});
    const float scale = largest > 1 ? largest : 1;
    // A distant sphere of radiance L is a point light of intensity L times the area of its disk.
    const float area = light.kind == Light::Kind::sphere ? pi * light.radius * light.radius : 1;
    return {{color.x / scale, color.y / scale, color.z / scale}, light.enabled ? light.intensity * area * scale : 0};
}

GltfLight::List list_for(Light::Kind kind) {
    const bool area = kind == Light::Kind::rectangle || kind == Light::Kind::disk;
    return area ? GltfLight::List::area : GltfLight::List::punctual;
}

void write_punctual_light(Json& object, const Light& light) {
    write_type(object, type_of(light.kind));
    write_emission(object, light, 1);
    if (light.kind == Light::Kind::sun) erase(object, "range"); // not allowed for directional lights
    if (light.kind == Light::Kind::spot)
        write_cone(object, light);
    else
        erase(object, "spot");
}

void write_profile(Json& object, const Light& light) {
    const Json& uri = child_or_null(object, "uri");
    if (light.ies_file.empty() || (uri.is_string() && percent_decoded(uri.get_ref<const std::string&>()) == light.ies_file)) return;
    for (const char* key : {"bufferView", "mimeType"}) erase(object, key);
    object["uri"] = percent_encoded(light.ies_file);
}

void write_ies_instance(Json& extension, const Light& light, float peak) {
    const PlainEmission e = plain_emission(light);
    float now = 1;
    read_json(child_or_null(extension, "multiplier"), now);
    if (now * peak != e.intensity) set_number(extension, "multiplier", e.intensity / peak, 1);
    set_vector(extension, "color", {e.color.x, e.color.y, e.color.z}, {1, 1, 1});
}

void write_area_light(Json& object, const Light& light) {
    const bool disk = light.kind == Light::Kind::disk;
    write_type(object, disk ? "disk" : "rect");
    write_emission(object, light, 1000);
    set_number(object, "size", disk ? 2 * light.radius : light.height, 1);
    if (disk) return erase(object, "rect");
    const double aspect = double(light.width) / double(light.height);
    if (child_or_null(child_or_null(object, "rect"), "aspect") != aspect) child(object, "rect")["aspect"] = aspect;
}

} // namespace blush
