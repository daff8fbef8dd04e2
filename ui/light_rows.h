// What the light table lists: everything that shines, by its group. Pure.
#pragma once

#include "render/light_mix.h"
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

// Mutes or unmutes what a row stands for, and begins or ends its solo.
Edit with_switches(const Scene& scene, const LightRow& row, bool on, bool solo);

// What a row's light gives to a picture that keeps groups of lights apart, as far as its group tells.
struct RowShare {
    double energy = 0, noise = 0; // of the image's luminance and of the variance of its noise, 0 .. 1
    bool alone = false;           // nothing else is in its group; else the shares are the group's
};
// `reports`: of these groups. Nothing for a light that came after them.
std::optional<RowShare> share_of(const LightRow& row, const LightGroups& groups, std::span<const GroupReport> reports);

// Edits that put lights (and the environment, if asked) into a group; "" takes them out.
std::vector<Edit> put_into_group(const Scene& scene, std::span<const Id<Light>> lights, bool environment, const std::string& group);
// Edits that give a group another name.
std::vector<Edit> rename_group(const Scene& scene, const std::string& group, const std::string& name);

} // namespace blush
