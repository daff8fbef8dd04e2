#include "app/commands/plan/scaling.h"

#include <algorithm>
#include <functional>
#include <queue>

namespace blush {
namespace {

constexpr double most_overhead = 0.03;
constexpr int64_t most_workers = 10000;
// A look in more parts would take its merge too long.
constexpr int64_t most_parts = 4096;

int64_t smallest_chunk(int64_t spp) {
    int64_t chunk = 1;
    while (chunk < spp && (spp + chunk - 1) / chunk > most_parts) chunk *= 2;
    return chunk;
}

int64_t parts_of(const Workload& work) { return (work.spp + work.chunk - 1) / work.chunk; }

// One process renders each look as a whole and writes it.
double seconds_of_one_process(const MeasuredCosts& costs, const Workload& work) {
    return double(work.looks) * (costs.start + double(work.spp) * costs.sample + costs.write);
}

// A merge reads all parts and writes the sum; of one part it only copies the file.
double seconds_of_merge(const MeasuredCosts& costs, const Workload& work) {
    const int64_t parts = parts_of(work);
    return parts > 1 ? double(parts) * costs.read + costs.write : costs.write;
}

// When the last of `count` equal jobs ends on workers that begin at 0.
double makespan(int64_t count, double seconds, int64_t workers) { return double((count + workers - 1) / workers) * seconds; }

} // namespace

Scaling simulate(const MeasuredCosts& costs, const Workload& work, int64_t workers) {
    using Times = std::priority_queue<double, std::vector<double>, std::greater<>>;
    const int64_t parts = parts_of(work), tasks = parts * work.looks;
    Times free_at(std::greater<>(), std::vector<double>(size_t(std::min(workers, tasks)), 0.0));
    double end = 0;
    for (int64_t part = 0; part < parts; ++part) {
        // The last chunk of a look may be shorter.
        const int64_t samples = std::min(work.chunk, work.spp - part * work.chunk);
        const double seconds = costs.start + double(samples) * costs.sample + costs.write;
        for (int64_t look = 0; look < work.looks; ++look) {
            const double done = free_at.top() + seconds;
            free_at.pop();
            free_at.push(done);
            end = std::max(end, done);
        }
    }
    Scaling row{.workers = workers, .seconds = end + makespan(work.looks, seconds_of_merge(costs, work), workers)};
    row.speedup = row.seconds > 0 ? seconds_of_one_process(costs, work) / row.seconds : 0;
    row.efficiency = row.speedup / double(workers);
    return row;
}

std::vector<Scaling> scaling_table(const MeasuredCosts& costs, const Workload& work) {
    std::vector<Scaling> table;
    for (int64_t workers = 1; workers < most_workers; workers *= 2) table.push_back(simulate(costs, work, workers));
    table.push_back(simulate(costs, work, most_workers));
    return table;
}

int64_t knee_of(const std::vector<Scaling>& table) {
    for (size_t i = 1; i < table.size(); ++i)
        if (table[i].seconds > 0.75 * table[i - 1].seconds) return table[i - 1].workers;
    return table.empty() ? 1 : table.back().workers;
}

double plan_overhead(const MeasuredCosts& costs, const Workload& work) {
    const double alone = seconds_of_one_process(costs, work);
    return alone > 0 ? simulate(costs, work, 1).seconds / alone - 1 : 0;
}

int64_t choose_chunk(const MeasuredCosts& costs, int64_t looks, int64_t spp) {
    int64_t chunk = smallest_chunk(spp);
    for (; chunk < spp; chunk *= 2)
        if (plan_overhead(costs, {looks, spp, chunk}) < most_overhead) return chunk;
    return chunk;
}

int64_t choose_chunk_for(const MeasuredCosts& costs, int64_t looks, int64_t spp, int64_t workers) {
    int64_t chunk = smallest_chunk(spp), best = chunk;
    double least = simulate(costs, {looks, spp, chunk}, workers).seconds;
    while (chunk < spp) {
        chunk *= 2;
        const double seconds = simulate(costs, {looks, spp, chunk}, workers).seconds;
        if (seconds > least) continue;
        least = seconds;
        best = chunk;
    }
    return best;
}

} // namespace blush
