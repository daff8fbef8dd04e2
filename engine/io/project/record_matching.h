// Internal to merge_edits.cpp: matches the records of two scenes by name.
#pragma once

#include "scene/scene.h"

#include <string>
#include <unordered_map>

namespace blush {

// Maps ids of one scene to the other; ids without a match map to none.
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

// Maps the records of `from` to those of `to`.
RecordMap match_records(const Scene& from, const Scene& to);

// Names from the root down: "Room/Lamp/Bulb".
std::string path_of(const Scene& scene, Id<Node> node);

} // namespace blush
