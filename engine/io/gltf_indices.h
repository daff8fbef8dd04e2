// Which object of a glTF document each record of a scene was read from: what saving needs to write it back there.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// Lights are in the list of one of three extensions: KHR_lights_punctual, EXT_lights_area or, those with a measured distribution,
// EXT_lights_ies. Of the last, several may be at one index: nodes say in which strength and colour.
struct GltfLight {
    enum class List : uint8_t { punctual, area, measured };
    List list = List::punctual;
    int index = 0;
    bool operator==(const GltfLight&) const = default;
};

struct GltfIndices {
    std::map<Id<Node>, int> nodes;
    std::map<Id<Mesh>, int> meshes;
    std::map<Id<Material>, int> materials;
    std::map<Id<Texture>, int> textures;
    std::map<Id<Camera>, int> cameras;
    std::map<Id<Skin>, int> skins;
    std::map<Id<Clip>, int> clips;
    std::map<Id<Light>, GltfLight> lights;
    std::map<int, float> profile_peaks; // by index in EXT_lights_ies: the largest candela of those profiles that were read
    ImagePtr image_light; // the scene's environment as EXT_lights_image_based has it; null: it has none that is shown
    std::map<Id<Mesh>, std::vector<int>> primitives; // of each part of a mesh: primitives without triangles are no parts
};

// The other way round, none where a record is not in the scene. `count` objects.
template <class T> std::vector<Id<T>> ids_by_index(const std::map<Id<T>, int>& indices, size_t count) {
    std::vector<Id<T>> ids(count);
    for (const auto& [id, index] : indices)
        if (size_t(index) < count) ids[size_t(index)] = id;
    return ids;
}

// The document that a scene came from. Copies are cheap.
struct GltfOrigin {
    std::filesystem::path file;
    std::shared_ptr<const std::string> json; // its text, as it was read
    GltfIndices indices;
    // Triangles, pixels and places of copies that the document has already.
    Table<Mesh> meshes;
    Table<Texture> textures;
    Table<Node> nodes;
};

} // namespace blush
