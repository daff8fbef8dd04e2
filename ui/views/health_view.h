// State of the Health panel, with the last replayed sample.
#pragma once

#include "ui/jobs/background_job.h"

#include <cstdint>
#include <memory>
#include <string>

namespace blush {

struct HealthView {
    bool open = false;
    bool map = false;                                   // the viewport shows where samples were dropped
    std::string log;                                    // path log of the last replay
    std::shared_ptr<BackgroundJob<std::string>> replay; // while it is running
};

} // namespace blush
