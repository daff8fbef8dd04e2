// What changed between two scenes, computed by comparing values, never remembered by setters.
#pragma once

#include "scene/render_settings.h"
#include "scene/scene.h"

#include <vector>

namespace blush {

struct Changes {
    bool view = false;        // pose or lens; neither the pivot nor the focus of a pinhole is seen
    bool resolution = false;
    bool integrator = false;  // bounces, roulette, strategy, filter, seed, first sample, energy compensation
    bool aiming = false;      // lights are sampled now and were not, or the other way round: Strategy::bsdf
    bool stop_rules = false;
    bool environment_parameters = false; // colour, intensity, rotation, visibility
    bool environment_image = false;      // kind or pixels
    std::vector<Id<Node>> transforms;    // local transform or parent changed
    std::vector<Id<Node>> structure;     // node added, removed, shown, hidden, or given another mesh, shape, light or other places for copies
    bool motion = false;                 // clip, moment, which of the file's scenes is shown, or a skeleton
    std::vector<Id<Mesh>> meshes;        // geometry of a part changed, parts added or removed, material slot of a part changed
    std::vector<Id<Material>> materials;
    std::vector<Id<Texture>> textures;
    std::vector<Id<Light>> lights;
    bool mix = false; // of lights: how groups are made, what they are called, what they are multiplied with

    bool any() const;
    // There is something that an image already accumulated does not show.
    bool affects_image() const;
    // Nothing but lights, materials, the environment's parameters and the mix, none of which moves anything.
    bool only_light() const;
};

// Names of nodes, materials, lights, ... are not changes but where groups of the light mix go by them: they do not reach the image. Payloads are compared by serial, never by content;
// tables that share storage cost nothing.
Changes diff(const Scene& before, const RenderSettings& before_settings, const Scene& after, const RenderSettings& after_settings);

} // namespace blush
