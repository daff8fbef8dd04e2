// Settings of renders that the labs compare.
#pragma once

#include "scene/render_settings.h"

namespace blush {

// Scaled to at most `longest` pixels on its longer side; without what makes samples of one image depend on each other or on the time:
// clamping, adaptive sampling.
RenderSettings lab_settings(RenderSettings settings, int longest);
// Those, for the path tracer alone: without region, strategies for caustics, path reuse and smooth edges.
RenderSettings plain_lab_settings(RenderSettings settings, int longest);

} // namespace blush
