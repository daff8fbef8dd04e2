#include "io/gltf/read/extras.h"

namespace blush {
namespace {

constexpr size_t max_values = 10000; // in the fields of one record

// Number of values inside `json`, counted up to `limit`. Recursion is safe: nesting is limited before.
size_t values_in(const ParsedGltf& json, size_t limit) {
    size_t count = 1;
    if (!json.is_structured()) return count;
    for (auto it = json.begin(); it != json.end() && count < limit; ++it) count += values_in(*it, limit - count);
    return count;
}

} // namespace

const ParsedGltf& blush_extras(const ParsedGltf& object) { return gltf_member(gltf_member(object, "extras"), "blush"); }

uint32_t requested_id(const ParsedGltf& object) {
    const ParsedGltf& id = gltf_member(blush_extras(object), "id");
    if (!id.is_number_unsigned()) return 0;
    const uint64_t value = id.get<uint64_t>();
    return value <= std::numeric_limits<uint32_t>::max() ? uint32_t(value) : 0;
}

bool is_fallback(const ParsedGltf& object) {
    const ParsedGltf& fallback = gltf_member(blush_extras(object), "fallback");
    return fallback.is_boolean() && fallback.get<bool>();
}

Json blush_fields(const GltfContext& context, const ParsedGltf& object, const char* key, const std::string& where) {
    const ParsedGltf& fields = gltf_member(blush_extras(object), key);
    if (fields.is_null()) return {};
    if (!fields.is_object() || values_in(fields, max_values) >= max_values) {
        context.warn("ignored: not an object, or too large", where);
        return {};
    }
    return Json(fields);
}

Json extra_fields(const Json& read, const Json& wanted) {
    Json fields = Json::object();
    for (const auto& [name, value] : wanted.items()) {
        const Json& before = read.at(name);
        if (before == value) continue;
        const bool record = value.is_object() && before.is_object();
        fields[name] = record ? extra_fields(before, value) : value;
    }
    return fields;
}

} // namespace blush
