// State of the Roulette lab.
#pragma once

#include "ui/jobs/roulette_runner.h"
#include "ui/views/lab/survivors_view.h"

#include <memory>

namespace blush {

struct RouletteView {
    enum class Map { none, path_length, survival };
    static constexpr const char* map_names[] = {"Image", "Path length", "Survival"};

    bool open = false;
    Map map = Map::none;                    // what the viewport shows
    std::shared_ptr<RouletteRunner> runner; // while the panel is open
    SurvivorsView survivors;
};

} // namespace blush
