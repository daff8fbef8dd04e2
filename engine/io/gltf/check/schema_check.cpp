#include "io/gltf/check/schema_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace blush {
namespace {

using nlohmann::json;

enum class Kind { text, boolean, number, natural };

struct Member {
    const char *list, *path; // path: JSON pointer within an element of the list
    Kind kind;
};

// Members that are read as absent if invalid; the parser reports the others.
constexpr std::array members{
    Member{"nodes", "/name", Kind::text},
    Member{"nodes", "/mesh", Kind::natural},
    Member{"nodes", "/camera", Kind::natural},
    Member{"nodes", "/skin", Kind::natural},
    Member{"meshes", "/name", Kind::text},
    Member{"materials", "/name", Kind::text},
    Member{"materials", "/doubleSided", Kind::boolean},
    Member{"materials", "/alphaMode", Kind::text},
    Member{"materials", "/alphaCutoff", Kind::number},
    Member{"materials", "/normalTexture/scale", Kind::number},
    Member{"materials", "/pbrMetallicRoughness/metallicFactor", Kind::number},
    Member{"materials", "/pbrMetallicRoughness/roughnessFactor", Kind::number},
    Member{"textures", "/source", Kind::natural},
    Member{"textures", "/sampler", Kind::natural},
    Member{"samplers", "/minFilter", Kind::natural},
    Member{"samplers", "/magFilter", Kind::natural},
    Member{"samplers", "/wrapS", Kind::natural},
    Member{"samplers", "/wrapT", Kind::natural},
    Member{"accessors", "/bufferView", Kind::natural},
    Member{"accessors", "/byteOffset", Kind::natural},
    Member{"accessors", "/normalized", Kind::boolean},
    Member{"bufferViews", "/byteOffset", Kind::natural},
    Member{"bufferViews", "/byteStride", Kind::natural},
    Member{"images", "/mimeType", Kind::text},
    Member{"cameras", "/name", Kind::text},
};
constexpr std::array members_of_primitives{
    Member{"primitives", "/indices", Kind::natural},
    Member{"primitives", "/material", Kind::natural},
    Member{"primitives", "/mode", Kind::natural},
};

const char* name_of(Kind kind) {
    switch (kind) {
    case Kind::text: return "a string";
    case Kind::boolean: return "true or false";
    case Kind::number: return "a number";
    case Kind::natural: return "a whole number from 0";
    }
    return "";
}

bool is_of(Kind kind, const json& value) {
    switch (kind) {
    case Kind::text: return value.is_string();
    case Kind::boolean: return value.is_boolean();
    case Kind::number: return value.is_number();
    case Kind::natural: return value.is_number_unsigned() || (value.is_number_float() && value.get<double>() >= 0);
    }
    return false;
}

const json& array_of(const json& object, const char* key) {
    static const json none = json::array();
    const auto it = object.is_object() ? object.find(key) : object.end();
    return it != object.end() && it->is_array() ? *it : none;
}

void report_member(const GltfContext& context, const json& object, const Member& member, const json::json_pointer& path,
                   const std::string& where) {
    if (!object.is_object() || !object.contains(path)) return;
    if (!is_of(member.kind, object.at(path)))
        context.warn(fmt::format("'{}' is not {}; its default is used", path.back(), name_of(member.kind)), where);
}

// Visits all objects except extras.
void collect_extensions(const json& value, std::set<std::string>& names) {
    for (const auto& [key, member] : value.items()) {
        if (!member.is_structured() || (value.is_object() && key == "extras")) continue;
        if (value.is_object() && key == "extensions" && member.is_object())
            for (const auto& [name, extension] : member.items()) names.insert(name.substr(0, 100));
        collect_extensions(member, names);
    }
}

void report_undeclared(const GltfContext& context) {
    std::set<std::string> names;
    collect_extensions(context.json(), names);
    for (const json& declared : array_of(context.json(), "extensionsUsed"))
        if (declared.is_string()) names.erase(declared.get<std::string>().substr(0, 100));
    for (const std::string& name : names) context.warn(fmt::format("{} is used, but not declared", name), "extensionsUsed");
}

} // namespace

void check_schema(const GltfContext& context) {
    const json& root = context.json();
    for (const Member& member : members) {
        const json::json_pointer path(member.path);
        const json& list = array_of(root, member.list);
        for (size_t i = 0; i < list.size(); ++i) report_member(context, list[i], member, path, fmt::format("{}[{}]", member.list, i));
    }
    const json& nodes = array_of(root, "nodes");
    for (size_t n = 0; n < nodes.size(); ++n)
        if (nodes[n].contains("matrix") &&
            (nodes[n].contains("translation") || nodes[n].contains("rotation") || nodes[n].contains("scale")))
            context.warn("has a matrix and also translation, rotation or scale: the matrix is used", fmt::format("nodes[{}]", n));
    const json& meshes = array_of(root, "meshes");
    for (size_t m = 0; m < meshes.size(); ++m) {
        const json& primitives = array_of(meshes[m], "primitives");
        if (primitives.empty()) context.warn("the mesh has no primitives", fmt::format("meshes[{}]", m));
        for (size_t p = 0; p < primitives.size(); ++p)
            for (const Member& member : members_of_primitives)
                report_member(context, primitives[p], member, json::json_pointer(member.path),
                              fmt::format("meshes[{}].primitives[{}]", m, p));
    }
    report_undeclared(context);
}

} // namespace blush
