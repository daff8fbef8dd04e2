#include "render/pilots/portal_choice.h"

#include "render/compile/render_scene.h"

#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

// Why portals cannot gain anything; null if they may.
const char* why_no_portals(const RenderSettings& settings, const SceneTables& tables) {
    if (settings.strategy != Strategy::mis) return "light and BSDF sampling are not combined";
    if (tables.lights.environment < 0 || !tables.environment.lights_scene) return "no environment lights the scene";
    return nullptr;
}

} // namespace

PortalChoice::PortalChoice(const RenderSettings& settings, const RenderScene& scene) : useless_(why_no_portals(settings, scene.tables())) {}

void PortalChoice::decide(PortalPilot pilot) {
    if (!useless_) pilot_ = std::move(pilot);
}

SceneTables PortalChoice::tables(SceneTables scene, int64_t sample) const {
    if (sample > 0 && pays()) scene.lights.portals = pilot_->portals.tables();
    return scene;
}

FeatureUse PortalChoice::report() const {
    FeatureUse use{.part = "lights", .name = "learned portals", .used = pays(), .why = {}};
    if (useless_)
        use.why = useless_;
    else if (!pilot_)
        use.why = "a pilot decides after the first sample";
    else if (!pilot_->figures)
        use.why = "pilot: no region sees a small part of the environment";
    else
        use.why = fmt::format("pilot: variance x work is {:.2f} of that without", pilot_->figures->cost());
    if (use.used) use.bytes = pilot_->portals.memory_bytes();
    if (pilot_) use.pilot = pilot_->figures;
    return use;
}

} // namespace blush
