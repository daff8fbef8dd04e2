// The feature report: one line for each feature that is built only if a scene needs it, with presence, reason and cost.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// What a pilot measured: ratios with the feature over without it.
struct PilotFigures {
    double mse = 1, relmse = 1; // variance of the samples, over the pixels of all tiles
    double typical = 1;         // the same of a typical tile: geometric mean over the tiles
    double work = 1;            // rays traced, weighted by their usual time
    int group_size = 0;         // path reuse: pixels in a group
    // Work for the same error. Rare samples such as fireflies hold most of a sum over tiles, and whether a short pilot meets them is
    // chance: so half of the weight is on the typical tile, the other half on both sums.
    double cost() const { return std::sqrt(typical * std::sqrt(mse * relmse)) * work; }
    bool operator==(const PilotFigures&) const = default;
};

struct FeatureUse {
    std::string part; // "kernel", "film", "geometry", "textures", "lights", "files", "display", "denoiser"
    std::string name;
    bool used = false;
    std::string why; // "a material reads a texture", "no light has a size"
    // Exact memory use in bytes, or the bytes saved if the feature is absent. Empty: it uses no memory of its own.
    std::optional<int64_t> bytes = {};
    // Time to build it in this process, in seconds. Empty: not measured.
    std::optional<double> seconds = {};
    // Empty: no pilot has measured it.
    std::optional<PilotFigures> pilot = {};
};
using FeatureReport = std::vector<FeatureUse>;

// "saves 3.50 MiB, 12.0 ms" for absent features, "not measured"
// without a figure; for present ones without "saves", possibly empty.
std::string cost_text(const FeatureUse& use);

} // namespace blush
