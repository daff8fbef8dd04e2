#include "measure/stability/battery.h"

#include "core/parallel.h"
#include "measure/stability/groups.h"
#include "measure/statistics/intervals.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <mutex>

namespace blush::stability {
namespace {

int count_cases() {
    int n = 0;
    for (const StabilityGroup& g : battery())
        for (const StabilityCase& c : g.cases) n += c.limit.empty();
    return n;
}

struct Job {
    const std::string* group;
    const StabilityCase* c;
};

} // namespace

const std::vector<StabilityGroup>& battery() {
    static const std::vector<StabilityGroup> groups = {
        {"furnace", furnace_cases()},       {"scale", scale_cases()},           {"lights", light_cases()},
        {"worlds", world_cases()},          {"microfacet", microfacet_cases()}, {"dielectric", dielectric_cases()},
        {"absorption", absorption_cases()}, {"mirrors", mirror_cases()},        {"grazing", grazing_cases()},
        {"geometry", geometry_cases()},     {"camera", camera_cases()},         {"film", film_cases()},
        {"health", health_cases()},         {"limits", limit_cases()},
    };
    return groups;
}

CaseResult run_case(const std::string& group, const StabilityCase& c, int cases) {
    CaseResult r;
    r.group = group;
    r.name = c.name;
    r.limit = c.limit;
    r.weak_point = c.weak_point;
    const auto begin = std::chrono::steady_clock::now();
    try {
        const Findings findings = c.run();
        const double k = normal_quantile_two_sided(sidak(sidak(family_wise_level, cases), std::max<int64_t>(1, int64_t(findings.size()))));
        r.finding = worst_of(findings, k);
        r.tolerance = tolerance(r.finding, k);
        r.pass = holds(r.finding, k);
    } catch (const std::exception& error) {
        r.finding.measured = std::numeric_limits<double>::quiet_NaN();
        r.error = error.what();
    }
    r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return r;
}

BatteryReport run_battery(const std::string& group, unsigned threads, const CaseDone& done) {
    std::vector<Job> jobs;
    for (const StabilityGroup& g : battery())
        if (group.empty() || group == g.name)
            for (const StabilityCase& c : g.cases) jobs.push_back({&g.name, &c});

    std::vector<CaseResult> results(jobs.size());
    std::vector<char> finished(jobs.size(), 0);
    std::atomic<bool> wanted = true;
    std::mutex mutex;
    int count = 0;
    const int cases = count_cases();
    const Workers workers(threads);
    workers.for_each(
        int64_t(jobs.size()), [&] { return wanted.load(); },
        [&](int64_t i, unsigned) {
            const Job& job = jobs[size_t(i)];
            results[size_t(i)] = run_case(*job.group, *job.c, cases);
            const std::lock_guard lock(mutex);
            finished[size_t(i)] = 1;
            if (done && !done(++count, int(jobs.size()), job.c->name)) wanted = false;
        });

    BatteryReport report;
    for (size_t i = 0; i < jobs.size(); ++i) {
        report.complete &= finished[i] != 0;
        if (!finished[i]) continue;
        if (!results[i].limit.empty()) {
            report.limits.push_back(std::move(results[i]));
            continue;
        }
        ++(results[i].pass ? report.passed : report.failed);
        report.cases.push_back(std::move(results[i]));
    }
    return report;
}

} // namespace blush::stability
