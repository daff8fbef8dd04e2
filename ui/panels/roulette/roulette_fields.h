// Rows that the Render tab and the Roulette lab share.
#pragma once

#include "scene/render_settings.h"
#include "ui/widgets/widgets.h"

namespace blush {

void draw_roulette_fields(Fields& f, Roulette& roulette);
// The limit on the number of bounces.
void draw_bounce_limit_fields(Fields& f, RenderSettings& settings);

} // namespace blush
