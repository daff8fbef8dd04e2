#include "io/gltf_extensions.h"

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
    Row{"EXT_lights_area", {Kind::approximated, "a node's scale acts on width and height each, not the larger on both"}},
    Row{"EXT_lights_ies", {Kind::honoured, ""}},
    Row{"EXT_lights_image_based",
        {Kind::approximated,
         "the environment is the sharpest level of the cube map; diffuse light comes from it too, not from the coefficients"}},
    Row{"KHR_materials_anisotropy", {Kind::honoured, ""}},
    Row{"KHR_materials_clearcoat", {Kind::honoured, ""}},
    Row{"KHR_materials_diffuse_transmission", {Kind::honoured, ""}},
    Row{"KHR_materials_dispersion",
        {Kind::approximated, "wavelengths are shown as far as the working space can: pure spectral colours are paler"}},
    Row{"KHR_materials_emissive_strength", {Kind::honoured, ""}},
    Row{"KHR_materials_ior", {Kind::honoured, ""}},
    Row{"KHR_materials_iridescence",
        {Kind::approximated, "two orders of interference, without polarisation; below a clear coat as in air"}},
    Row{"KHR_materials_pbrSpecularGlossiness",
        {Kind::approximated,
         "converted to metallic-roughness: a glossiness texture counts as its mean, and its colours do not dim the diffuse part"}},
    Row{"KHR_materials_sheen",
        {Kind::approximated, "under grazing angles no more than the light that arrives, where the model's fit returns more"}},
    Row{"KHR_materials_specular", {Kind::honoured, ""}},
    Row{"KHR_materials_transmission", {Kind::honoured, ""}},
    Row{"KHR_materials_unlit", {Kind::honoured, ""}},
    Row{"KHR_materials_variants", {Kind::honoured, ""}},
    Row{"KHR_mesh_quantization", {Kind::honoured, ""}},
    Row{"KHR_texture_transform", {Kind::honoured, ""}},
    Row{"KHR_materials_volume",
        {Kind::approximated, "paths through the volume follow the mesh itself; the thickness only tells solid from thin-walled"}},
    Row{"EXT_texture_webp", {Kind::honoured, ""}},
    Row{"KHR_animation_pointer", {Kind::ignored, "what it animates beside nodes stays as it is"}},
    Row{"KHR_texture_basisu",
        {Kind::approximated, "KTX2 cannot be decoded; the PNG, JPEG or WebP in its place is read, and without one the factor alone"}},
    Row{"KHR_xmp_json_ld", {Kind::ignored, "metadata does not change the picture"}},
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
    return {Kind::ignored, "not known to this version"};
}

} // namespace blush
