// Which lights shine: mute and solo, said once for rendering and for whoever shows it.
#pragma once

#include "scene/scene.h"

namespace blush {

// Some node carries a light that is solo, muted or hidden though it may be. Then nothing else shines: no other light, no emissive surface,
// no environment. Records that no node carries any more do not count.
bool any_solo(const Scene& scene);
// Mute wins over solo. `some_solo`: what any_solo says of the scene.
inline bool shines(const Light& light, bool some_solo) { return light.enabled && (light.solo || !some_solo); }

// The scene with solo spelled out: lights that do not shine are off, and where one is solo emission and environment are black. It renders
// as `scene` does, and asks of whoever lowers it further only whether a light is on.
Scene with_solo_applied(const Scene& scene);

} // namespace blush
