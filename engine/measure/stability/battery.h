// The stability battery: numerically extreme scenes with known results, tested to a statistical tolerance.
// Cases are data. To add a case, add a line to the file of its group; to add a group, add a file and a line in battery.cpp.
#pragma once

#include "measure/stability/stability_case.h"
#include "measure/stability/weak_points.h"

#include <functional>
#include <string>
#include <vector>

namespace blush::stability {

// All groups, slow ones first.
const std::vector<StabilityGroup>& battery();

struct CaseResult {
    std::string group, name, limit;
    int weak_point = 0;
    Finding finding;      // the worst finding of the case
    double tolerance = 0; // of that finding
    bool pass = false;
    double seconds = 0;
    std::string error; // message of the exception, if any
};
struct BatteryReport {
    std::vector<CaseResult> cases;  // in the order of battery()
    std::vector<CaseResult> limits; // known limits
    int passed = 0, failed = 0;     // counts of `cases`
    bool complete = true;           // false if stopped early
};

// Runs the cases of a group, or all for "", each on one thread, `threads` (0: one per core) in parallel. Tolerances are those of
// the whole battery: the family-wise level is divided among all cases, and that of a case among its findings. `done(finished,
// all, name)` is called after each case, never concurrently; if it returns false, remaining cases are skipped.
using CaseDone = std::function<bool(int finished, int all, const std::string& name)>;
BatteryReport run_battery(const std::string& group, unsigned threads, const CaseDone& done = {});
// Runs one case at the level of one of `cases`.
CaseResult run_case(const std::string& group, const StabilityCase& c, int cases);

} // namespace blush::stability
