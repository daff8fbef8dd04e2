// What a plan costs on any number of workers, by simulation from measured costs.
#pragma once

#include <cstdint>
#include <vector>

namespace blush {

// Seconds on the machine that made the plan; memory of its process.
struct MeasuredCosts {
    double start = 0;      // of a task: load the scene, build it, learn
    double sample = 0;     // one sample of every pixel
    double write = 0;      // of a part
    double read = 0;       // of a part, by the merge
    double memory_mib = 0; // peak of a task
    double part_mib = 0;   // of a file
    bool operator==(const MeasuredCosts&) const = default;
};

// How much there is to do.
struct Workload {
    int64_t looks = 1;
    int64_t spp = 1; // of each look
    int64_t chunk = 1;
};

// One row of the scaling table.
struct Scaling {
    int64_t workers = 1;
    double seconds = 0;    // until the last look is merged
    double speedup = 0;    // against one process that renders every look as a whole
    double efficiency = 0; // speedup / workers
};

// Workers take tasks in order, each the next when it is free; then they take the merges, one per look.
Scaling simulate(const MeasuredCosts& costs, const Workload& work, int64_t workers);
// 1, 2, 4, ... workers and 10000.
std::vector<Scaling> scaling_table(const MeasuredCosts& costs, const Workload& work);
// The last row before doubling the workers saves less than a quarter of the time: more are a waste.
int64_t knee_of(const std::vector<Scaling>& table);

// Share of time that one worker loses to a plan with this chunk, against one process.
double plan_overhead(const MeasuredCosts& costs, const Workload& work);
// The smallest power of two whose overhead is below 3 %: most workers can share a look then. If there is none, a look is one task.
int64_t choose_chunk(const MeasuredCosts& costs, int64_t looks, int64_t spp);
// The power of two with which this many workers end first, whatever it costs; the largest of several.
int64_t choose_chunk_for(const MeasuredCosts& costs, int64_t looks, int64_t spp, int64_t workers);

} // namespace blush
