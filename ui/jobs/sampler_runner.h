// Runs the sampler comparison on its own thread, while its panel is open.
#pragma once

#include "measure/lab/sampler_comparison.h"
#include "ui/jobs/image_input.h"
#include "ui/jobs/round_runner.h"

namespace blush {

class SamplerWork {
public:
    using Input = ImageInput;
    using Output = SamplerReport;

    void begin(const Input& q) { lab_.begin(q.scene, q.settings); }
    bool round(const std::function<bool()>& wanted) { return lab_.round(wanted); }
    Output output() const { return lab_.report(); }
    // The intervals are about a tenth wide then.
    static bool is_good(const Output& report) { return report.pairs >= 100; }

private:
    SamplerComparison lab_{{.threads = 1, .low_priority = true, .planes = {}}};
};

using SamplerRunner = RoundRunner<SamplerWork>;

} // namespace blush
