// Where light paths and manifold sampling cannot be used.
#pragma once

#include "render/film/film_size.h"
#include "scene/render_settings.h"

namespace blush {

class RenderScene;

// Why they cannot be used or gain nothing; null if they may.
const char* why_no_caustics(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film);

} // namespace blush
