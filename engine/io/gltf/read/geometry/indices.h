// Maps the records of a scene to the objects of its glTF document, so that saving writes them back there.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// A light is in the list of one of three extensions: KHR_lights_punctual, EXT_lights_area or, with an IES profile,
// EXT_lights_ies. Several lights may share an index of EXT_lights_ies, since nodes hold the strength and colour.
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
    std::map<int, float> profile_peaks;              // by index in EXT_lights_ies: peak candela of each profile that was read
    ImagePtr image_light;                            // environment of EXT_lights_image_based; null if none is used
    std::map<Id<Mesh>, std::vector<int>> primitives; // of each part of a mesh; primitives without triangles have no part
};

// Inverse map for `count` objects; none for objects without a record.
template <class T> std::vector<Id<T>> ids_by_index(const std::map<Id<T>, int>& indices, size_t count) {
    std::vector<Id<T>> ids(count);
    for (const auto& [id, index] : indices)
        if (size_t(index) < count) ids[size_t(index)] = id;
    return ids;
}

// The document that a scene was read from. Copies are cheap.
struct GltfOrigin {
    std::filesystem::path file;
    std::shared_ptr<const std::string> json; // its text as read
    GltfIndices indices;
    // Triangles, pixels and instance transforms that the document holds already.
    Table<Mesh> meshes;
    Table<Texture> textures;
    Table<Node> nodes;
};

} // namespace blush
