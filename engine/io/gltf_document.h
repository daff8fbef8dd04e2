// Internal to gltf_*.cpp: a glTF document that is being edited. What is not touched keeps its place, its spelling and its meaning.
#pragma once

#include "core/vec.h"
#include "io/gltf_indices.h"
#include "io/json_fields.h"

#include <initializer_list>
#include <span>
#include <string_view>

namespace blush {

struct GltfDocument {
    Json root;
    GltfIndices indices;
    std::vector<uint8_t> added; // what the buffer that saving adds will hold
    int added_buffer = -1;      // its index; -1: there is none yet

    // root[list], made if it is not there. The lists of lights go by the names of their extensions.
    Json& list(std::string_view name);
    // nullptr if it is not there.
    Json* find_list(std::string_view name);
    Json& object(std::string_view list_name, int index) { return list(list_name)[size_t(index)]; }
    int append(std::string_view list_name, Json object);
    // A view of these bytes in the added buffer, aligned to 4 bytes. `target`: as glTF's bufferView.target, 0 for none.
    int append_view(std::span<const uint8_t> bytes, int target);
    // The scene that is shown, made if the document has none.
    Json& scene();
};

constexpr GltfLight::List light_lists[] = {GltfLight::List::punctual, GltfLight::List::area, GltfLight::List::measured};
std::string_view list_name(GltfLight::List list);
// The list is that of an extension, which it goes by the name of.
bool is_extension_list(std::string_view name);

// parent[key] as an object: what is there of another type is replaced.
Json& child(Json& parent, std::string_view key);
// Null if it is not there.
const Json& child_or_null(const Json& parent, std::string_view key);
void erase(Json& parent, std::string_view key);

// extras.blush, made if it is not there; extras that are no object are kept inside of the new ones as "value".
Json& blush_of(Json& object);
// Takes an entry out of extras.blush, and what is empty then.
void erase_blush(Json& object, std::string_view key);
Json& extension_of(Json& object, std::string_view name);
void erase_extension(Json& object, std::string_view name);

// The shortest number that reads back as this float.
Json json_number(float value);
// Each leaves alone what already reads as the value, and what is absent and would read as `otherwise`.
void set_number(Json& object, std::string_view key, float value, float otherwise);
void set_vector(Json& object, std::string_view key, std::initializer_list<float> values, std::initializer_list<float> otherwise);
void set_flag(Json& object, std::string_view key, bool value);
// A reference to another object by index; negative: none.
void set_index(Json& object, std::string_view key, int index);

} // namespace blush
