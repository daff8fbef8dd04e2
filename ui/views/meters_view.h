// Light meters of the window: places and readings.
#pragma once

#include "render/frame.h"
#include "scene/view_settings.h"
#include "ui/jobs/meter_runner.h"
#include "ui/transform/gizmo.h"

#include <memory>
#include <optional>

namespace blush {

struct MetersView {
    bool open = false;
    std::shared_ptr<MeterRunner> runner; // null without meters
    MeterRunner::State state;            // last polled state
};

// A named meter on the surface at (u, v); nullopt if nothing is hit there.
std::optional<LightMeter> meter_at(const Frame& frame, const Scene& scene, const Projection& projection, double u, double v,
                                   std::string name);
// "Meter 3": the first unused number.
std::string new_meter_name(const std::vector<LightMeter>& meters);
std::vector<MeterPlace> places_of(const Scene& scene, const std::vector<LightMeter>& meters);

// "342 ± 4 lx"; "..." before there is an interval; "no light found yet" if all estimates are 0 although the scene has light.
std::string reading_text(const MeterReading& reading);

} // namespace blush
