// Internal to *_json.cpp: converts scene records to JSON and back, by field.
#pragma once

#include "io/project/json_fields.h"
#include "io/project/scene_fields.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace blush {

// --- values to JSON ------------------------------------------------------------------------------------------

template <class T>
requires std::is_arithmetic_v<T> || std::same_as<T, std::string> Json to_json(const T& v) { return v; }
template <class E>
requires std::is_enum_v<E> Json to_json(const E& v) { return std::string(enum_words<E>[size_t(v)]); }
template <class T> Json to_json(const Id<T>& id) { return id.value; }
inline Json to_json(const Vec2& v) { return Json::array({v.x, v.y}); }
inline Json to_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
inline Json to_json(const Quat& q) { return Json::array({q.x, q.y, q.z, q.w}); }
// Four columns of three numbers, or null.
inline Json to_json(const std::optional<Affine>& m) {
    return m ? Json::array({to_json(m->x), to_json(m->y), to_json(m->z), to_json(m->t)}) : Json();
}
template <class T> Json to_json(const std::vector<T>& list);
template <Fielded T> Json to_json(const T& record) {
    Json json = Json::object();
    visit_fields(record, [&](std::string_view name, const auto& field) { json[std::string(name)] = to_json(field); });
    return json;
}
template <class T> Json to_json(const std::vector<T>& list) {
    Json json = Json::array();
    for (const T& item : list) json.push_back(to_json(item));
    return json;
}

// The fields of `now` that differ from `before`.
template <Fielded T> Json changed_fields(const T& before, const T& now) {
    const Json old_fields = to_json(before), new_fields = to_json(now);
    Json changed = Json::object();
    for (const auto& [name, value] : new_fields.items())
        if (old_fields.at(name) != value) changed[name] = value;
    return changed;
}

// --- JSON to values: false if the JSON is invalid; the value is then unspecified -----------------------------

template <class E>
requires std::is_enum_v<E>
bool read_json(const Json& json, E& v) {
    std::string word;
    if (!read_json(json, word)) return false;
    const auto it = std::find(enum_words<E>.begin(), enum_words<E>.end(), word);
    v = E(it - enum_words<E>.begin());
    return it != enum_words<E>.end();
}
template <class T> bool read_json(const Json& json, Id<T>& id) { return read_json(json, id.value); }

template <size_t n> bool read_json(const Json& json, const std::array<float*, n>& values) {
    if (!json.is_array() || json.size() != n) return false;
    for (size_t i = 0; i < n; ++i)
        if (!read_json(json[i], *values[i])) return false;
    return true;
}
inline bool read_json(const Json& json, Vec2& v) { return read_json(json, std::array{&v.x, &v.y}); }
inline bool read_json(const Json& json, Vec3& v) { return read_json(json, std::array{&v.x, &v.y, &v.z}); }
inline bool read_json(const Json& json, Quat& q) { return read_json(json, std::array{&q.x, &q.y, &q.z, &q.w}); }
inline bool read_json(const Json& json, std::optional<Affine>& m) {
    m.reset();
    if (json.is_null()) return true;
    if (!json.is_array() || json.size() != 4) return false;
    m.emplace();
    return read_json(json[0], m->x) && read_json(json[1], m->y) && read_json(json[2], m->z) && read_json(json[3], m->t);
}

template <class T> bool read_json(const Json& json, std::vector<T>& list);
// Sets the fields in the JSON; false for an unknown name.
template <Fielded T> bool read_json(const Json& json, T& record) {
    if (!json.is_object()) return false;
    size_t understood = 0;
    visit_fields(record, [&](std::string_view name, auto& field) {
        const auto it = json.find(name);
        if (it != json.end() && read_json(*it, field)) ++understood;
    });
    return understood == json.size();
}
template <class T> bool read_json(const Json& json, std::vector<T>& list) {
    if (!json.is_array()) return false;
    list.assign(json.size(), T{});
    for (size_t i = 0; i < list.size(); ++i)
        if (!read_json(json[i], list[i])) return false;
    return true;
}

} // namespace blush
