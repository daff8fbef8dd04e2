#include "tests/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

namespace blush::bench {

Cost cost_of(const std::function<void()>& work) {
    const auto begin = Clock::now();
    const std::clock_t core_begin = std::clock();
    work();
    const std::clock_t core_end = std::clock();
    return {seconds_since(begin), double(core_end - core_begin) / CLOCKS_PER_SEC};
}

double quantile(std::vector<double> values, double p) {
    std::sort(values.begin(), values.end());
    const auto rank = size_t(std::ceil(p * double(values.size())));
    return values[std::clamp<size_t>(rank, 1, values.size()) - 1];
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double rounded(double value) { return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr); }

std::filesystem::path weights_folder() {
    const char* set = std::getenv("BLUSH_WEIGHTS");
    return set && *set ? set : BLUSH_BUILT_WEIGHTS;
}

} // namespace blush::bench
