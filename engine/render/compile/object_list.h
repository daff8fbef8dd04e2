// Lists the mesh parts that are traced, their transforms, and which are instanced: a function of the scene alone, so that an
// edited scene is traced exactly like one that was just opened.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

struct SceneObject {
    Id<Node> node;
    std::vector<MeshPart> parts; // only those with triangles
    Affined world_from_object;
    bool instanced = false;
    InstancesPtr instances = nullptr; // null: one copy
    bool disabled = false;            // the mesh of a disabled light (expanded_lights.h): no ray hits it, and it has no extent
    std::vector<Affined> places = {}; // world transforms that replace both (baked_transforms.h); empty: unused

    // Equal except for the transforms.
    bool same_shape(const SceneObject& other) const;
    size_t triangle_count() const; // of one copy
    size_t copies() const { return places.empty() ? instances ? instances->node_from_copy.size() : 1 : places.size(); }
    bool same_place(const SceneObject& other) const { return world_from_object == other.world_from_object && places == other.places; }
    Affined world_from_copy(size_t copy) const;
};

// Visible nodes with geometry, flat ones first, both in id order. A mesh is flattened into
// world space if one node uses it once and it is small enough to be rebuilt within a frame.
// Objects with a non-finite transform are omitted, with a warning each in `left_out`.
std::vector<SceneObject> list_objects(const Scene& scene, std::vector<Diagnostic>* left_out = nullptr);
// "node "NAME"", or its number if it has no name.
std::string node_label(const Scene& scene, Id<Node> node);

} // namespace blush
