// Where strategies for caustics cannot be used.
#pragma once

#include "render/film/film_size.h"
#include "scene/render_settings.h"

namespace blush {

class RenderScene;

// Why light paths and manifold sampling cannot be used or gain nothing; null if they may.
const char* why_no_caustics(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film);

// Why the settings exclude this strategy; null if they do not.
inline const char* why_excluded(const RenderSettings& settings, CausticStrategy strategy) {
    if (settings.caustics == CausticStrategy::automatic || settings.caustics == strategy) return nullptr;
    return settings.caustics == CausticStrategy::off ? "strategies for caustics are switched off"
                                                     : "another strategy for caustics is chosen";
}

} // namespace blush
