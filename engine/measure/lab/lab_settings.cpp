#include "measure/lab/lab_settings.h"

#include <algorithm>
#include <cmath>

namespace blush {

RenderSettings lab_settings(RenderSettings settings, int longest) {
    const double scale = std::min(1.0, double(longest) / std::max(settings.width, settings.height));
    settings.width = std::max(1, int(std::lround(settings.width * scale)));
    settings.height = std::max(1, int(std::lround(settings.height * scale)));
    settings.resolution_scale = 1;
    settings.first_sample = 0;
    settings.clamp = {};
    settings.adaptive = false;
    return settings;
}

RenderSettings plain_lab_settings(RenderSettings settings, int longest) {
    settings = lab_settings(settings, longest);
    settings.region = {};
    settings.smooth_edges = false;
    settings.reuse = RenderSettings{}.reuse;
    settings.caustics = CausticStrategy::off;
    return settings;
}

} // namespace blush
