#include "ui/roulette_runner.h"

#include "scene/changes.h"

namespace blush {
namespace {

constexpr int64_t most_rounds = 2000; // enough to measure a bias of 0.01 %

} // namespace

bool RouletteWork::Question::asks_the_same(const Question& other) const {
    return !diff(scene, settings, other.scene, other.settings).affects_image();
}

bool RouletteWork::is_good(const Answer& report) { return report.rounds >= most_rounds; }

} // namespace blush
