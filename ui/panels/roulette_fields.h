// Rows that the Render panel and the Roulette lab share.
#pragma once

#include "scene/render_settings.h"
#include "ui/widgets.h"

namespace blush {

void draw_roulette_fields(Fields& f, Roulette& roulette);
// How often light may be scattered.
void draw_bounce_limit_fields(Fields& f, RenderSettings& settings);

} // namespace blush
