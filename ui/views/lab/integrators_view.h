// State of the Integrators panel, and what it shows of a report: a chart, a map and texts.
#pragma once

#include "measure/plot/plot.h"
#include "ui/jobs/integrator_runner.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace blush {

struct IntegratorsView {
    enum class Show { images, wipe, difference };
    static constexpr const char* show_names[] = {"Side by side", "Wipe", "Difference"};

    bool open = false;
    Show show = Show::images;
    float wipe = 0.5f; // share of the width
    ErrorMetric metric = ErrorMetric::relmse;
    ComparisonIntegrator integrator{.kind = ComparisonIntegrator::Kind::ambient};
    std::shared_ptr<IntegratorRunner> runner; // while the panel is open
    IntegratorRunner::State state;            // last polled
};

// The integrators for comparison, in the order of ComparisonIntegrator::Kind without `none`.
constexpr std::array<const char*, 7> integrator_names{
    "Ambient light", "Irradiance cache", "Light probes", "Photon map", "PPM", "BDPT", "MLT"};
const char* integrator_name(ComparisonIntegrator::Kind kind);

// The difference b - p of a biased from a path traced image, relative to the mean of both, as RGBA bytes, width * height, top row first:
// blue too dark, red too bright, full at difference_range.
std::vector<uint32_t> difference_texels(const IntegratorReport& report);
constexpr double difference_range = 0.4;

// Where a region lies in the image: "at the top left", "in the middle".
std::string place_of(const RegionBias& region, const IntegratorReport& report);
// "3.1 % too dark".
std::string amount_of(const RegionBias& region);
// The verdict of the bias test in one sentence: what is wrong where, or that no bias is found in the noise so far.
std::string integrator_verdict(const IntegratorReport& report);
// The bias, whether it stays or falls with the samples, or that it is not known; that an unbiased integrator has none.
std::string integrator_bias_text(const IntegratorReport& report, ComparisonIntegrator::Kind kind, ErrorMetric metric);

// Samples that the images leave out; empty: none.
std::string integrator_note(const IntegratorReport& report);

// Over time, on logarithmic axes: the noise of the path traced image, the error of the biased one and the noise in it, the slope of
// independent samples; as a level the bias that stays. Errors that are not known have no point.
Plot integrator_plot(const IntegratorReport& report, ComparisonIntegrator::Kind kind, ErrorMetric metric);

} // namespace blush
