#include "app/commands/plan/resume.h"

#include "app/commands/plan/make_plan.h"
#include "app/commands/plan/plan_files.h"
#include "app/commands/render/allocation_file.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// The pilot of an adaptive look is merged: the plan names its allocation from now on.
Result<void> adopt_allocation(const std::filesystem::path& folder, PlanLook& look) {
    const std::filesystem::path file = allocation_file(folder, look);
    const Result<AllocationFile> allocation = read_allocation(file);
    if (allocation) {
        look.allocation = allocation_hash(*allocation);
        return {};
    }
    std::error_code code;
    std::filesystem::remove(file, code); // the next merge of the pilot writes it again
    return allocation.error();
}

// Tasks of the next round. Marks looks that need none.
Result<std::vector<LookSamples>> next_round(const std::filesystem::path& folder, RenderPlan& plan, unsigned threads, bool& changed) {
    std::vector<LookSamples> wanted;
    const std::vector<int64_t> planned = planned_samples(plan);
    for (size_t i = 0; i < plan.looks.size(); ++i) {
        if (plan.looks[i].finished) continue;
        if (!look_progress(folder, plan, i, planned[i]).complete()) continue;
        const Result<LookProgress> merged = merge_look(folder, plan, i, planned[i], threads);
        if (!merged) return merged.error();
        const double high = upper_end(merged->error);
        PlanLook& look = plan.looks[i];
        if ((high > 0 && high <= plan.error) || merged->last >= plan.spp) {
            look.finished = true;
            changed = true;
            continue;
        }
        if (look.settings.adaptive && look.allocation.empty())
            if (const Result<void> adopted = adopt_allocation(folder, look); !adopted) return adopted.error();
        const int64_t last = plan.error > 0 ? samples_to_reach(plan.error, high, merged->last, plan.chunk, plan.spp) : plan.spp;
        wanted.push_back({i, {merged->last, last}});
    }
    return wanted;
}

} // namespace

int64_t samples_to_reach(double wanted, double high, int64_t samples, int64_t chunk, int64_t limit) {
    constexpr double most_growth = 4, unknown_growth = 2;
    const double growth = high > 0 ? std::min(high / wanted, most_growth) : unknown_growth;
    const int64_t needed = int64_t(std::ceil(double(samples) * growth));
    return std::min((std::max(needed, samples + 1) + chunk - 1) / chunk * chunk, limit);
}

double upper_end(const std::string& error) {
    const size_t to = error.rfind(" to "), close = error.rfind(')');
    double high = 0;
    if (to == error.npos || close == error.npos || close < to + 4) return 0;
    return parse_number(std::string_view(error).substr(to + 4, close - to - 4), high) && std::isfinite(high) && high > 0 ? high : 0;
}

Result<Resumed> resume_plan(const std::filesystem::path& folder, RenderPlan& plan, unsigned threads) {
    Resumed resumed;
    if (plan.in_rounds()) {
        bool changed = false;
        const Result<std::vector<LookSamples>> wanted = next_round(folder, plan, threads, changed);
        if (!wanted) return wanted.error();
        const size_t before = plan.tasks.size();
        add_tasks(plan, *wanted);
        resumed.added = plan.tasks.size() - before;
        if (changed || resumed.added > 0) {
            if (const Result<void> written = write_plan(folder, plan); !written) return written.error();
            if (const Result<void> written = write_plan_files(folder, plan); !written) return written.error();
        }
    }
    resumed.status = status_of(folder, plan);
    if (const Result<void> written = write_missing(folder, plan, resumed.status.missing); !written) return written.error();
    return resumed;
}

} // namespace blush
