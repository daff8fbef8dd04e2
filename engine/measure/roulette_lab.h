// Russian roulette on the bench: the rule and bounce limit of the settings against neither, rendered side by side.
#pragma once

#include "measure/paired_trials.h"
#include "render/renderer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// What one of the two sides came to so far.
struct RouletteSide {
    double path_length = 0;       // mean number of vertices, the one where the path leaves the scene among them
    double rays_per_path = 0;     // camera, bounce and shadow rays
    double path_seconds = 0;      // time per path
    double variance = 0;          // of one path per pixel, mean over pixels of the luminance's; nits^2
    double efficiency = 0;        // 1 / (variance x time per path)
    std::vector<double> alive;    // share of the paths that get to bounce 0, 1, ...
    std::vector<double> survival; // chance that roulette gave before bounce 1, 2, ... ; negative where it was not asked
};

// A difference of means, rule - none, in luminance relative to the whole image without roulette.
struct RouletteBias {
    std::string name; // "whole image", "bounce 0", ..., "bounce 11+"
    double share = 0; // of the image's light without roulette
    double difference = 0, error = 0;
    bool significant = false; // beyond what noise gives once in a thousand runs of all these tests together
};

struct RouletteReport {
    int64_t rounds = 0;
    int width = 0, height = 0, spp = 0; // of one round
    RouletteSide rule, none;
    double efficiency_gain = 0, gain_error = 0; // efficiency relative to no roulette, and its standard error; 0 rounds: not known
    std::vector<RouletteBias> bias;             // the whole image first, then by bounce
    bool biased() const;
};

// Renders in rounds, each side once per round with the same seed, a new one in each round, in alternating order: noise and the machine's
// moods strike both alike, and what is common to both cancels in the differences. A scene of its own, so that it can run beside others.
class RouletteLab {
public:
    explicit RouletteLab(const RendererOptions& options);
    ~RouletteLab();

    // Starts anew. The picture is scaled to at most `longest` pixels on its longer side. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, int longest = 96, int spp = 4);
    // False if `wanted` (called often, from many threads) said so and the round was given up; it then counts for nothing, and no other can
    // follow.
    bool round(const std::function<bool()>& wanted = {});
    const RouletteReport& report() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
