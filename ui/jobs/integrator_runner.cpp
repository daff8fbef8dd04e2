#include "ui/jobs/integrator_runner.h"

#include <algorithm>

namespace blush {
namespace {

constexpr int64_t most_integrator_samples = 4096; // of the one with fewer: the images do not change visibly after it

} // namespace

IntegratorWork::Input::Input(const Scene& scene_, const RenderSettings& settings_, const ComparisonIntegrator& integrator_)
    : ImageInput{scene_, settings_}, integrator(integrator_) {
    settings.region = {};
    settings.resolution_scale = 1;
}

bool IntegratorWork::Input::has_same_result(const Input& other) const {
    return integrator == other.integrator && ImageInput::has_same_result(other);
}

bool IntegratorWork::is_good(const Output& report) {
    return report && std::min(report->path.samples, report->biased.samples) >= most_integrator_samples;
}

} // namespace blush
