// Which lights share a plane of the film, for the light mix: groups made by light, object, material or by hand.
#pragma once

#include "scene/scene.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// Planes: 48 bytes per pixel each in the film, 12 in a frame.
constexpr int most_light_groups = 16;

struct LightGroup {
    std::string name;                         // no other group has it
    std::vector<Id<Light>> lights = {};       // whose light it holds, each once
    std::vector<Id<Material>> materials = {}; // of surfaces that glow
    bool environment = false;
    bool unlit = false; // surfaces with KHR_materials_unlit, which show and do not shine: there is nothing to scale
    bool operator==(const LightGroup&) const = default;
};

// One gain per group, RGB: what its plane is multiplied with.
using Gains = std::vector<Vec3>;

struct LightGroups {
    std::vector<LightGroup> groups; // one for each plane, at most most_light_groups
    int sharing = 0;                // how many groups share the last plane because there were too many; 0: each has its own
    Scene base;                     // whose emission the planes hold

    // Of the light on a node, of a surface of a node's own mesh, of the environment; every emitter of `base` has one.
    int of_light(Id<Node> node) const;
    int of_surface(Id<Node> node, Id<Material> material) const;
    int of_environment() const { return environment; }

    std::map<Id<Node>, int> light_nodes, surface_nodes;
    std::map<Id<Material>, int> surface_materials; // where groups are not made by objects
    int environment = 0;
};

// Of all that may shine in the scene, off or on: lights and glowing surfaces of visible nodes, and the environment. By light: each light,
// each glowing object; by object: each node; by material: each light, each glowing material; by hand: what names the same group, glowing
// surfaces by their material's name. If there are more than `most`, those that have a channel in the mix come first, the last ones share a
// plane. Scenes with area lights lowered have the groups that they had before.
LightGroups make_light_groups(const Scene& scene, int most = most_light_groups);

// What a group's channel makes of its light; 1 without one.
Vec3 channel_gain(const LightMix& mix, const std::string& group);

// The mix of a scene, as the planes of another one's light must be mixed to show it.
struct Mixing {
    std::vector<std::string> names; // of the groups, as they are called by now
    Gains factors;                  // what has become of the light of their members
    Gains channels;                 // what their channels make of it
    Gains gains;                    // both together
};
// Channels of the mix times what has changed in the light of each group's members. Nothing, if no gains would do: something else has
// changed, a colour was black and is no longer, members of a group changed differently, or groups are made up otherwise.
std::optional<Mixing> mixing_of(const LightGroups& groups, const Scene& now);

} // namespace blush
