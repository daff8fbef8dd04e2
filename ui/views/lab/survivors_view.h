// Survivors of Russian roulette, path by path (ui/panels/roulette/survivors.cpp): paths of one pixel, ended with a constant probability
// and weighted up, beside the same number of paths without roulette.
#pragma once

#include "ui/jobs/path_runner.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

struct SurvivorsView {
    static constexpr int64_t most_paths = 400;

    float probability = 0.7f; // of survival at each bounce
    int64_t paths = 100;
    int64_t bounce = 0; // that is shown
    bool playing = false;
    double step_due = 0; // time of the next step of the playback
    // While the section is open.
    std::shared_ptr<PathRunner> with_roulette, without;
    PathRunner::State of_roulette, of_none;

    void stop();
};

// How a path stands behind a bounce.
struct Survivor {
    enum class Fate { lives, ended, killed }; // ended: by itself, at a light, outside or absorbed; killed: by roulette
    Fate fate = Fate::lives;
    double weight = 1; // product of 1/q over the decisions that it survived; 0 if it was killed
    bool operator==(const Survivor&) const = default;
};

struct Survivors {
    std::vector<Survivor> paths;
    std::array<int64_t, 3> counts{}; // by fate
    double weight = 0;               // sum over all paths: its expectation is their number
    double living_weight = 0;        // of one path that lives, mean; 0: none lives
};
// Behind the decision at vertex `bounce` - 1; 0: before the first one.
Survivors survivors_behind(const PathSet& set, int64_t bounce);
// The most vertices of a path.
int64_t most_bounces(const PathSet& set);

// What the paths of a pixel give, and cost.
struct PathCost {
    double mean = 0, half = 0; // luminance, nits; half of its 95 % confidence interval
    double variance = 0;       // of one path, nits^2
    double vertices = 0;       // of a path, mean
};
// Empty for fewer than two valid paths.
std::optional<PathCost> cost_of(const PathSet& set);

// The next bounce of the playback, after the last one the first again. Returns the seconds until the next step.
double play(SurvivorsView& view, int64_t last_bounce, double now);

} // namespace blush
