// Renders several variants in turns and measures their error against a reference over time.
#pragma once

#include "app/commands/converge/variants.h"
#include "measure/convergence/reference.h"
#include "measure/lab/roulette_comparison.h"
#include "measure/metrics/metrics.h"
#include "measure/statistics/bias_test.h"
#include "measure/statistics/intervals.h"

#include <array>
#include <atomic>
#include <functional>
#include <string_view>
#include <vector>

namespace blush {

struct MeasuredPoint {
    int repeat = 0;
    double seconds = 0; // render time of this variant in this repeat, without setup and measuring
    int64_t spp = 0;
    Metrics metrics; // against the reference; flip only in the first repeat, because it takes longer than rendering
    bool has_flip = false;
    bool reference_clearly_better = false;
};

struct VariantResult {
    Variant variant;
    std::vector<MeasuredPoint> points;
    MeasuredImage mean;              // of all repeats
    PowerFit over_seconds, over_spp; // fits of RMSE; only of points whose reference is clearly better
    Interval efficiency;             // 1 / (MSE x seconds), from the last points of the repeats
    BiasTest bias;
    // Bias by bounce, for a variant that is biased by its roulette or its limit on bounces.
    std::vector<RouletteBias> bias_by_bounce;
};

struct ConvergeInput {
    const Scene* scene = nullptr;
    std::vector<Variant> variants;
    int repeats = 1;
    double seconds = 0; // render time of each variant in each repeat; 0: no limit
    int64_t spp = 0;    // samples per pixel of each variant in each repeat; 0: no limit
    uint32_t seed = 0;  // of the first repeat; the next repeats use the following seeds
    unsigned threads = 0;
    bool whole_paths = true; // the reference has no limit on bounces
};

// The seeds of all repeats.
std::vector<uint32_t> seeds_of(const ConvergeInput& input);

struct ConvergeResult {
    std::vector<VariantResult> variants;
    std::string kernel;
    bool partial = false; // interrupted
};

// Called with the progress 0 .. 1 and a description.
using ConvergeProgress = std::function<void(double, std::string_view)>;

// Variants alternate in slices of 0.1 s, the one with the least time first, so that other load on the machine affects all
// equally.
ConvergeResult run_converge(const ConvergeInput& input, const MeasuredImage& reference, const std::atomic<bool>& interrupted,
                            const ConvergeProgress& progress);

} // namespace blush
