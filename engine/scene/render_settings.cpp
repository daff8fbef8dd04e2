#include "scene/render_settings.h"

#include "scene/reuse_setting.h"

#include <algorithm>
#include <cmath>

namespace blush {

RenderSettings recommended_settings() {
    RenderSettings settings;
    settings.adaptive = true;
    settings.roulette.rule = Roulette::Rule::automatic;
    settings.reuse = reuse_auto;
    settings.mis_compensation = true;
    settings.smooth_edges = true;
    return settings;
}

RenderSettings effective_settings(RenderSettings settings) {
    settings.adaptive = settings.adaptive && settings.region == ImageRegion{};
    return settings;
}

RenderSettings at_film_size(RenderSettings settings) {
    const auto scaled = [&](int n) { return std::max(1, int(std::lround(double(n) * double(settings.resolution_scale)))); };
    settings.width = scaled(settings.width);
    settings.height = scaled(settings.height);
    settings.resolution_scale = 1;
    return settings;
}

bool same_image(const RenderSettings& before, const RenderSettings& after) {
    RenderSettings stops_alike = before;
    stops_alike.spp = after.spp;
    stops_alike.seconds = after.seconds;
    stops_alike.error = after.error;
    return stops_alike == after;
}

} // namespace blush
