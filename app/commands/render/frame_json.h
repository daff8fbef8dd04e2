// Statistics of a finished frame, as JSON.
#pragma once

#include "app/commands/json_output.h"
#include "render/frame.h"
#include "scene/render_settings.h"

namespace blush {

// {nan, inf, negative, truncated, faults: [{kind, place, count}], first: [{cause, kind, place, vertex, x, y, sample, seed}],
// fireflies: [{excess, luminance, x, y, sample, seed}]}
OrderedJson health_json(const Health& health);
// [{bounce, share, mean}]
OrderedJson bounces_json(const Frame& frame);
// [{strategy, share, mean}]
OrderedJson strategies_json(const Frame& frame);
// [{group, energy, noise, gain}]: fractions of the image's luminance and variance, and the gain of the group
OrderedJson groups_json(const Frame& frame);
// {limit, light, samples, share, removed}
OrderedJson clamp_json(const Clamp& clamp, const ClampReport& report);

} // namespace blush
