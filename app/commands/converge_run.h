// Renders several variants side by side and measures each against a reference as time goes by.
#pragma once

#include "app/commands/converge_variants.h"
#include "measure/bias_test.h"
#include "measure/intervals.h"
#include "measure/metrics.h"
#include "measure/reference.h"
#include "measure/roulette_lab.h"

#include <array>
#include <atomic>
#include <functional>
#include <string_view>
#include <vector>

namespace blush {

struct MeasuredPoint {
    int repeat = 0;
    double seconds = 0; // of rendering this variant in this repeat; neither setup nor measuring
    int64_t spp = 0;
    Metrics metrics; // against the reference; flip is measured in the first repeat alone, which takes longer than rendering
    bool has_flip = false;
    bool reference_clearly_better = false;
};

struct VariantResult {
    Variant variant;
    std::vector<MeasuredPoint> points;
    MeasuredImage picture;           // the mean of all repeats
    PowerFit over_seconds, over_spp; // of RMSE; of points whose reference is clearly better alone
    Interval efficiency;             // 1 / (MSE x seconds), over the repeats' last points
    BiasTest bias;
    // Where light is lost or gained: by the number of scatterings, of a biased variant that its roulette or its limit on bounces makes so.
    std::vector<RouletteBias> bias_by_bounce;
};

struct ConvergeInput {
    const Scene* scene = nullptr;
    std::vector<Variant> variants;
    int repeats = 1;
    double seconds = 0; // of rendering, for each variant in each repeat; 0: no limit
    int64_t spp = 0;    // the same in samples per pixel
    uint32_t seed = 0;  // of the first repeat; the next ones follow
    unsigned threads = 0;
    bool whole_paths = true; // the reference has no limit on bounces
};

// The seeds of all repeats.
std::vector<uint32_t> seeds_of(const ConvergeInput& input);

struct ConvergeResult {
    std::vector<VariantResult> variants;
    std::string kernel;
    bool partial = false; // ended early
};

// Told of 0 .. 1 and what is going on.
using ConvergeProgress = std::function<void(double, std::string_view)>;

// Variants take turns in slices of a tenth of a second, whoever has had the least time first, so that a busy machine is busy for all.
ConvergeResult run_converge(const ConvergeInput& input, const MeasuredImage& reference, const std::atomic<bool>& interrupted,
                            const ConvergeProgress& progress);

} // namespace blush
