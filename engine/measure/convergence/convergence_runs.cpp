#include "measure/convergence/convergence_runs.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

using Origin = ConvergenceRun::Origin;

constexpr size_t colors = 8;

} // namespace

const ConvergenceRun* ConvergenceRuns::find(int id) const {
    const auto run = std::ranges::find(runs_, id, &ConvergenceRun::id);
    return run == runs_.end() ? nullptr : &*run;
}
ConvergenceRun* ConvergenceRuns::find(int id) { return const_cast<ConvergenceRun*>(std::as_const(*this).find(id)); }

const ConvergenceRun* ConvergenceRuns::live() const {
    const auto run = std::ranges::find(runs_, Origin::live, &ConvergenceRun::origin);
    return run == runs_.end() ? nullptr : &*run;
}
ConvergenceRun* ConvergenceRuns::live() { return const_cast<ConvergenceRun*>(std::as_const(*this).live()); }

// The colour used by the fewest runs, the first of several.
size_t ConvergenceRuns::free_color() const {
    std::array<size_t, colors> used{};
    for (const ConvergenceRun& r : runs_) ++used[r.color % colors];
    return size_t(std::ranges::min_element(used) - used.begin());
}

// "name", "name 2", "name 3", ...
std::string ConvergenceRuns::unique_name(const std::string& name, int but_of) const {
    std::string candidate = name;
    const auto taken = [&](const ConvergenceRun& r) { return r.id != but_of && r.record.name == candidate; };
    for (int number = 2; std::ranges::any_of(runs_, taken); ++number) candidate = fmt::format("{} {}", name, number);
    return candidate;
}

ConvergenceRun& ConvergenceRuns::add(Origin origin, ConvergenceRecord record) {
    const size_t color = free_color();
    record.name = unique_name(record.name);
    const auto behind = origin == Origin::stored ? runs_.end() : std::ranges::find(runs_, Origin::stored, &ConvergenceRun::origin);
    return *runs_.insert(behind, {++last_id_, origin, std::move(record), true, false, color});
}

int ConvergenceRuns::begin(const std::string& name) {
    if (ConvergenceRun* ended = live()) {
        if (ended->record.points(ConvergencePoint::Kind::estimated).size() < min_points && !ended->kept) {
            std::erase_if(runs_, [&](const ConvergenceRun& r) { return r.id == ended->id; });
        } else {
            mark(name);
            ended->origin = Origin::earlier;
        }
    }
    const auto pushed_out = [](const ConvergenceRun& r) { return r.origin == Origin::earlier && !r.kept; };
    while (size_t(std::ranges::count_if(runs_, pushed_out)) > max_earlier) runs_.erase(std::ranges::find_if(runs_, pushed_out));
    ConvergenceRecord record;
    record.name = name;
    return add(Origin::live, std::move(record)).id;
}

void ConvergenceRuns::mark(const std::string& label) {
    ConvergenceRun* run = live();
    if (!run || run->record.points().empty()) return;
    const ConvergencePoint& last = *std::ranges::max_element(run->record.points(), {}, &ConvergencePoint::spp);
    run->record.mark({last.seconds, last.spp, label});
}

void ConvergenceRuns::add_stored(ConvergenceRecord record) { add(Origin::stored, std::move(record)); }

void ConvergenceRuns::rename(int id, const std::string& name) {
    if (ConvergenceRun* run = find(id); run && !name.empty()) run->record.name = unique_name(name, id);
}

void ConvergenceRuns::remove(int id) {
    std::erase_if(runs_, [&](const ConvergenceRun& r) { return r.id == id && r.origin != Origin::live; });
}

void ConvergenceRuns::clear() {
    std::erase_if(runs_, [](const ConvergenceRun& r) { return r.origin != Origin::stored; });
}

} // namespace blush
