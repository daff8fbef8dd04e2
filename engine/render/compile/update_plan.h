// The update policy in one place: maps changes to required updates.
#pragma once

#include "scene/changes.h"

#include <vector>

namespace blush {

struct UpdatePlan {
    bool objects = false;                    // rebuild the object list; their geometry may have changed
    bool transforms = false;                 // some objects moved, other than the meshes of area lights
    std::vector<Id<Node>> moved_area_lights; // nodes of meshes of area lights that moved; empty if all objects are updated anyway
    bool all_materials = false;              // the set of materials or textures in use may have changed
    std::vector<Id<Material>> materials;     // rewrite these records
    bool lights = false;                     // light records and probabilities; those of emissive meshes only if the meshes need it
    bool environment_map = false;            // texels and importance map
    bool environment_parameters = false;
    bool camera = false;
    bool clear_film = false;
    bool features = false; // another kernel may be selected

    bool operator==(const UpdatePlan&) const = default;
};

// From changes of the scene (with expanded area lights) to required updates; a pure function.
UpdatePlan plan(const Changes& changes);
// Everything, for the first build.
UpdatePlan full_plan();

} // namespace blush
