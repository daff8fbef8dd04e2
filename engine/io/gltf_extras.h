// Internal to gltf_*.cpp: what glTF cannot say of a record, in `extras.blush` of its object.
//
//   "id": 7                                              the record's id, where counting would give another
//   "fields": {"kind": "rectangle", "two_sided": true}   members by the names of scene_fields.h
//   "fallback": true                                     of a node, material or accessor that is there for other programs alone
#pragma once

#include "io/gltf_source.h"
#include "io/scene_json.h"
#include "scene/validate.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

namespace blush {

using ParsedGltf = nlohmann::json; // unordered: a hostile file cannot make looking things up slow

// Members and elements, or null where there is none of that name, that index or that type.
const ParsedGltf& gltf_member(const ParsedGltf& object, std::string_view key);
const ParsedGltf& gltf_element(const ParsedGltf& list, size_t index);
// root[list][index]
inline const ParsedGltf& gltf_item(const ParsedGltf& root, std::string_view list, size_t index) {
    return gltf_element(gltf_member(root, list), index);
}
// root.extensions[extension].lights[index]
const ParsedGltf& gltf_light(const ParsedGltf& root, std::string_view extension, size_t index);

const ParsedGltf& blush_extras(const ParsedGltf& object);
// 0: none.
uint32_t wanted_id(const ParsedGltf& object);
bool is_fallback(const ParsedGltf& object);

// extras.blush[key], small enough to be read field by field; null if absent or, with a warning, absurdly large.
Json blush_fields(const GltfContext& context, const ParsedGltf& object, const char* key, const std::string& where);

template <class T> inline constexpr bool is_id = false;
template <class T> inline constexpr bool is_id<Id<T>> = true;

// Sets the fields that `json` names. References between records are not read: the document itself says them.
template <Fielded T> void read_extra_fields(const GltfContext& context, const Json& json, T& record, const std::string& where) {
    if (!json.is_object()) return;
    size_t known = 0;
    visit_fields(record, [&]<class Field>(std::string_view name, Field& field) {
        const auto it = json.find(name);
        if (it == json.end()) return;
        ++known;
        if constexpr (Fielded<Field>) {
            read_extra_fields(context, *it, field, fmt::format("{}.{}", where, name));
        } else if constexpr (!is_id<Field>) {
            Field value = field;
            if (read_json(*it, value))
                field = std::move(value);
            else
                context.warn("not a value that this version can read", fmt::format("{}.{}", where, name));
        }
    });
    if (known < json.size()) context.note(fmt::format("ignored: {} members that this version does not know", json.size() - known), where);
}

// extras.blush.fields of an object, applied to what the rest of it says. Values that make no sense leave the record as it was.
template <Fielded T> void read_extras(const GltfContext& context, const ParsedGltf& object, T& record, const std::string& where) {
    const std::string fields_where = where + ".extras.blush.fields";
    const Json fields = blush_fields(context, object, "fields", fields_where);
    if (fields.is_null()) return;
    T candidate = record;
    read_extra_fields(context, fields, candidate, fields_where);
    if (const auto valid = validate(candidate); valid)
        record = std::move(candidate);
    else
        context.warn("ignored: " + valid.error().what, fields_where);
}

// What read_extra_fields needs to make `wanted` of `read`, both as to_json gives them: empty if nothing.
Json extra_fields(const Json& read, const Json& wanted);

} // namespace blush
