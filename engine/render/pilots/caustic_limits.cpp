#include "render/pilots/caustic_limits.h"

#include "render/compile/render_scene.h"

namespace blush {

const char* why_no_caustics(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film) {
    const SceneTables& tables = scene.tables();
    if (tables.emission_casters.count == 0) return "no smooth surface has light to focus";
    if (settings.strategy != Strategy::mis) return "light and BSDF sampling are not combined";
    if (settings.heuristic != MisHeuristic{}) return "MIS uses another heuristic than the power heuristic with exponent 2";
    if (settings.max_bounces != unlimited_bounces && settings.max_bounces < 2) return "paths end before light has been focused";
    if (film.planes.roulette) return "a view shows paths by their length";
    // Direct light by group is complete only after manifold sampling has added indirect light.
    if (film.groups > 0 && settings.clamp.limit > 0) return "the light mix is on and samples are clamped";
    if (film.catches) return "there is a shadow catcher";
    return nullptr;
}

} // namespace blush
