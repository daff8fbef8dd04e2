// Computes what changed between two scenes by comparing values; no dirty flags are kept.
#pragma once

#include "scene/render_settings.h"
#include "scene/scene.h"

#include <vector>

namespace blush {

struct Changes {
    bool view = false; // pose or lens; ignores the pivot, and the focus distance of a pinhole
    bool resolution = false;
    bool integrator = false;  // bounces, Russian roulette, strategy, filter, seed, first sample, energy compensation
    bool nee_changed = false; // NEE was switched on or off (Strategy::bsdf), or MIS compensation
    bool stop_rules = false;
    bool environment_parameters = false; // colour, intensity, rotation, visibility
    bool environment_image = false;      // kind or pixels
    std::vector<Id<Node>> transforms;    // local transform or parent changed
    std::vector<Id<Node>> moved_meshes;  // nodes with a mesh that moved with these
    std::vector<Id<Node>> structure;     // node added, removed, shown, hidden; its mesh, deformation, light or instances changed
    bool motion = false;                 // clip, time, shown scene, or a skin
    std::vector<Id<Mesh>> meshes;        // geometry or material slot of a part changed; parts added or removed
    std::vector<Id<Material>> materials;
    std::vector<Id<Texture>> textures;
    std::vector<Id<Light>> lights;
    bool mix = false; // light mix: grouping, group names, gains

    bool any() const;
    // True if samples accumulated so far do not show the new scene.
    bool affects_image() const;
    // True if of all that the image shows only the view changed.
    bool only_view() const;
    // True if only lights, materials, environment parameters and the mix changed: no geometry moved.
    bool only_light() const;
};

// Compares two scenes and their settings. A changed name counts only where light groups are named by it: names do not reach the
// image. Payloads are compared by serial number, not by content; tables with shared storage are skipped.
Changes diff(const Scene& before, const RenderSettings& before_settings, const Scene& after, const RenderSettings& after_settings);

} // namespace blush
