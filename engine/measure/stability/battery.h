// The stability battery: stiff and extreme scenes whose answers are known, run to a stated statistical tolerance.
//
// A case is data. Adding one is a line in the file of its group; adding a group is one more file and a line in battery.cpp.
#pragma once

#include "measure/stability/verdict.h"

#include <functional>
#include <string>
#include <vector>

namespace blush::stability {

struct StabilityCase {
    std::string name;              // unique within its group
    int hot_spot = 0;              // what it guards: a number of hot_spots()
    std::function<Findings()> run; // may throw std::exception: then the case fails with its words
    std::string limit = {};        // not empty: known not to hold, and why. Measured and listed like the others, but not counted.
};
struct StabilityGroup {
    std::string name;
    std::vector<StabilityCase> cases;
};

// All groups, the slow ones first.
const std::vector<StabilityGroup>& battery();

struct CaseResult {
    std::string group, name, limit;
    int hot_spot = 0;
    Finding finding;      // the worst of the case's
    double tolerance = 0; // of that finding
    bool pass = false;
    double seconds = 0;
    std::string error; // not empty: what the case threw
};
struct BatteryReport {
    std::vector<CaseResult> cases;  // in the order of battery()
    std::vector<CaseResult> limits; // those known not to hold
    int passed = 0, failed = 0;     // of `cases`
    bool complete = true;           // false: stopped before all were run
};

// Runs the cases of one group, or of all for "", each on one thread, `threads` (0: one per core) side by side. The tolerance of a finding
// is as if the whole battery were run: its family-wise level is shared out over all cases, and a case's over its findings. `done(finished,
// all, name)` is called after each case, one call at a time; where it returns false, what has not begun is left out.
using CaseDone = std::function<bool(int finished, int all, const std::string& name)>;
BatteryReport run_battery(const std::string& group, unsigned threads, const CaseDone& done = {});
// One case at the level that `cases` of them together share.
CaseResult run_case(const std::string& group, const StabilityCase& c, int cases);

} // namespace blush::stability
