// Runs the light meters on their own thread, while there are any.
#pragma once

#include "measure/metrics/light_meter.h"
#include "ui/jobs/round_runner.h"

#include <vector>

namespace blush {

class MeterWork {
public:
    struct Question {
        Question(const Scene& scene, const RenderSettings& settings, const std::vector<MeterPlace>& places);

        Scene scene;
        RenderSettings settings;
        std::vector<MeterPlace> places;
        // True if the light at the meters is the same for both questions.
        bool asks_the_same(const Question& other) const;
    };
    using Answer = std::vector<MeterReading>;

    void begin(const Question& q) { meters_.begin(q.scene, q.settings, q.places); }
    bool round(const std::function<bool()>& wanted);
    Answer answer() const { return meters_.readings(); }
    static bool is_good(const Answer& readings);

private:
    LightMeters meters_{{.threads = 1, .low_priority = true, .planes = {}}};
};

using MeterRunner = RoundRunner<MeterWork>;

} // namespace blush
