// The materials of rendered objects, and the tables that they need: found once per material instead of once per part.
#pragma once

#include "render/compile/object_list.h"
#include "render/lights/missing_light.h"
#include "render/materials/material_table.h"

#include <set>
#include <vector>

namespace blush {

struct UsedMaterials {
    // All lists are in id order, each id once; 0 is glTF's default material.
    std::vector<Id<Material>> ids;
    std::vector<Id<Material>> alpha;             // not opaque
    std::vector<Id<Material>> emissive;          // their triangles are lights
    std::vector<Id<Material>> casters;           // cast caustics, by their factors alone
    std::vector<Id<Material>> weak_casters;      // weak reflectors (Smoothness::reflects_weakly), by their factors alone
    std::vector<Id<Material>> smooth_by_texture; // in neither of these lists, nor in `smooth`: see PartSmoothness
    std::set<int> uv_sets;                       // that their textures read
    bool tangents = false;
    bool blends = false;     // some is neither opaque nor masked
    bool panes = false;      // light may pass one straight through (thin_transmission.h)
    bool lambertian = false; // some surface may be
    Features features;
    SmoothSurfaces smooth;
};

// The materials of the parts of `objects`.
std::vector<Id<Material>> material_ids_of(const std::vector<SceneObject>& objects);
UsedMaterials describe(std::vector<Id<Material>> ids, const Scene& scene, const MaterialTable& table);

} // namespace blush
