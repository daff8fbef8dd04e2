// Comparison of a biased integrator with path tracing on one scene at equal time, in rounds: what the trick saves and what it costs.
#pragma once

#include "measure/convergence/convergence.h"
#include "measure/lab/timed_render.h"
#include "measure/statistics/bias_test.h"
#include "render/comparison/comparison_integrator.h"

#include <functional>
#include <memory>
#include <vector>

namespace blush {

// One integrator so far.
struct IntegratorSide {
    int64_t samples = 0;     // per pixel
    double seconds = 0;      // of rendering, with what the integrator prepares: records, probes, photons
    int64_t dropped = 0;     // samples that were not finite or negative, which the image leaves out
    std::vector<Vec3> image; // scene-linear RGB, width * height, top row first
    // Estimated from the half buffers: noise alone.
    ConvergenceRecord noise;
    // The latest noise; not known before there is one.
    Interval noise_error(ErrorMetric metric) const;
};

struct IntegratorReport {
    int64_t rounds = 0;
    int width = 0, height = 0;
    IntegratorSide path, biased;
    // Error of the biased image against the path traced one, which has samples of its own (image_error.h): noise and bias. It falls until
    // the bias is all that is left.
    ConvergenceRecord error;
    // What no number of samples removes: the error without the noise of the image. Mean of (b - p)^2 - e_b^2 - e_p^2 over pixels, b and p
    // the images, e their standard errors; its root for RMSE. Not known where the interval contains 0.
    Interval bias_rmse, bias_relmse;
    // The biased image against the path traced one, by region.
    BiasTest verdict;

    const Interval& bias(ErrorMetric metric) const { return metric == ErrorMetric::rmse ? bias_rmse : bias_relmse; }
    Interval latest_error(ErrorMetric metric) const;
};

// Both renders have independent samples; strategies for caustics, path reuse, adaptive sampling, smooth edges and clamping are off. Holds
// two compiled scenes, so that it can run in parallel with other renders.
class IntegratorComparison {
public:
    explicit IntegratorComparison(const RendererOptions& options);
    ~IntegratorComparison();

    // Restarts; what a baked integrator has prepared for the scene before stays. The image is scaled to at most `longest` pixels on its
    // longer side. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, const ComparisonIntegrator& integrator, int longest = 240);
    // Each integrator renders until it has had the time of this round, in whole samples of all pixels, in an order that changes between
    // rounds. What one spends on its preparation the other spends on samples. False if `wanted` (called often, from many threads) returned
    // false: the round is then discarded, and no other round can follow.
    bool round(const std::function<bool()>& wanted = {});
    const IntegratorReport& report() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

constexpr double integrator_round_seconds = 0.3; // per integrator and round

} // namespace blush
