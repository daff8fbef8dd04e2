// Which mesh parts rays meet, where, and which of them are traced through an instance: a function of the scene alone, so that a
// scene reached by edits is traced exactly as one that was just opened.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace blush {

struct SceneObject {
    Id<Node> node;
    std::vector<MeshPart> parts; // those with triangles
    Affined world_from_object;
    bool instanced = false;
    InstancesPtr instances = nullptr; // none: it is there once

    // Equal but for where it is.
    bool same_shape(const SceneObject& other) const;
    size_t triangle_count() const; // once
    size_t copies() const { return instances ? instances->node_from_copy.size() : 1; }
    Affined world_from_copy(size_t copy) const;
};

// Visible nodes with geometry, flat ones first, both in id order. A mesh is flattened into world space if one node uses it once and it is
// small enough to be rebuilt within a frame; transforms that are not finite leave their object out.
std::vector<SceneObject> list_objects(const Scene& scene);

} // namespace blush
