#include "render/film/film_columns.h"

namespace blush {

void fit_columns(TileScratch& s, const Film& film) {
    if (film.needs_first_hits() && !s.first) s.first = std::make_unique<FirstHitColumns>();
    if (!film.needs_first_hits()) s.first.reset();
    const int bounces = film.needs_bounces();
    if (bounces == 0)
        s.bounces.reset();
    else if (!s.bounces || int(s.bounces->after.size()) != bounces)
        s.bounces = std::make_unique<BounceColumns>(bounces);
    const int groups_needed = film.needs_groups();
    if (groups_needed == 0)
        s.groups.reset();
    else if (!s.groups || s.groups->count() != groups_needed || s.groups->direct.empty() == film.needs_direct_groups())
        s.groups = std::make_unique<GroupColumns>(groups_needed, film.needs_direct_groups());
    if (!film.needs_strategies())
        s.strategies.reset();
    else if (!s.strategies || s.strategies->light.direct.empty() == film.needs_direct_strategies())
        s.strategies = std::make_unique<StrategyColumns>(film.needs_direct_strategies());
    if (film.needs_roulette() && !s.roulette) s.roulette = std::make_unique<RouletteColumns>();
    if (!film.needs_roulette()) s.roulette.reset();
}

} // namespace blush
