// The ledger of what is made only where a scene needs it: a line for each such thing, whether it is there, why, and what it costs.
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
    // Memory that it takes, exactly; where it was left out, what that saves. Empty: it takes none of its own.
    std::optional<int64_t> bytes = {};
    // What making it took in this process, in seconds. Empty: not measured.
    std::optional<double> seconds = {};
};
using Ledger = std::vector<FeatureUse>;

// "saves 3.50 MiB, 12.0 ms" of what was left out, "not measured" where no figure is known; without "saves", or empty, of what is in.
std::string cost_text(const FeatureUse& use);

} // namespace blush
