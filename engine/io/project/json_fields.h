// Internal to *_json.cpp: reads typed members of untrusted JSON objects.
#pragma once

#include "core/result.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <concepts>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace blush {

using Json = nlohmann::ordered_json;

// Names may hold any bytes; invalid UTF-8 is replaced instead of throwing.
inline std::string json_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// Errors: not JSON, not an object.
inline Result<Json> parse_json_object(std::string_view text) {
    Json json = Json::parse(text, nullptr, /*allow_exceptions*/ false);
    if (json.is_discarded()) return Error{"", "not JSON", ""};
    if (!json.is_object()) return Error{"", "not a JSON object", ""};
    return json;
}

// Each assigns `value` and returns true; or returns false without a change if the JSON has another type or is out of range.
inline bool read_json(const Json& json, bool& value) {
    if (json.is_boolean()) value = json.get<bool>();
    return json.is_boolean();
}
inline bool read_json(const Json& json, std::string& value) {
    if (json.is_string()) value = json.get<std::string>();
    return json.is_string();
}
template <std::floating_point T> bool read_json(const Json& json, T& value) {
    if (!json.is_number() || !std::isfinite(T(json.get<double>()))) return false;
    value = T(json.get<double>());
    return true;
}
template <std::integral T> bool read_json(const Json& json, T& value) {
    const bool fits = json.is_number_unsigned() ? std::in_range<T>(json.get<uint64_t>())
                                                : json.is_number_integer() && std::in_range<T>(json.get<int64_t>());
    if (fits) value = json.is_number_unsigned() ? T(json.get<uint64_t>()) : T(json.get<int64_t>());
    return fits;
}

} // namespace blush
