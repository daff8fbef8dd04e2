// Which mesh parts rays meet, where, and which of them are traced through an instance: a function of the scene alone, so that a
// scene reached by edits is traced exactly as one that was just opened.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

struct SceneObject {
    Id<Node> node;
    std::vector<MeshPart> parts; // those with triangles
    Affined world_from_object;
    bool instanced = false;
    InstancesPtr instances = nullptr; // none: it is there once
    std::vector<Affined> places = {};  // world transforms in place of both (baked_transforms.h); empty: none

    // Equal but for where it is.
    bool same_shape(const SceneObject& other) const;
    size_t triangle_count() const; // once
    size_t copies() const { return places.empty() ? instances ? instances->node_from_copy.size() : 1 : places.size(); }
    bool same_place(const SceneObject& other) const { return world_from_object == other.world_from_object && places == other.places; }
    Affined world_from_copy(size_t copy) const;
};

// Visible nodes with geometry, flat ones first, both in id order. A mesh is flattened into world space if one node uses it once and it is
// small enough to be rebuilt within a frame. Objects whose transform is not finite are left out, with a warning each in `left_out`.
std::vector<SceneObject> list_objects(const Scene& scene, std::vector<Diagnostic>* left_out = nullptr);
// "node "NAME"", or its number if it has no name.
std::string node_label(const Scene& scene, Id<Node> node);

} // namespace blush
