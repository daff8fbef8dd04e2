// What the light table lists: everything that shines, by its group. Pure.
#pragma once

#include "render/frame.h"
#include "scene/edit.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush {

// A light on a node, a material that glows, or the environment: exactly one of the three.
struct LightRow {
    Id<Node> node; // of a material: the first visible one that wears it; of the environment: none
    Id<Light> light;
    Id<Material> material;
    bool environment = false;
    std::string name, type;
    float intensity = 0; // in `unit`; of a material its strength, of an environment that is no colour its factor
    const char* unit = "";
    bool on = true, solo = false;
    bool shines = true; // nothing mutes it
};
struct LightRows {
    std::string group; // "": of those in none, which come last
    std::vector<LightRow> rows;
};
// In the order of the nodes, then materials, then the environment; groups by name.
std::vector<LightRows> light_rows(const Scene& scene);

// Edits that put lights (and the environment, if asked) into a group; "" takes them out.
std::vector<Edit> put_into_group(const Scene& scene, std::span<const Id<Light>> lights, bool environment, const std::string& group);
// Edits that give a group another name, its channel of the light mix included.
std::vector<Edit> rename_group(const Scene& scene, const std::string& group, const std::string& name);

} // namespace blush
