// Light meters of the window: where they are, what they read, and how they are drawn.
#pragma once

#include "render/frame.h"
#include "scene/view_settings.h"
#include "ui/gizmo.h"
#include "ui/meter_runner.h"

#include <imgui.h>
#include <memory>
#include <optional>

namespace blush {

struct MetersView {
    bool open = false;
    std::shared_ptr<MeterRunner> runner; // while there are meters
    MeterRunner::State state;            // as last asked
};

// A meter on what is seen at (u, v), named; nothing where nothing is seen.
std::optional<LightMeter> meter_at(const Frame& frame, const Scene& scene, const Projection& projection, double u, double v,
                                   std::string name);
// "Meter 3": the first number that no meter has.
std::string new_meter_name(const std::vector<LightMeter>& meters);
std::vector<MeterPlace> places_of(const Scene& scene, const std::vector<LightMeter>& meters);

// "342 ± 4 lx"; "..." before there is an interval; "no light found yet" where all estimates are 0 in a scene that gives light.
std::string reading_text(const MeterReading& reading);
void draw_meters(ImDrawList& draw, const ImageRect& image, const Projection& projection, const Scene& scene, const ViewSettings& view,
                 const MetersView& meters);

} // namespace blush
