// State of the Samplers panel (ui/panels/sampler.cpp), and its chart.
#pragma once

#include "measure/plot/plot.h"
#include "ui/jobs/sampler_runner.h"

#include <array>
#include <memory>

namespace blush {

// By compared_samplers.
constexpr std::array<const char*, 2> sampler_names{"Random numbers", "Sobol points"};

struct SamplerView {
    static constexpr int most_points = 1024, dimensions = 14; // pairs that can be chosen: the pixel, the lens, and four bounces

    bool open = false;
    int64_t points = 64;
    int dimension = 0;
    std::shared_ptr<SamplerRunner> runner; // while the panel is open
    SamplerRunner::State state;
};

// RMSE over samples per pixel.
Plot sampler_plot(const SamplerReport& report);
// What random numbers cost at the largest number of samples of which it is known; empty: of none.
std::string sampler_gain_text(const SamplerReport& report);

} // namespace blush
