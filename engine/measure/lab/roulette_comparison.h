// Comparison of Russian roulette settings: the rule and bounce limit of the settings against no roulette and no limit.
#pragma once

#include "measure/statistics/paired_statistics.h"
#include "render/renderer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// Statistics of one of the two sides so far.
struct RouletteSide {
    double path_length = 0;       // mean number of vertices, including the escape to the environment
    double rays_per_path = 0;     // camera, bounce and shadow rays
    double path_seconds = 0;      // time per path
    double variance = 0;          // of the luminance for one path per pixel, mean over pixels; nits^2
    double efficiency = 0;        // 1 / (variance x time per path)
    std::vector<double> alive;    // fraction of paths that reach bounce 0, 1, ...
    std::vector<double> survival; // mean survival probability before bounce 1, 2, ...; negative where roulette was not applied
};

// Difference of means (rule - none) in luminance, relative to the whole image without roulette.
struct RouletteBias {
    std::string name; // "whole image", "bounce 0", ..., "bounce 11+"
    double share = 0; // fraction of the image's light without roulette
    double difference = 0, error = 0;
    bool significant = false; // at a family-wise level of 0.001 over all these tests
};

struct RouletteReport {
    int64_t rounds = 0;
    int width = 0, height = 0, spp = 0; // per round
    RouletteSide rule, none;
    double efficiency_gain = 0, gain_error = 0; // relative to no roulette, with standard error; unknown for 0 rounds
    std::vector<RouletteBias> bias;             // whole image first, then by bounce
    bool biased() const;
};

// Renders in rounds: each side once per round with the same seed, in alternating order, and a new seed per round. Noise and
// machine load affect both equally, and common parts cancel in the differences. Holds its own compiled scene, so that it can run in
// parallel with other renders.
class RouletteComparison {
public:
    explicit RouletteComparison(const RendererOptions& options);
    ~RouletteComparison();

    // Restarts. The image is scaled to at most `longest` pixels on its longer side. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, int longest = 96, int spp = 4);
    // False if `wanted` (called often, from many threads) returned false: the round is then discarded, and no other round can
    // follow.
    bool round(const std::function<bool()>& wanted = {});
    const RouletteReport& report() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
