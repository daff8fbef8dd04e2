#include "ui/jobs/path_runner.h"

#include "core/math.h"

#include <chrono>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto time_of_round = std::chrono::milliseconds(20);
constexpr size_t most_bins = 24;

} // namespace

bool PathWork::Input::has_same_result(const Input& other) const {
    return pixels == other.pixels && samples == other.samples && ImageInput::has_same_result(other);
}

void PathWork::begin(const Input& input) {
    recorder_.update(input.scene, input.settings);
    pixels_ = input.pixels;
    wanted_paths_ = int64_t(pixels_.size()) * input.samples;
    paths_.clear();
    luminances_.clear();
    summer_ = {};
    output_.reset();
}

// The film's first sample is traced before the pilots decide, and again if they gain much.
bool PathWork::decide(const std::function<bool()>& wanted) {
    if (recorder_.decided()) return true;
    if (!recorder_.decide(wanted)) return false;
    if (!recorder_.renews_first()) return true;
    paths_.clear();
    luminances_.clear();
    summer_ = {};
    return true;
}

void PathWork::trace(const std::function<bool()>& wanted) {
    const auto end = Clock::now() + time_of_round;
    const auto count = int64_t(pixels_.size());
    while (int64_t(paths_.size()) < wanted_paths_) {
        const auto next = int64_t(paths_.size());
        if (next >= count && !recorder_.decided()) break; // further samples need the pilots
        const TracedPixel& p = pixels_[size_t(next % count)];
        paths_.push_back(std::make_shared<const RecordedPath>(recorder_.record(p.x, p.y, next / count)));
        const RecordedPath& path = *paths_.back();
        summer_.add(path);
        if (path.is_valid()) luminances_.push_back(double(luminance(path.radiance)));
        if (Clock::now() >= end || !wanted()) break;
    }
}

void PathWork::publish() {
    auto set = std::make_shared<PathSet>();
    set->paths = paths_;
    set->sum = summer_.sum();
    set->means = running_means(luminances_);
    set->contributions = log_histogram(luminances_, most_bins);
    set->left_out = recorder_.not_replayed();
    if (recorder_.has_light_paths())
        set->left_out.push_back("light paths: the film also splats light that reaches the camera from the lights");
    set->complete = recorder_.decided() && int64_t(paths_.size()) >= wanted_paths_;
    output_ = std::move(set);
}

bool PathWork::round(const std::function<bool()>& wanted) {
    // The first paths appear at once.
    if ((pixels_.empty() || output_) && !decide(wanted)) return false;
    trace(wanted);
    publish();
    return true;
}

} // namespace blush
