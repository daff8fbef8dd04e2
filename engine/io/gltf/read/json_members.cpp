#include "io/gltf/read/json_members.h"

namespace blush {

const ParsedGltf& gltf_member(const ParsedGltf& object, std::string_view key) {
    static const ParsedGltf null;
    const auto it = object.find(key);
    return it == object.end() ? null : *it;
}

const ParsedGltf& gltf_element(const ParsedGltf& list, size_t index) {
    static const ParsedGltf null;
    return list.is_array() && index < list.size() ? list[index] : null;
}

const ParsedGltf& gltf_light(const ParsedGltf& root, std::string_view extension, size_t index) {
    return gltf_item(gltf_member(gltf_member(root, "extensions"), extension), "lights", index);
}

} // namespace blush
