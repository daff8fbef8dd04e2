#include "tests/bench/big/whole_process.h"

#include "core/files.h"

#include <algorithm>
#include <sys/resource.h>

namespace blush::bench {
namespace {

struct Runs {
    std::vector<double> seconds, core_seconds;
    double peak_mb = 0;

    Json figures() const {
        return {{"to_first_image_s", rounded(median(seconds))},
                {"core_seconds", rounded(median(core_seconds))},
                {"peak_memory_mb", rounded(peak_mb)}};
    }
};

// The reason if the run failed.
std::string add_run(const std::string& program, const std::vector<std::string>& arguments, const test::TemporaryFolder& folder,
                    const Options& options, Runs& runs) {
    const std::string out = folder / "out.exr", json = folder / "render.json";
    std::vector<std::string> command{program,   "render", "-o",       out,         "--spp",
                                     "1",       "--size", "1280x720", "--threads", std::to_string(options.threads),
                                     "--quiet", "--json", json};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const double cores_before = children_core_seconds();
    const Clock::time_point begin = Clock::now();
    const test::Finished finished = test::run(command);
    runs.seconds.push_back(seconds_since(begin));
    runs.core_seconds.push_back(children_core_seconds() - cores_before);
    const auto report = read_file(json, 1 << 20);
    if (finished.exit_code != 0 || !report) return "the render failed: " + finished.err;
    runs.peak_mb = std::max(runs.peak_mb, Json::parse(report->begin(), report->end()).value("peak_memory_mb", 0.0));
    return {};
}

} // namespace

double children_core_seconds() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Json measure_process(const std::vector<std::string>& arguments, const test::TemporaryFolder& folder, const Options& options) {
    Runs ours, theirs;
    for (int round = 0; round < std::min(options.rounds, 5); ++round) {
        if (!options.against.empty())
            if (const std::string failed = add_run(options.against, arguments, folder, options, theirs); !failed.empty())
                return {{"failed", failed}};
        if (const std::string failed = add_run(BLUSH_BINARY, arguments, folder, options, ours); !failed.empty())
            return {{"failed", failed}};
    }
    Json figures = ours.figures();
    if (!options.against.empty()) figures["other_build"] = theirs.figures();
    return figures;
}

} // namespace blush::bench
