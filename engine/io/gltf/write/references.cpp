#include "io/gltf/write/references.h"

#include <algorithm>
#include <array>

namespace blush {
namespace {

// Values at `path` in objects of `list` are indices into `target` ("*": every member or element).
struct Reference {
    std::string_view list, path, target;
};

constexpr Reference references[] = {
    {"scenes", "nodes/*", "nodes"},
    {"nodes", "children/*", "nodes"},
    {"nodes", "mesh", "meshes"},
    {"nodes", "camera", "cameras"},
    {"nodes", "skin", "skins"},
    {"nodes", "extensions/KHR_lights_punctual/light", "KHR_lights_punctual"},
    {"nodes", "extensions/EXT_lights_area/light", "EXT_lights_area"},
    {"nodes", "extensions/EXT_lights_ies/light", "EXT_lights_ies"},
    {"nodes", "extensions/EXT_mesh_gpu_instancing/attributes/*", "accessors"},
    {"scenes", "extensions/EXT_lights_image_based/light", "EXT_lights_image_based"},
    {"EXT_lights_ies", "bufferView", "bufferViews"},
    {"EXT_lights_image_based", "specularImages/*/*", "images"},
    {"meshes", "primitives/*/attributes/*", "accessors"},
    {"meshes", "primitives/*/indices", "accessors"},
    {"meshes", "primitives/*/targets/*/*", "accessors"},
    {"meshes", "primitives/*/material", "materials"},
    {"meshes", "primitives/*/extensions/KHR_draco_mesh_compression/bufferView", "bufferViews"},
    {"meshes", "primitives/*/extensions/KHR_materials_variants/mappings/*/material", "materials"},
    {"textures", "source", "images"},
    {"textures", "sampler", "samplers"},
    {"textures", "extensions/*/source", "images"},
    {"images", "bufferView", "bufferViews"},
    {"accessors", "bufferView", "bufferViews"},
    {"accessors", "sparse/indices/bufferView", "bufferViews"},
    {"accessors", "sparse/values/bufferView", "bufferViews"},
    {"bufferViews", "buffer", "buffers"},
    {"bufferViews", "extensions/EXT_meshopt_compression/buffer", "buffers"},
    {"skins", "joints/*", "nodes"},
    {"skins", "skeleton", "nodes"},
    {"skins", "inverseBindMatrices", "accessors"},
    {"animations", "channels/*/target/node", "nodes"},
    {"animations", "samplers/*/input", "accessors"},
    {"animations", "samplers/*/output", "accessors"},
};

// In addition to all KHR_materials_*, whose textures are found by name.
constexpr std::array known_extensions = {
    "KHR_lights_punctual", "KHR_node_visibility",   "KHR_texture_transform",  "KHR_texture_basisu",      "KHR_draco_mesh_compression",
    "KHR_xmp_json_ld",     "KHR_mesh_quantization", "EXT_lights_area",        "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
    "EXT_texture_webp",    "EXT_lights_ies",        "EXT_lights_image_based",
};

using Visit = std::function<void(Json&)>;

void visit_path(Json& value, std::string_view path, const Visit& visit) {
    if (path.empty()) {
        if (value.is_number_integer()) visit(value);
        return;
    }
    if (!value.is_structured()) return;
    const size_t slash = path.find('/');
    const std::string_view key = path.substr(0, slash), rest = slash == path.npos ? std::string_view() : path.substr(slash + 1);
    if (key == "*") {
        for (Json& element : value) visit_path(element, rest, visit);
    } else if (const auto it = value.find(key); it != value.end()) {
        visit_path(*it, rest, visit);
    }
}

// A textureInfo is any member of a material or its extensions whose name ends with "Texture".
void visit_textures(Json& object, const Visit& visit) {
    for (auto it = object.begin(); it != object.end(); ++it) {
        if (!it->is_object() || it.key() == "extras") continue;
        if (it.key().ends_with("Texture")) visit_path(*it, "index", visit);
        visit_textures(*it, visit);
    }
}

} // namespace

void visit_references(std::string_view list_name, Json& object, const std::function<void(std::string_view, Json&)>& visit) {
    for (const Reference& r : references)
        if (r.list == list_name) visit_path(object, r.path, [&](Json& index) { visit(r.target, index); });
    if (list_name == "materials" && object.is_object()) visit_textures(object, [&](Json& index) { visit("textures", index); });
}

bool finds_all_references(std::string_view extension) {
    return extension.starts_with("KHR_materials_") || std::ranges::count(known_extensions, extension) > 0;
}

} // namespace blush
