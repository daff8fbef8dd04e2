#include "scene/render_settings.h"

#include "scene/reuse_setting.h"

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

bool same_image(const RenderSettings& before, const RenderSettings& after) {
    RenderSettings stops_alike = before;
    stops_alike.spp = after.spp;
    stops_alike.seconds = after.seconds;
    stops_alike.error = after.error;
    return stops_alike == after;
}

} // namespace blush
