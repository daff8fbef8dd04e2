// Runs the roulette lab on its own thread, while its panel is open.
#pragma once

#include "measure/lab/roulette_comparison.h"
#include "ui/jobs/image_input.h"
#include "ui/jobs/round_runner.h"

namespace blush {

class RouletteWork {
public:
    using Input = ImageInput;
    using Output = RouletteReport;

    void begin(const Input& q) { lab_.begin(q.scene, q.settings); }
    bool round(const std::function<bool()>& wanted) { return lab_.round(wanted); }
    Output output() const { return lab_.report(); }
    static bool is_good(const Output& report);

private:
    RouletteComparison lab_{{.threads = 1, .low_priority = true, .planes = {}}};
};

using RouletteRunner = RoundRunner<RouletteWork>;

} // namespace blush
