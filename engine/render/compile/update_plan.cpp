#include "render/compile/update_plan.h"

namespace blush {

UpdatePlan plan(const Changes& c) {
    UpdatePlan p;
    p.objects = !c.structure.empty() || !c.meshes.empty();
    p.transforms = p.objects || !c.transforms.empty();
    p.all_materials = p.objects || !c.textures.empty();
    if (!p.all_materials) p.materials = c.materials;
    p.environment_map = c.environment_image || c.nee_changed;
    p.environment_parameters = c.environment_parameters || p.environment_map;
    // A moving object may be an emitter, and changes the scene bounds, which scale the sky's power.
    p.lights = p.transforms || p.all_materials || !c.materials.empty() || !c.lights.empty() || p.environment_parameters || c.mix;
    p.camera = c.view || c.resolution;
    p.clear_film = c.affects_image();
    p.features = p.lights || c.view || c.integrator;
    return p;
}

UpdatePlan full_plan() { return {true, true, true, {}, true, true, true, true, true, true}; }

} // namespace blush
