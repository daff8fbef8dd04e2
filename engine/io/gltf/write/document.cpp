#include "io/gltf/write/document.h"

#include <algorithm>
#include <charconv>

namespace blush {

std::string_view list_name(GltfLight::List list) {
    switch (list) {
    case GltfLight::List::punctual: return "KHR_lights_punctual";
    case GltfLight::List::area: return "EXT_lights_area";
    case GltfLight::List::measured: return "EXT_lights_ies";
    }
    return {};
}

bool is_extension_list(std::string_view name) {
    return name == "EXT_lights_image_based" || std::ranges::find(light_lists, name, list_name) != std::end(light_lists);
}

Json* GltfDocument::find_list(std::string_view name) {
    const bool lights = is_extension_list(name);
    Json* parent = &root;
    if (lights)
        for (const std::string_view key : {std::string_view("extensions"), name}) {
            const auto it = parent->find(key);
            if (it == parent->end()) return nullptr;
            parent = &*it;
        }
    const auto it = parent->find(lights ? "lights" : name);
    return it != parent->end() && it->is_array() ? &*it : nullptr;
}

Json& GltfDocument::list(std::string_view name) {
    if (Json* found = find_list(name)) return *found;
    const bool lights = is_extension_list(name);
    Json& parent = lights ? extension_of(root, name) : root;
    return parent[lights ? "lights" : std::string(name)] = Json::array();
}

int GltfDocument::append(std::string_view list_name, Json object) {
    Json& objects = list(list_name);
    objects.push_back(std::move(object));
    return int(objects.size()) - 1;
}

int GltfDocument::append_view(std::span<const uint8_t> bytes, int target) {
    if (added_buffer < 0) added_buffer = append("buffers", {{"byteLength", 0}});
    added.resize((added.size() + 3) / 4 * 4);
    Json view{{"buffer", added_buffer}, {"byteOffset", added.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    added.insert(added.end(), bytes.begin(), bytes.end());
    object("buffers", added_buffer)["byteLength"] = added.size();
    return append("bufferViews", std::move(view));
}

Json& GltfDocument::scene() {
    if (!find_list("scenes") || list("scenes").empty()) root["scene"] = append("scenes", Json::object());
    size_t shown = 0;
    if (const Json& index = child_or_null(root, "scene"); !index.is_null()) read_json(index, shown);
    return list("scenes").at(shown);
}

Json& child(Json& parent, std::string_view key) {
    Json& member = parent[std::string(key)];
    if (!member.is_object()) member = Json::object();
    return member;
}

const Json& child_or_null(const Json& parent, std::string_view key) {
    static const Json null;
    const auto it = parent.find(key);
    return it == parent.end() ? null : *it;
}

void erase(Json& parent, std::string_view key) {
    if (const auto it = parent.find(key); it != parent.end()) parent.erase(it);
}

Json& blush_of(Json& object) {
    const auto extras = object.find("extras");
    if (extras != object.end() && !extras->is_object()) *extras = Json{{"value", *extras}};
    return child(child(object, "extras"), "blush");
}

void erase_blush(Json& object, std::string_view key) {
    const auto extras = object.find("extras");
    if (extras == object.end()) return;
    const auto blush = extras->find("blush");
    if (blush == extras->end() || !blush->contains(key)) return;
    erase(*blush, key);
    if (blush->empty()) erase(*extras, "blush");
    if (extras->empty()) erase(object, "extras");
}

Json& extension_of(Json& object, std::string_view name) { return child(child(object, "extensions"), name); }

void erase_extension(Json& object, std::string_view name) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->contains(name)) return;
    erase(*extensions, name);
    if (extensions->empty()) erase(object, "extensions");
}

Json json_number(float value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    double shortest = value;
    std::from_chars(text, end, shortest);
    return shortest;
}

void set_number(Json& object, std::string_view key, float value, float otherwise) {
    const auto it = object.find(key);
    float now = otherwise;
    if (it == object.end() ? value == otherwise : read_json(*it, now) && now == value) return;
    object[std::string(key)] = json_number(value);
}

void set_vector(Json& object, std::string_view key, std::initializer_list<float> values, std::initializer_list<float> otherwise) {
    const auto same = [](const Json& element, float value) {
        float now = 0;
        return read_json(element, now) && now == value;
    };
    const auto it = object.find(key);
    if (it == object.end() ? std::ranges::equal(values, otherwise)
                           : it->is_array() && std::equal(it->begin(), it->end(), values.begin(), values.end(), same))
        return;
    Json vector = Json::array();
    for (const float value : values) vector.push_back(json_number(value));
    object[std::string(key)] = std::move(vector);
}

void set_flag(Json& object, std::string_view key, bool value) {
    if (!value)
        erase(object, key);
    else if (child_or_null(object, key) != true)
        object[std::string(key)] = true;
}

void set_index(Json& object, std::string_view key, int index) {
    if (index < 0)
        erase(object, key);
    else if (child_or_null(object, key) != index)
        object[std::string(key)] = index;
}

} // namespace blush
