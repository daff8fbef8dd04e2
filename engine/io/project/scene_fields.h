// Internal to io: reflection of the scene records. Lists the members of each record once, for hashing, writing and reading.
// visit_fields(record, visit) calls visit("name", member) in a fixed order, for const and mutable records. Payloads (triangles,
// pixels) are not visited.
#pragma once

#include "scene/scene.h"

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

namespace blush {

template <class T, class Record>
concept Is = std::same_as<std::remove_const_t<T>, Record>;

template <Is<TextureRef> T, class V> void visit_fields(T& r, V&& visit) {
    visit("texture", r.texture);
    visit("uv_set", r.uv_set);
    visit("offset", r.offset);
    visit("scale", r.scale);
    visit("rotation_radians", r.rotation_radians);
}

template <Is<Texture> T, class V> void visit_fields(T& r, V&& visit) {
    visit("name", r.name);
    visit("source", r.source);
    visit("wrap_u", r.wrap_u);
    visit("wrap_v", r.wrap_v);
    visit("filter", r.filter);
}

template <Is<Material> T, class V> void visit_fields(T& r, V&& visit) {
    visit("name", r.name);
    visit("base_color", r.base_color);
    visit("opacity", r.opacity);
    visit("metallic", r.metallic);
    visit("roughness", r.roughness);
    visit("emissive", r.emissive);
    visit("emissive_strength", r.emissive_strength);
    visit("emits", r.emits);
    visit("solo", r.solo);
    visit("normal_scale", r.normal_scale);
    visit("alpha", r.alpha);
    visit("alpha_cutoff", r.alpha_cutoff);
    visit("double_sided", r.double_sided);
    visit("unlit", r.unlit);
    visit("ior", r.ior);
    visit("specular", r.specular);
    visit("specular_color", r.specular_color);
    visit("transmission", r.transmission);
    visit("thickness", r.thickness);
    visit("attenuation_color", r.attenuation_color);
    visit("attenuation_distance", r.attenuation_distance);
    visit("base_color_texture", r.base_color_texture);
    visit("metallic_roughness_texture", r.metallic_roughness_texture);
    visit("normal_texture", r.normal_texture);
    visit("emissive_texture", r.emissive_texture);
    visit("specular_texture", r.specular_texture);
    visit("specular_color_texture", r.specular_color_texture);
    visit("transmission_texture", r.transmission_texture);
    visit("clearcoat", r.clearcoat);
    visit("clearcoat_roughness", r.clearcoat_roughness);
    visit("clearcoat_normal_scale", r.clearcoat_normal_scale);
    visit("sheen_color", r.sheen_color);
    visit("sheen_roughness", r.sheen_roughness);
    visit("anisotropy", r.anisotropy);
    visit("anisotropy_rotation_radians", r.anisotropy_rotation_radians);
    visit("iridescence", r.iridescence);
    visit("iridescence_ior", r.iridescence_ior);
    visit("iridescence_thickness_minimum", r.iridescence_thickness_minimum);
    visit("iridescence_thickness_maximum", r.iridescence_thickness_maximum);
    visit("dispersion", r.dispersion);
    visit("diffuse_transmission", r.diffuse_transmission);
    visit("diffuse_transmission_color", r.diffuse_transmission_color);
    visit("clearcoat_texture", r.clearcoat_texture);
    visit("clearcoat_roughness_texture", r.clearcoat_roughness_texture);
    visit("clearcoat_normal_texture", r.clearcoat_normal_texture);
    visit("sheen_color_texture", r.sheen_color_texture);
    visit("sheen_roughness_texture", r.sheen_roughness_texture);
    visit("anisotropy_texture", r.anisotropy_texture);
    visit("iridescence_texture", r.iridescence_texture);
    visit("iridescence_thickness_texture", r.iridescence_thickness_texture);
    visit("diffuse_transmission_texture", r.diffuse_transmission_texture);
    visit("diffuse_transmission_color_texture", r.diffuse_transmission_color_texture);
}

template <Is<ObjectSet> T, class V> void visit_fields(T& r, V&& visit) {
    visit("all_but", r.all_but);
    visit("nodes", r.nodes);
}

template <Is<Light> T, class V> void visit_fields(T& r, V&& visit) {
    visit("name", r.name);
    visit("kind", r.kind);
    visit("color", r.color);
    visit("use_temperature", r.use_temperature);
    visit("kelvin", r.kelvin);
    visit("green_tint", r.green_tint);
    visit("intensity", r.intensity);
    visit("unit", r.unit);
    visit("keep_power", r.keep_power);
    visit("radius", r.radius);
    visit("angle_radians", r.angle_radians);
    visit("inner_cone_radians", r.inner_cone_radians);
    visit("outer_cone_radians", r.outer_cone_radians);
    visit("width", r.width);
    visit("height", r.height);
    visit("two_sided", r.two_sided);
    visit("spread_radians", r.spread_radians);
    visit("visible_to_camera", r.visible_to_camera);
    visit("ies_file", r.ies_file);
    visit("enabled", r.enabled);
    visit("solo", r.solo);
    visit("group", r.group);
    visit("lit_objects", r.lit_objects);
    visit("shadow_casters", r.shadow_casters);
}

template <Is<Lens> T, class V> void visit_fields(T& r, V&& visit) {
    visit("orthographic", r.orthographic);
    visit("yfov_radians", r.yfov_radians);
    visit("ymag", r.ymag);
    visit("aperture_radius", r.aperture_radius);
    visit("focus_distance", r.focus_distance);
}

template <Is<Camera> T, class V> void visit_fields(T& r, V&& visit) {
    visit("name", r.name);
    visit("lens", r.lens);
}

template <Is<Transform> T, class V> void visit_fields(T& r, V&& visit) {
    visit("translation", r.translation);
    visit("rotation", r.rotation);
    visit("scale", r.scale);
    visit("matrix", r.matrix);
}

template <Is<Node> T, class V> void visit_fields(T& r, V&& visit) {
    visit("name", r.name);
    visit("parent", r.parent);
    visit("local", r.local);
    visit("mesh", r.mesh);
    visit("light", r.light);
    visit("camera", r.camera);
    visit("visible", r.visible);
    visit("skin", r.skin);
    visit("morph_weights", r.morph_weights);
    visit("only_in_scenes", r.only_in_scenes);
    visit("shadow_catcher", r.shadow_catcher);
}

template <Is<SceneSelection> T, class V> void visit_fields(T& r, V&& visit) {
    visit("clip", r.clip);
    visit("seconds", r.seconds);
    visit("scene", r.scene);
    visit("variant", r.variant);
}

template <Is<Sky> T, class V> void visit_fields(T& r, V&& visit) {
    visit("turbidity", r.turbidity);
    visit("ground_albedo", r.ground_albedo);
    visit("sun_disk", r.sun_disk);
    visit("by_place_and_time", r.by_place_and_time);
    visit("elevation_degrees", r.elevation_degrees);
    visit("azimuth_degrees", r.azimuth_degrees);
    visit("latitude_degrees", r.latitude_degrees);
    visit("longitude_degrees", r.longitude_degrees);
    visit("year", r.year);
    visit("month", r.month);
    visit("day", r.day);
    visit("utc_hours", r.utc_hours);
}

template <Is<Environment> T, class V> void visit_fields(T& r, V&& visit) {
    visit("kind", r.kind);
    visit("color", r.color);
    visit("intensity", r.intensity);
    visit("rotation_degrees", r.rotation_degrees);
    visit("file", r.file);
    visit("sky", r.sky);
    visit("visible_to_camera", r.visible_to_camera);
    visit("lights_scene", r.lights_scene);
    visit("solo", r.solo);
    visit("group", r.group);
}

template <Is<MixChannel> T, class V> void visit_fields(T& r, V&& visit) {
    visit("group", r.group);
    visit("enabled", r.enabled);
    visit("intensity", r.intensity);
    visit("color", r.color);
    visit("use_temperature", r.use_temperature);
    visit("kelvin", r.kelvin);
}

template <Is<LightMix> T, class V> void visit_fields(T& r, V&& visit) {
    visit("grouping", r.grouping);
    visit("channels", r.channels);
}

template <Is<View> T, class V> void visit_fields(T& r, V&& visit) {
    visit("position", r.position);
    visit("rotation", r.rotation);
    visit("pivot_distance", r.pivot_distance);
    visit("lens", r.lens);
}

// A record with visit_fields.
template <class T>
concept Fielded = requires(T& record) {
    visit_fields(record, [](std::string_view, auto&) {});
};

// JSON names of an enumeration, in the order of its values.
template <class E> constexpr std::array<std::string_view, 0> enum_words = {};
template <>
inline constexpr std::array<std::string_view, 6> enum_words<Light::Kind> = {"point", "spot", "sun", "rectangle", "disk", "sphere"};
template <>
inline constexpr std::array<std::string_view, 7> enum_words<Light::Unit> = {"own", "watt", "lumen", "candela", "lux", "nits", "ev"};
template <> inline constexpr std::array<std::string_view, 3> enum_words<Material::Alpha> = {"opaque", "mask", "blend"};
template <> inline constexpr std::array<std::string_view, 3> enum_words<Texture::Wrap> = {"repeat", "clamp_to_edge", "mirrored_repeat"};
template <> inline constexpr std::array<std::string_view, 2> enum_words<Texture::Filter> = {"linear", "nearest"};
template <> inline constexpr std::array<std::string_view, 4> enum_words<Environment::Kind> = {"none", "constant", "image", "sky"};
template <> inline constexpr std::array<std::string_view, 5> enum_words<LightMix::Grouping> = {"none", "by_light", "by_object",
                                                                                               "by_material", "by_hand"};

} // namespace blush
