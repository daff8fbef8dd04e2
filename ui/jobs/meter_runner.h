// Runs the light meters on their own thread, while there are any.
#pragma once

#include "measure/metrics/light_meter.h"
#include "ui/jobs/image_input.h"
#include "ui/jobs/round_runner.h"

#include <vector>

namespace blush {

class MeterWork {
public:
    struct Input : ImageInput {
        Input(const Scene& scene, const RenderSettings& settings, const std::vector<MeterPlace>& places);

        std::vector<MeterPlace> places;
        // True if the light at the meters is the same for both inputs.
        bool has_same_result(const Input& other) const;
    };
    using Output = std::vector<MeterReading>;

    void begin(const Input& q) { meters_.begin(q.scene, q.settings, q.places); }
    bool round(const std::function<bool()>& wanted);
    Output output() const { return meters_.readings(); }
    static bool is_good(const Output& readings);

private:
    LightMeters meters_{{.threads = 1, .low_priority = true, .planes = {}}};
};

using MeterRunner = RoundRunner<MeterWork>;

} // namespace blush
