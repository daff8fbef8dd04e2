#include "io/gltf/read/extensions.h"

#include <algorithm>
#include <array>

namespace blush {
namespace {

using Kind = ExtensionSupport::Kind;

struct Row {
    std::string_view name;
    ExtensionSupport support;
};

constexpr std::array rows{
    Row{"EXT_meshopt_compression", {Kind::honoured, ""}},
    Row{"EXT_mesh_gpu_instancing", {Kind::honoured, ""}},
    Row{"KHR_draco_mesh_compression", {Kind::honoured, ""}},
    Row{"KHR_lights_punctual", {Kind::honoured, ""}},
    Row{"KHR_node_visibility", {Kind::honoured, ""}},
    Row{"EXT_lights_area", {Kind::approximated, "a node's scale applies to width and height separately, not the larger one to both"}},
    Row{"EXT_lights_ies", {Kind::honoured, ""}},
    Row{"EXT_lights_image_based",
        {Kind::approximated, "the environment is the finest mip level of the cube map, also for diffuse light; irradiance "
                             "coefficients are not used"}},
    Row{"KHR_materials_anisotropy", {Kind::honoured, ""}},
    Row{"KHR_materials_clearcoat", {Kind::honoured, ""}},
    Row{"KHR_materials_diffuse_transmission", {Kind::honoured, ""}},
    Row{"KHR_materials_dispersion", {Kind::approximated, "spectral colours are limited to the gamut of the working space"}},
    Row{"KHR_materials_emissive_strength", {Kind::honoured, ""}},
    Row{"KHR_materials_ior", {Kind::honoured, ""}},
    Row{"KHR_materials_iridescence",
        {Kind::approximated, "two orders of interference, without polarisation; below a clear coat as in air"}},
    Row{"KHR_materials_pbrSpecularGlossiness",
        {Kind::approximated, "converted to metallic-roughness: a glossiness texture is replaced by its mean, its colours do not "
                             "reduce the diffuse part"}},
    Row{"KHR_materials_sheen", {Kind::approximated, "reflects at most all light at grazing angles, where the model's fit exceeds it"}},
    Row{"KHR_materials_specular", {Kind::honoured, ""}},
    Row{"KHR_materials_transmission", {Kind::honoured, ""}},
    Row{"KHR_materials_unlit", {Kind::honoured, ""}},
    Row{"KHR_materials_variants", {Kind::honoured, ""}},
    Row{"KHR_mesh_quantization", {Kind::honoured, ""}},
    Row{"KHR_texture_transform", {Kind::honoured, ""}},
    Row{"KHR_materials_volume", {Kind::approximated, "paths traverse the mesh itself; the thickness only selects solid or thin-walled"}},
    Row{"EXT_texture_webp", {Kind::honoured, ""}},
    Row{"KHR_animation_pointer", {Kind::ignored, "properties other than those of nodes are not animated"}},
    Row{"KHR_texture_basisu",
        {Kind::approximated, "KTX2 cannot be decoded; the PNG, JPEG or WebP in its place is read, and without one the factor alone"}},
    Row{"KHR_xmp_json_ld", {Kind::ignored, "metadata does not affect the image"}},
};

} // namespace

std::vector<std::string_view> known_extensions() {
    std::vector<std::string_view> names;
    for (const Row& row : rows) names.push_back(row.name);
    return names;
}

ExtensionSupport extension_support(std::string_view name) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == name; });
    if (row != rows.end()) return row->support;
    if (name.starts_with("KHR_materials_")) return {Kind::ignored, "the surface is shown without it"};
    return {Kind::ignored, "unknown extension"};
}

} // namespace blush
