#include "ui/views/farm_view.h"

#include "ui/window/time_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {

int64_t FarmPlan::merged_samples() const {
    int64_t sum = 0;
    for (const FarmLook& look : looks) sum += look.merged;
    return sum;
}

const FarmPlan* FarmView::running() const {
    const FarmPlan* least = nullptr;
    for (const FarmPlan& plan : plans)
        if (plan.state == FarmPlan::State::running && (!least || plan.seconds_left < least->seconds_left)) least = &plan;
    return least;
}

bool FarmView::is_making() const {
    return std::ranges::any_of(plans, [](const FarmPlan& plan) { return plan.state == FarmPlan::State::making; });
}

std::vector<std::string> saved_snapshots(const SnapshotsView& snapshots, const FarmView& farm) {
    std::vector<std::string> files;
    const auto is_of_plan = [&](const std::filesystem::path& file) {
        return std::ranges::count(farm.plans, file.parent_path().parent_path(), &FarmPlan::folder) > 0;
    };
    for (const SnapshotPtr& s : snapshots.list)
        if (!s->file.empty() && s->no_state.empty() && s->scene_file == farm.scene_file && !is_of_plan(s->file))
            files.push_back(s->file.string());
    return files;
}

std::string progress_text(const FarmPlan& plan) {
    // Full only when it is finished.
    return fmt::format("{:.0f} %, {} left", std::floor(100 * std::clamp(plan.fraction, 0.0, 0.99)), guessed_time_text(plan.seconds_left));
}

} // namespace blush
