// Runs the roulette lab on its own thread, while its panel is open.
#pragma once

#include "measure/lab/roulette_comparison.h"
#include "ui/jobs/round_runner.h"

namespace blush {

class RouletteWork {
public:
    struct Question {
        Scene scene;
        RenderSettings settings;
        bool asks_the_same(const Question& other) const;
    };
    using Answer = RouletteReport;

    void begin(const Question& q) { lab_.begin(q.scene, q.settings); }
    bool round(const std::function<bool()>& wanted) { return lab_.round(wanted); }
    Answer answer() const { return lab_.report(); }
    static bool is_good(const Answer& report);

private:
    RouletteComparison lab_{{.threads = 1, .low_priority = true, .planes = {}}};
};

using RouletteRunner = RoundRunner<RouletteWork>;

} // namespace blush
