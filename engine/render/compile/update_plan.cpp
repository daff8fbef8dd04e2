#include "render/compile/update_plan.h"

#include "render/compile/expanded_lights.h"

#include <algorithm>

namespace blush {

UpdatePlan plan(const Changes& c) {
    UpdatePlan p;
    p.objects = !c.structure.empty() || !c.meshes.empty();
    p.transforms = p.objects || !std::ranges::all_of(c.moved_meshes, is_expanded);
    if (!p.transforms) p.moved_area_lights = c.moved_meshes;
    p.all_materials = p.objects || !c.textures.empty();
    if (!p.all_materials) p.materials = c.materials;
    p.environment_map = c.environment_image || c.nee_changed;
    p.environment_parameters = c.environment_parameters || p.environment_map;
    // A moving object may be an emitter, and changes the scene bounds, which scale the sky's power.
    p.lights = p.transforms || !c.transforms.empty() || p.all_materials || !c.materials.empty() || !c.lights.empty() ||
               p.environment_parameters || c.mix;
    p.camera = c.view || c.resolution;
    p.clear_film = c.affects_image();
    p.features = p.lights || c.view || c.integrator;
    return p;
}

UpdatePlan full_plan() {
    UpdatePlan p;
    p.objects = p.transforms = p.all_materials = p.lights = true;
    p.environment_map = p.environment_parameters = p.camera = p.clear_film = p.features = true;
    return p;
}

} // namespace blush
