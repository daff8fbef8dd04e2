// The whole update policy in one place: which kind of change costs what.
#pragma once

#include "scene/changes.h"

#include <vector>

namespace blush {

struct UpdatePlan {
    bool objects = false;            // list the objects anew; what they are made of may have changed
    bool transforms = false;         // some objects moved
    bool all_materials = false;      // the set of materials or textures in use may have changed
    std::vector<Id<Material>> materials; // rewrite these records
    bool lights = false;             // light records and probabilities
    bool environment_map = false;    // texels and importance map
    bool environment_parameters = false;
    bool camera = false;
    bool clear_film = false;
    bool features = false;           // another kernel may fit better

    bool operator==(const UpdatePlan&) const = default;
};

// A pure table, from what changed in the scene (with area lights lowered to meshes) to what must be redone.
UpdatePlan plan(const Changes& changes);
// Everything: the first time.
UpdatePlan full_plan();

} // namespace blush
