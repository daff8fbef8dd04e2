// Whole runs of `blush render`, with one sample per pixel: what a user waits for.
#pragma once

#include "tests/bench/bench.h"
#include "tests/support/process.h"

#include <string>
#include <vector>

namespace blush::bench {

// CPU seconds of all processes that this one has run and waited for.
double children_core_seconds();

// Medians of wall and core seconds and the largest peak memory, of `blush render ARGUMENTS` at 1280 x 720; with Options::against
// also those of the other build, run in turn with ours.
Json measure_process(const std::vector<std::string>& arguments, const test::TemporaryFolder& folder, const Options& options);

} // namespace blush::bench
