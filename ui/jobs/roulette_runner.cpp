#include "ui/jobs/roulette_runner.h"

namespace blush {
namespace {

constexpr int64_t max_roulette_rounds = 2000; // enough to measure a bias of 0.01 %

} // namespace

bool RouletteWork::is_good(const Output& report) { return report.rounds >= max_roulette_rounds; }

} // namespace blush
