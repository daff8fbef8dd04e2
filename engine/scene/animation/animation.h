// Animation data of a scene: skins, morph targets, and clips that animate nodes.
// Nodes store their rest pose; animated poses are computed on demand (scene/animation/pose.h). Undo, saving and returning to rest therefore
// need no extra state.
#pragma once

#include "core/vec.h"
#include "scene/cow.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace blush {

struct Node;

// Offsets that a morph weight of 1 adds to the vertices of a mesh. Each array is empty or has one element per vertex.
struct MorphTarget {
    std::vector<Vec3> positions, normals, tangents;
};
using MorphTargetPtr = std::shared_ptr<const MorphTarget>;

// Skinning weight of a joint on a vertex.
struct Influence {
    uint16_t joint = 0; // index into the skin's joints
    float weight = 0;
};

// Skeleton of a node's mesh. The joints place the mesh; the transform of the node is ignored (glTF 2.0, 3.7.3.3).
struct Skin {
    std::string name;
    std::vector<Id<Node>> joints;        // none: a joint that is not in the scene, fixed at the world origin
    std::vector<Affine> joint_from_mesh; // inverse bind matrices, one per joint
    bool operator==(const Skin&) const = default;
};

// Keyframes of one property.
struct Keyframes {
    enum class Interpolation : uint8_t { step, linear, cubic_spline };
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  // seconds >= 0, non-decreasing, at least one
    std::vector<float> values; // one value per time, of as many floats as the property has; spline: in-tangent, value, out-tangent
};
using KeyframesPtr = std::shared_ptr<const Keyframes>;

// Animation of one property of a node.
struct Channel {
    enum class Property : uint8_t { translation, rotation, scale, morph_weights };
    Id<Node> node;
    Property property = Property::translation;
    KeyframesPtr keyframes;
    bool operator==(const Channel&) const = default;
};

// An animation clip.
struct Clip {
    std::string name;
    float seconds = 0;             // time of the last keyframe
    std::vector<Channel> channels; // sorted by node and property, each pair once
    bool operator==(const Clip&) const = default;
};

// Scene selection: the chosen animation clip and time, scene and material variant of a file.
struct SceneSelection {
    Id<Clip> clip = {};   // none: rest pose
    float seconds = 0;    // from the start of the clip
    int32_t scene = 0;    // index into Scene::scene_names; nodes of others are hidden
    int32_t variant = -1; // index into Scene::variants (KHR_materials_variants); -1: none
    bool operator==(const SceneSelection&) const = default;
};

} // namespace blush
