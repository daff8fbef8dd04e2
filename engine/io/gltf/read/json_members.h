// Reads members of parsed JSON whose structure has not been checked.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string_view>

namespace blush {

using ParsedGltf = nlohmann::json; // a hash or tree map: lookups stay fast for hostile files

// Member or element; JSON null if missing or of the wrong type.
const ParsedGltf& gltf_member(const ParsedGltf& object, std::string_view key);
const ParsedGltf& gltf_element(const ParsedGltf& list, size_t index);
// root[list][index]
inline const ParsedGltf& gltf_item(const ParsedGltf& root, std::string_view list, size_t index) {
    return gltf_element(gltf_member(root, list), index);
}
// root.extensions[extension].lights[index]
const ParsedGltf& gltf_light(const ParsedGltf& root, std::string_view extension, size_t index);

} // namespace blush
