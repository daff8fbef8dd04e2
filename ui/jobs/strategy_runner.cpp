#include "ui/jobs/strategy_runner.h"

#include <algorithm>

namespace blush {
namespace {

constexpr int64_t most_strategy_samples = 4096; // of the strategy with the fewest: the images do not change visibly after it

} // namespace

StrategyWork::Input::Input(const Scene& scene_, const RenderSettings& settings_, StrategyBudget budget_)
    : ImageInput{scene_, settings_}, budget(budget_) {
    settings.region = {};
    settings.resolution_scale = 1;
}

bool StrategyWork::Input::has_same_result(const Input& other) const { return budget == other.budget && ImageInput::has_same_result(other); }

bool StrategyWork::is_good(const Output& report) {
    return report && std::ranges::all_of(report->sides, [](const StrategySide& s) { return s.samples >= most_strategy_samples; });
}

} // namespace blush
