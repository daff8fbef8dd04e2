// Internal to io/gltf: reads properties without a glTF equivalent from `extras.blush` of an object.
//
//   "id": 7                                              the record's id, if it is not the next in sequence
//   "fields": {"kind": "rectangle", "two_sided": true}   members by the names of scene_fields.h
//   "fallback": true                                     marks a node, material or accessor that is only for other programs
#pragma once

#include "io/gltf/read/context.h"
#include "io/gltf/read/json_members.h"
#include "io/project/scene_json.h"
#include "scene/validate.h"

#include <fmt/format.h>

namespace blush {

const ParsedGltf& blush_extras(const ParsedGltf& object);
// The id in extras.blush.id; 0: none.
uint32_t requested_id(const ParsedGltf& object);
bool is_fallback(const ParsedGltf& object);

// extras.blush[key]; null if absent or, with a warning, too large.
Json blush_fields(const GltfContext& context, const ParsedGltf& object, const char* key, const std::string& where);

template <class T> inline constexpr bool is_id = false;
template <class T> inline constexpr bool is_id<Id<T>> = true;

// Sets the fields that `json` contains. Ids are skipped: the glTF document holds the references.
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

// Applies extras.blush.fields of an object to a record. Ignores all of them, with a warning, if the result is not valid.
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

// The fields in which `wanted` differs from `read` (both from to_json), as input of read_extra_fields; empty if none.
Json extra_fields(const Json& read, const Json& wanted);

} // namespace blush
