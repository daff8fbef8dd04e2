// Groups of lights that share a film plane, for the light mix: by light, object, material or manual name.
#pragma once

#include "scene/changes.h"
#include "scene/scene.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// Each plane has 48 bytes per pixel in the film, 12 in a frame.
constexpr int max_light_groups = 16;

struct LightGroup {
    std::string name;                         // unique
    std::vector<Id<Light>> lights = {};       // members, each once
    std::vector<Id<Material>> materials = {}; // emissive materials
    bool environment = false;
    bool unlit = false; // surfaces with KHR_materials_unlit, which are visible but emit no light: cannot be scaled
    bool operator==(const LightGroup&) const = default;
};

// One RGB gain per group: factor of its plane.
using Gains = std::vector<Vec3>;

struct LightGroups {
    std::vector<LightGroup> groups; // one for each plane, at most max_light_groups
    int sharing = 0;                // how many groups share the last plane because of the limit; 0: each has its own
    Scene base;                     // the scene whose emission the planes hold

    // Group of the light on a node, of a surface of a node's own mesh, of the environment; every emitter of `base` has one.
    int of_light(Id<Node> node) const;
    int of_surface(Id<Node> node, Id<Material> material) const;
    int of_environment() const { return environment; }

    std::map<Id<Node>, int> light_nodes, surface_nodes;
    std::map<Id<Material>, int> surface_materials; // unless groups are made by object
    int environment = 0;
};

using LightGroupsPtr = std::shared_ptr<const LightGroups>;

// Groups of all possible emitters of the scene, switched off or on: lights and emissive surfaces of visible
// nodes, and the environment. By light: each light, each emissive object; by object: each node; by material:
// each light, each emissive material; by hand: lights with the same group name, and emissive surfaces by
// their material's group name. If there are more than `most`, those with a mix channel come first, and the
// last ones share a plane. Scenes with expanded area lights have the same groups as before expansion.
LightGroups make_light_groups(const Scene& scene, int most = max_light_groups);

// True if they differ at most in emission, name and solo.
bool same_but_for_emission(Material before, const Material& after);

// Gain of a group's channel; 1 without a channel.
Vec3 channel_gain(const LightMix& mix, const std::string& group);

// The mix of a scene, expressed for the planes of an earlier scene.
struct Mixing {
    std::vector<std::string> names; // current names of the groups
    Gains factors;                  // change of the members' emission
    Gains channels;                 // channel gains
    Gains gains;                    // factors times channels
};
// Mix channels times the changes of each group's emission. Empty if gains cannot express the change: something else changed, a
// colour was black and no longer is, members of a group changed differently, or the grouping changed.
// `changes`: from `groups.base` to `now`, or from any scene with a mixing for these groups: that one differs from the base in emission
// alone, so what has not changed since needs no comparison.
std::optional<Mixing> mixing_of(const LightGroups& groups, const Scene& now, const Changes& changes);
// The same for a caller that knows no such changes: compares the scenes.
std::optional<Mixing> compared_mixing(const LightGroups& groups, const Scene& now);

} // namespace blush
