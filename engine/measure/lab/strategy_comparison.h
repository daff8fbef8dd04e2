// Comparison of BSDF sampling, light sampling (NEE) and their combination by MIS on one scene, in rounds.
#pragma once

#include "measure/convergence/convergence.h"
#include "render/renderer.h"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace blush {

// What the strategies have in common in each round.
enum class StrategyBudget { time, samples };

// The order of StrategyReport::sides.
constexpr std::array<Strategy, 3> compared_strategies{Strategy::bsdf, Strategy::light, Strategy::mis};

// One strategy so far. Planes are width * height, top row first.
struct StrategySide {
    int64_t samples = 0;         // per pixel
    double seconds = 0;          // of rendering: processor time with one thread, else elapsed time
    int64_t dropped = 0;         // samples that were not finite or negative, which the image leaves out
    std::vector<Vec3> image;     // scene-linear RGB
    std::vector<float> variance; // of the luminance of one sample, nits^2; empty before two rounds
    // Error over time. MIS: estimated from its half buffers. The others: measured against the image of MIS, which has samples of its
    // own (image_error.h): what a strategy alone does not find counts as its error. An error that is not known is no zero: see
    // Interval::known.
    ConvergenceRecord record;
    // The latest error; not known before there is one.
    Interval error(ErrorMetric metric) const;
};

// What BSDF sampling or light sampling contributes to the image of MIS.
struct MisPart {
    std::vector<float> weight;   // share of the pixel's luminance; the weights of both parts sum to 1, in a black pixel both are 0
    std::vector<float> variance; // of the luminance that one sample contributes, nits^2; empty before two rounds
    double share = 0;            // of the luminance of the image; 0 if it is black
};

struct StrategyReport {
    int64_t rounds = 0;
    int width = 0, height = 0;
    std::array<StrategySide, 3> sides; // compared_strategies
    std::array<MisPart, 2> parts;      // BSDF sampling, light sampling
    // Lights without a size, which no ray hits. Light sampling finds them in all three images, also in that of BSDF sampling.
    int zero_size_lights = 0;

    const StrategySide& mis() const { return sides[2]; }
};

// Renders with the path tracer of the image. The three renders differ in Strategy alone (render_settings.h) and have independent
// samples; strategies for caustics, path reuse, adaptive sampling, smooth edges and clamping are off in all of them, as they add
// samples of other kinds or bias. Holds three compiled scenes, so that it can run in parallel with other renders.
class StrategyComparison {
public:
    explicit StrategyComparison(const RendererOptions& options);
    ~StrategyComparison();

    // Restarts. The image is scaled to at most `longest` pixels on its longer side. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, StrategyBudget budget, int longest = 240);
    // Equal time: each strategy renders until it has had the time of this round, in whole samples of all pixels, in an order that
    // changes between rounds; the times differ by at most about one such sample. Equal samples: each adds strategy_round_samples.
    // False if `wanted` (called often, from many threads) returned false: the round is then discarded, and no other round can follow.
    bool round(const std::function<bool()>& wanted = {});
    const StrategyReport& report() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

constexpr int strategy_round_samples = 4;      // per pixel and round for equal samples
constexpr double strategy_round_seconds = 0.2; // per strategy and round for equal time

} // namespace blush
