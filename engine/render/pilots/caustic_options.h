// Overrides of what pilots decide about caustics.
#pragma once

#include <optional>

namespace blush {

// Where they are possible; empty: a pilot decides. To measure their effect.
struct CausticOptions {
    std::optional<float> light_path_share; // light paths for each camera path
    std::optional<bool> manifold_sampling;
    std::optional<bool> light_vertices; // beside manifold sampling
    std::optional<bool> shared_chains;  // of manifold sampling and light paths
};

} // namespace blush
