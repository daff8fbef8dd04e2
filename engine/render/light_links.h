// Light and shadow linking: which objects a light lights, and which stand in its way.
#pragma once

#include "render/light_table.h"
#include "render/scene_tables.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace blush {

class GeometryPool;

// A node of the set, or below one - or, of a set of all but some, none of those.
bool contains(const ObjectSet& set, const Scene& scene, Id<Node> node);
// Takes a node out of the set, or in again. Of what an ancestor stands for, nothing can be taken out alone: then the ancestor changes sides.
void toggle(ObjectSet& set, const Scene& scene, Id<Node> node);
// It leaves somebody out: nodes that are gone do not count.
bool leaves_out(const ObjectSet& set, const Scene& scene);

// Some light leaves somebody out, of what it lights or of what casts its shadows.
bool has_links(const Scene& scene);

// Embree's rays carry 32 bits: one of the camera's, one of all others, one of shadow catchers (shadow_catcher.h), and one for each set of objects that cast the shadows of some light.
constexpr int most_caster_sets = 29;

// The distinct sets of shadow casters of a scene's lights.
class CasterSets {
public:
    CasterSets() = default;
    explicit CasterSets(const Scene& scene);

    // The bits by which shadow rays meet an object: which sets have it.
    uint32_t mask_of(const Scene& scene, Id<Node> object) const;
    // What a shadow ray towards the light asks for.
    uint32_t ray_mask(const Scene& scene, const Light& light) const;
    // Lights whose set found no place: everything casts their shadows.
    int left_out() const { return left_out_; }

private:
    std::vector<ObjectSet> sets_;
    int left_out_ = 0;
};

// The links of a light table, by record.
struct LightLinks {
    std::vector<int32_t> lit_sets;       // index of the set that the light lights; -1: everything
    std::vector<uint32_t> lit_parts;     // of each set, a bit for each part
    std::vector<uint32_t> shadow_masks;  // of rays towards the light
    int32_t words = 0;                   // of a set's bits
    bool empty() const { return lit_sets.empty(); }

    LinkTables tables() const { return {lit_sets.data(), lit_parts.data(), shadow_masks.data(), words}; }
};
// Empty if every light lights everything and everything casts its shadow.
LightLinks build_light_links(const Scene& lowered, const LightTable& lights, const GeometryPool& geometry, const CasterSets& casters);

} // namespace blush
