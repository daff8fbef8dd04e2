// Rows of the light table: all lights and emissive materials, by group. Pure.
#pragma once

#include "render/light_mix/light_mix.h"
#include "scene/document/edit.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush {

// A light on a node, an emissive material, or the environment: exactly one of the three.
struct LightRow {
    Id<Node> node; // for a material: the first visible node that uses it; for the environment: null
    Id<Light> light;
    Id<Material> material;
    bool environment = false;
    std::string name, type;
    float intensity = 0; // in `unit`; for a material its emissive strength, for an image or sky its multiplier
    const char* unit = "";
    bool on = true, solo = false;
    bool enabled = true; // not muted
};
struct LightRows {
    std::string group; // "": ungrouped; these rows come last
    std::vector<LightRow> rows;
};
// Lights in the order of the nodes, then materials, then the environment; groups sorted by name.
std::vector<LightRows> light_rows(const Scene& scene);

// Edits that toggle mute or solo of a row.
Edit with_switches(const Scene& scene, const LightRow& row, bool on, bool solo);

// Contribution of a row to an image rendered with light groups; known only per group.
struct RowShare {
    std::optional<double> energy, noise; // fractions of the image's luminance and of its noise variance, 0 .. 1; nullopt: not known yet
    bool alone = false;                  // the only light in its group; otherwise the values are those of the whole group
};
// `reports`: of the frame's groups. nullopt for a light added after the frame.
std::optional<RowShare> share_of(const LightRow& row, const LightGroups& groups, std::span<const GroupReport> reports);

// Edits that put lights (and optionally the environment) into a group; "" removes them from their group.
std::vector<Edit> put_into_group(const Scene& scene, std::span<const Id<Light>> lights, bool environment, const std::string& group);
// Edits that rename a group.
std::vector<Edit> rename_group(const Scene& scene, const std::string& group, const std::string& name);

} // namespace blush
