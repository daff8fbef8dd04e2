// Internal to io/gltf: a glTF document for editing. Parts that are not edited keep their position, spelling and meaning.
#pragma once

#include "core/vec.h"
#include "io/gltf/read/geometry/indices.h"
#include "io/project/json_fields.h"

#include <initializer_list>
#include <span>
#include <string_view>

namespace blush {

struct GltfDocument {
    Json root;
    GltfIndices indices;
    std::vector<uint8_t> added; // contents of the buffer that saving adds
    int added_buffer = -1;      // its index; -1: none yet

    // root[list], created if missing. Lists of lights are named by their extensions.
    Json& list(std::string_view name);
    // nullptr if missing.
    Json* find_list(std::string_view name);
    Json& object(std::string_view list_name, int index) { return list(list_name)[size_t(index)]; }
    int append(std::string_view list_name, Json object);
    // Appends bytes to the added buffer, aligned to 4, and a buffer view of them. `target`: glTF's bufferView.target, 0 for none.
    int append_view(std::span<const uint8_t> bytes, int target);
    // The default scene, created if missing.
    Json& scene();
};

constexpr GltfLight::List light_lists[] = {GltfLight::List::punctual, GltfLight::List::area, GltfLight::List::measured};
std::string_view list_name(GltfLight::List list);
// True if the list belongs to an extension, whose name it has.
bool is_extension_list(std::string_view name);

// parent[key] as an object; a value of another type is replaced.
Json& child(Json& parent, std::string_view key);
// JSON null if missing.
const Json& child_or_null(const Json& parent, std::string_view key);
void erase(Json& parent, std::string_view key);

// extras.blush, created if missing; extras that are not an object are kept as extras.value.
Json& blush_of(Json& object);
// Removes an entry of extras.blush, and the objects that become empty.
void erase_blush(Json& object, std::string_view key);
Json& extension_of(Json& object, std::string_view name);
void erase_extension(Json& object, std::string_view name);

// The shortest decimal number that reads back as this float.
Json json_number(float value);
// These do not change a member that already reads as the value, or a missing member whose default `otherwise` is the value.
void set_number(Json& object, std::string_view key, float value, float otherwise);
void set_vector(Json& object, std::string_view key, std::initializer_list<float> values, std::initializer_list<float> otherwise);
void set_flag(Json& object, std::string_view key, bool value);
// A reference to another object by index; negative: none.
void set_index(Json& object, std::string_view key, int index);

} // namespace blush
