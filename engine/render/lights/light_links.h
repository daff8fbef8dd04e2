// Light and shadow linking: which objects a light illuminates, and which cast its shadows.
#pragma once

#include "render/compile/scene_tables.h"
#include "render/lights/light_table.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace blush {

class GeometryPool;

// True if the set lists the node or an ancestor of it; for exclusion sets, if it does not.
bool contains(const ObjectSet& set, const Scene& scene, Id<Node> node);
// Removes a node from the set or adds it. A node included through an
// ancestor cannot be removed alone: then the ancestor is toggled.
void toggle(ObjectSet& set, const Scene& scene, Id<Node> node);
// True if an existing node is excluded.
bool leaves_out(const ObjectSet& set, const Scene& scene);

// True if some light excludes an object from its illumination or its shadow casters.
bool has_links(const Scene& scene);

// Embree's rays have 32 mask bits: one for the camera's rays, one for all others, one for shadow catchers (shadow_catcher.h), and
// one for each set of shadow casters.
constexpr int max_caster_sets = 29;

// The distinct sets of shadow casters of a scene's lights.
class CasterSets {
public:
    CasterSets() = default;
    explicit CasterSets(const Scene& scene);
    // `nodes`: those with lights (expanded_lights.h).
    CasterSets(const Scene& scene, const std::vector<Id<Node>>& nodes);
    bool operator==(const CasterSets&) const = default;

    // The mask bits of an object for shadow rays: the sets that contain it.
    uint32_t mask_of(const Scene& scene, Id<Node> object) const;
    // The mask of a shadow ray towards the light.
    uint32_t ray_mask(const Scene& scene, const Light& light) const;
    // Lights whose set exceeds the limit: everything casts their shadows.
    int left_out() const { return left_out_; }

private:
    std::vector<ObjectSet> sets_;
    int left_out_ = 0;
};

// The links of a light table, by record.
struct LightLinks {
    std::vector<int32_t> lit_sets;      // index of the set that the light illuminates; -1: everything
    std::vector<uint32_t> lit_parts;    // for each set, one bit per part
    std::vector<uint32_t> shadow_masks; // of rays towards the light
    int32_t words = 0;                  // 32-bit words per set
    std::vector<ObjectSet> sets;        // those of lit_parts
    bool empty() const { return lit_sets.empty(); }

    LinkTables tables() const { return {lit_sets.data(), lit_parts.data(), shadow_masks.data(), words}; }
};
// Empty if no light is linked. `last`: links of the same parts, whose sets are copied instead of asking every part.
LightLinks build_light_links(const Scene& expanded, const LightTable& lights, const GeometryPool& geometry, const CasterSets& casters,
                             const LightLinks& last = {});

} // namespace blush
