// Which lights shine: mute and solo, said once for rendering and for whoever shows it.
#pragma once

#include "scene/scene.h"

namespace blush {

// It has a glow to mute or to make solo. What is unlit is a picture of something, no light.
inline bool has_glow(const Material& m) { return m.emissive != Vec3{0, 0, 0} && !m.unlit; }

// A light on some node, a glowing material that some node wears, or the environment is solo, muted or hidden though it may be. Then nothing
// else shines. Records that no node carries any more do not count.
bool any_solo(const Scene& scene);
// Mute wins over solo. `some_solo`: what any_solo says of the scene.
inline bool shines(const Light& light, bool some_solo) { return light.enabled && (light.solo || !some_solo); }
inline bool shines(const Material& m, bool some_solo) { return has_glow(m) && m.emits && m.emissive_strength > 0 && (m.solo || !some_solo); }
inline bool shines(const Environment& e, bool some_solo) {
    return e.kind != Environment::Kind::none && e.lights_scene && (e.solo || !some_solo);
}

// The scene with mute and solo spelled out: lights that do not shine are off, emission that does not is black, and so is the environment where
// something else is solo. It renders as `scene` does, and asks of whoever lowers it further only whether a light is on.
Scene with_solo_applied(const Scene& scene);

} // namespace blush
