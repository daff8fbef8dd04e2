// One case of the stability battery: a scene with a known result.
#pragma once

#include "measure/stability/verdict.h"
#include "measure/stability/weak_points.h"

#include <functional>
#include <string>
#include <vector>

namespace blush::stability {

struct StabilityCase {
    std::string name;              // unique within its group
    int weak_point = 0;            // tested weak point: a number of weak_points()
    std::function<Findings()> run; // may throw std::exception: the case then fails with its message
    std::string limit = {};        // not empty: known limit and its reason. Measured and listed, but not counted.
};
struct StabilityGroup {
    std::string name;
    std::vector<StabilityCase> cases;
};

} // namespace blush::stability
