// Metropolis light transport (Veach and Guibas 1997) in primary sample space (Kelemen et al. 2002): a Markov chain whose states are the
// random numbers of bidirectional path tracing. It stays where much light is found. Unbiased: each pass of the image begins its chains by
// resampling independent paths, with their mean as the brightness of the image (Veach 1997, section 11.3.1).
#pragma once

#include "render/comparison/bidirectional.h"

namespace blush {

class Metropolis : public PathReplacement {
public:
    explicit Metropolis(const ComparisonIntegrator& options) : options_(options) {}
    int traced_bounces() const override { return 0; }
    bool prepare(const PreparationContext& context) override;
    bool splats() const override { return true; }
    bool correlates_pixels() const override { return true; } // by states of a chain
    // As many mutations as the image has pixels.
    bool trace_pass(int64_t sample, const PreparationContext& context, std::vector<std::vector<Splat>>& tiles) override;
    size_t memory_bytes() const override { return scene_.emission().memory_bytes(); }

private:
    ComparisonIntegrator options_;
    BidirectionalScene scene_;
};

} // namespace blush
