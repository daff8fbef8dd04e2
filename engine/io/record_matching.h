// Internal to merge_edits.cpp: which record of one scene is which of another, by what they are called.
#pragma once

#include "scene/scene.h"

#include <string>
#include <unordered_map>

namespace blush {

// Ids of one scene and the other's; ids without a partner name nothing there.
template <class T> struct IdMap {
    std::unordered_map<uint32_t, uint32_t> to;

    Id<T> operator()(Id<T> id) const {
        const auto it = to.find(id.value);
        return it == to.end() ? Id<T>{} : Id<T>{it->second};
    }
};

struct RecordMap {
    IdMap<Node> nodes;
    IdMap<Mesh> meshes;
    IdMap<Material> materials;
    IdMap<Texture> textures;
    IdMap<Light> lights;
    IdMap<Camera> cameras;
    IdMap<Skin> skins;
    IdMap<Clip> clips;
};

// From the records of `from` to those of `to`.
RecordMap match_records(const Scene& from, const Scene& to);

// "Room/Lamp/Bulb": names from the root down.
std::string path_of(const Scene& scene, Id<Node> node);

} // namespace blush
