// Visibility of lights: evaluates mute and solo for the renderer and the UI.
#pragma once

#include "scene/scene.h"

namespace blush {

// True if the material is emissive, so that it can be muted or solo. Unlit materials are not lights.
inline bool has_emission(const Material& m) { return m.emissive != Vec3{0, 0, 0} && !m.unlit; }

// True if a light, an emissive material or the environment is solo, even if it is muted or hidden. Then only solo emitters emit.
// Lights and materials that no node uses are ignored.
bool any_solo(const Scene& scene);
// True if the emitter emits. Mute takes precedence over solo. `some_solo`: result of any_solo.
inline bool emits_light(const Light& light, bool some_solo) { return light.enabled && (light.solo || !some_solo); }
inline bool emits_light(const Material& m, bool some_solo) {
    return has_emission(m) && m.emits && m.emissive_strength > 0 && (m.solo || !some_solo);
}
inline bool emits_light(const Environment& e, bool some_solo) {
    return e.kind != Environment::Kind::none && e.lights_scene && (e.solo || !some_solo);
}

// The scene with mute and solo applied: muted lights are disabled, muted emission is black, and so is the environment if another
// emitter is solo. Renders the same as `scene`; later stages only need to test Light::enabled.
Scene with_solo_applied(const Scene& scene);

} // namespace blush
