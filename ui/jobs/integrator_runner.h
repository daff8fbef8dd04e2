// Runs the integrator comparison on its own thread, while its panel is open.
#pragma once

#include "measure/lab/integrator_comparison.h"
#include "ui/jobs/image_input.h"
#include "ui/jobs/round_runner.h"

#include <memory>

namespace blush {

class IntegratorWork {
public:
    struct Input : ImageInput {
        Input(const Scene& scene, const RenderSettings& settings, const ComparisonIntegrator& integrator);

        ComparisonIntegrator integrator;
        bool has_same_result(const Input& other) const;
    };
    // Shared, because the panel reads it in every frame and it holds images; null before the first round.
    using Output = std::shared_ptr<const IntegratorReport>;

    void begin(const Input& q) { lab_.begin(q.scene, q.settings, q.integrator); }
    bool round(const std::function<bool()>& wanted) { return lab_.round(wanted); }
    Output output() const { return std::make_shared<const IntegratorReport>(lab_.report()); }
    static bool is_good(const Output& report);

private:
    IntegratorComparison lab_{{.threads = 1, .low_priority = true, .planes = {}}};
};

using IntegratorRunner = RoundRunner<IntegratorWork>;

} // namespace blush
