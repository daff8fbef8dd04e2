// Which samples of an image sample the environment through learned portals, as their pilot decides.
#pragma once

#include "render/compile/feature_report.h"
#include "render/compile/scene_tables.h"
#include "render/pilots/portal_pilot.h"
#include "scene/render_settings.h"

#include <cstdint>
#include <optional>

namespace blush {

class RenderScene;

// As with learned visibility (visibility_choice.h), the first sample of each pixel and all samples of coarse images go without, and the
// decision depends on the scene and the settings alone.
class PortalChoice {
public:
    PortalChoice() = default;
    // For a new image of a compiled scene.
    PortalChoice(const RenderSettings& settings, const RenderScene& scene);

    // True if a pilot must decide before any sample but the first.
    bool needs_pilot() const { return !useless_ && !pilot_; }
    // Takes its result; ignored if nothing depends on it.
    void decide(PortalPilot pilot);

    bool pays() const { return pilot_ && pilot_->figures && pilot_->figures->cost() < largest_cost; }
    bool gains_much() const { return pays() && pilot_->figures->cost() < 0.5; }
    // The tables for a sample of this index at full resolution. Requires a decision except for index 0. Valid as long as both.
    SceneTables tables(SceneTables scene, int64_t sample) const;

    FeatureUse report() const;

private:
    static constexpr double largest_cost = 0.95; // a pilot errs by some percent

    const char* useless_ = "nothing is rendered"; // null: a pilot decides
    std::optional<PortalPilot> pilot_;
};

} // namespace blush
