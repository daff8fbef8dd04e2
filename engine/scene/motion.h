// What moves in a scene: vertices that follow joints and morph targets, and the clips that lead nodes through time.
//
// Nodes keep their place at rest; where a clip has them at a moment is computed whenever somebody asks (scene/pose.h), so that going
// back to rest, undoing and saving need nothing.
#pragma once

#include "core/vec.h"
#include "scene/cow.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace blush {

struct Node;

// What a weight of 1 adds to the vertices of a mesh. Each array is empty or has an element per vertex.
struct MorphTarget {
    std::vector<Vec3> positions, normals, tangents;
};
using MorphTargetPtr = std::shared_ptr<const MorphTarget>;

// How much of a vertex follows a joint.
struct Influence {
    uint16_t joint = 0; // index into the skin's joints
    float weight = 0;
};

// The skeleton that a node's mesh hangs on. The mesh is where the joints are; the node's own transform does not move it (glTF 2.0, 3.7.3.3).
struct Skin {
    std::string name;
    std::vector<Id<Node>> joints;        // none: one that is not in the scene, which stays where the world's origin is
    std::vector<Affine> joint_from_mesh; // inverse bind matrices, one per joint
    bool operator==(const Skin&) const = default;
};

// One property over time.
struct Keyframes {
    enum class Interpolation : uint8_t { step, linear, cubic_spline };
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  // seconds from 0, not falling, at least one
    std::vector<float> values; // per time one value of as many floats as the property has; of a cubic spline in-tangent, value, out-tangent
};
using KeyframesPtr = std::shared_ptr<const Keyframes>;

// What a clip does to one property of a node.
struct Channel {
    enum class Property : uint8_t { translation, rotation, scale, morph_weights };
    Id<Node> node;
    Property property = Property::translation;
    KeyframesPtr keyframes;
    bool operator==(const Channel&) const = default;
};

// An animation of a file.
struct Clip {
    std::string name;
    float seconds = 0;             // until the last keyframe
    std::vector<Channel> channels; // by node and property, each pair once
    bool operator==(const Clip&) const = default;
};

// What is chosen of what a file offers: a moment of one of its animations, one of its scenes, one of its sets of materials.
struct Staging {
    Id<Clip> clip = {};   // none: everything at rest
    float seconds = 0;    // since the clip's beginning
    int32_t scene = 0;    // index into Scene::scene_names; nodes of others are hidden
    int32_t variant = -1; // index into Scene::variants (KHR_materials_variants); -1: none
    bool operator==(const Staging&) const = default;
};

} // namespace blush
