// The feature report: one line for each feature that is built only if a scene needs it, with presence, reason and cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct FeatureUse {
    std::string part; // "kernel", "film", "geometry", "textures", "lights", "display", "denoiser"
    std::string name;
    bool used = false;
    std::string why; // "a material reads a texture", "no light has a size"
    // Exact memory use in bytes, or the bytes saved if the feature is absent. Empty: it uses no memory of its own.
    std::optional<int64_t> bytes = {};
    // Time to build it in this process, in seconds. Empty: not measured.
    std::optional<double> seconds = {};
};
using FeatureReport = std::vector<FeatureUse>;

// "saves 3.50 MiB, 12.0 ms" for absent features, "not measured"
// without a figure; for present ones without "saves", possibly empty.
std::string cost_text(const FeatureUse& use);

} // namespace blush
