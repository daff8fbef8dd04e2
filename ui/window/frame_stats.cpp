#include "ui/window/frame_stats.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace blush {

double percentile(std::vector<double> values, double fraction) {
    if (values.empty()) return 0;
    const double rank = std::ceil(fraction * double(values.size())) - 1;
    const auto nth = values.begin() + std::clamp<ptrdiff_t>(ptrdiff_t(rank), 0, ptrdiff_t(values.size()) - 1);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

void FrameStats::add_frame(const FrameTimes& times, Clock::time_point when) {
    constexpr size_t max_late = 100;
    if (!first_frame_) first_frame_ = when;
    keep(frames_, times.total());
    if (times.total() > late && late_.size() < max_late) late_.push_back({when, times});
}

void FrameStats::submitted(uint64_t revision, Clock::time_point when) {
    unanswered_.push_back({revision, when});
    submitted_in_frame_ = revision;
}

void FrameStats::shown(uint64_t revision, Clock::time_point when) {
    while (!unanswered_.empty() && unanswered_.front().revision <= revision) {
        const Submit submit = unanswered_.front();
        unanswered_.pop_front();
        const double waited = std::chrono::duration<double, std::milli>(when - submit.when).count();
        keep(answers_, waited);
        if (submit.revision != revision) continue;
        keep(latencies_, waited);
        at_once_ += revision == submitted_in_frame_;
    }
}

void FrameStats::view_change_shown(Clock::time_point when) {
    if (view_change_begun_) keep(looks_, std::chrono::duration<double, std::milli>(when - *view_change_begun_).count());
    view_change_begun_.reset();
}

Result<void> FrameStats::write(const std::filesystem::path& file) const {
    nlohmann::json late_frames = nlohmann::json::array();
    for (const auto& [when, times] : late_)
        late_frames.push_back({{"at_s", std::chrono::duration<double>(when - *first_frame_).count()},
                               {"before_image_ms", times.before_image},
                               {"image_ms", times.image},
                               {"after_image_ms", times.after_image}});
    const nlohmann::json json{{"frames", frames_.size()},
                              {"unchanged_frames", unchanged_},
                              {"p50_ms", percentile(frames_, 0.5)},
                              {"p95_ms", percentile(frames_, 0.95)},
                              {"max_ms", percentile(frames_, 1)},
                              {"late", std::ranges::count_if(frames_, [](double ms) { return ms > late; })},
                              {"late_frames", std::move(late_frames)},
                              {"edits", latencies_.size()},
                              {"edits_at_once", at_once_},
                              {"latency_p50_ms", percentile(latencies_, 0.5)},
                              {"latency_p95_ms", percentile(latencies_, 0.95)},
                              {"latency_max_ms", percentile(latencies_, 1)},
                              {"submissions", answers_.size()},
                              {"answer_p50_ms", percentile(answers_, 0.5)},
                              {"answer_p95_ms", percentile(answers_, 0.95)},
                              {"answer_max_ms", percentile(answers_, 1)},
                              {"looks", looks_.size()},
                              {"look_p50_ms", percentile(looks_, 0.5)},
                              {"look_max_ms", percentile(looks_, 1)}};
    std::ofstream out(file);
    out << json.dump(2) << '\n';
    out.close();
    if (!out) return Error{file.string(), "cannot write the window's statistics", ""};
    return {};
}

} // namespace blush
