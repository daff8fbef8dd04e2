// State of the bleed probe in the window: the probed place, what the panel lists, and the jobs behind it.
#pragma once

#include "render/frame.h"
#include "scene/image_region.h"
#include "scene/lights/light_meter.h"
#include "ui/jobs/bleed_runner.h"
#include "ui/viewport/projection.h"

#include <memory>
#include <optional>
#include <string>

namespace blush {

struct BleedView {
    enum class List { senders, lights, bounces };
    static constexpr const char* list_names[] = {"Sender", "Light", "Bounce"};
    enum class Quantity { arriving, leaving };
    static constexpr const char* quantity_names[] = {"Arrives here", "Leaves to camera"};

    bool open = false;
    std::optional<LightMeter> point;        // the probed surface point; moves with its object
    std::optional<ImageRegion> rect;        // or the probed rectangle of the image
    Quantity quantity = Quantity::arriving; // of a point
    List list = List::senders;
    uint32_t chosen = 0; // Id<Node>.value of the sender whose sentence is shown; 0: the greatest object
    bool map = false;    // the image shows the greatest sender of each part

    std::shared_ptr<BleedRunner> runner; // while the panel is open and a place is chosen
    BleedRunner::State state;            // last polled state, as the next
    std::shared_ptr<BleedMapRunner> map_runner;
    BleedMapRunner::State map_state;

    bool has_place() const { return point || rect; }
};

// The probed quantity of a place; without a place, anything. `width` and `height`: of the full image.
BleedTarget target_of(const BleedView& view, const Scene& scene, int width, int height);
// "table at 0.01, 0, 0.2 m", "40 x 30 pixels from 560, 440"
std::string place_of(const BleedView& view, const Scene& scene, int width, int height);
// The sender whose sentence is shown: the chosen one, else the greatest object; null: none.
const BleedShare* sender_of(const BleedView& view, const BleedReport& report);
const std::vector<BleedShare>& rows_of(const BleedView& view, const BleedReport& report);

} // namespace blush
