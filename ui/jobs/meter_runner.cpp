#include "ui/jobs/meter_runner.h"

#include <algorithm>

namespace blush {
namespace {

constexpr int samples_per_round = 256;
constexpr int64_t min_rounds = 16, max_rounds = 4000;
constexpr double good_enough = 0.002; // half the confidence interval, relative

} // namespace

MeterWork::Input::Input(const Scene& scene_, const RenderSettings& settings_, const std::vector<MeterPlace>& places_)
    : ImageInput{scene_, settings_}, places(places_) {
    // Readings do not depend on view or resolution.
    scene.view = {};
    settings.width = settings.height = 1;
    settings.resolution_scale = 1;
    settings.region = {};
}

bool MeterWork::Input::has_same_result(const Input& other) const { return places == other.places && ImageInput::has_same_result(other); }

bool MeterWork::round(const std::function<bool()>& wanted) { return meters_.round(samples_per_round, wanted); }

bool MeterWork::is_good(const Output& readings) {
    return std::ranges::all_of(readings, [](const MeterReading& r) {
        if (r.rounds >= max_rounds) return true;
        return r.rounds >= min_rounds && r.lux.high - r.lux.low <= 2 * good_enough * r.lux.value;
    });
}

} // namespace blush
