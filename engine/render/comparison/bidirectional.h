// Bidirectional path tracing (Lafortune and Willems 1993; Veach 1997, chapter 10), full, with MIS: for each sample of a pixel a path from
// the camera and a path from a light, each vertex of one connected with each of the other. Unbiased.
#pragma once

#include "render/comparison/bidirectional_paths.h"
#include "render/comparison/indirect_light.h"

#include <vector>

namespace blush {

// The tables that both paths need, for one image.
class BidirectionalScene {
public:
    void prepare(const PreparationContext& context);
    const LightPathEmission& emission() const { return emission_; }
    // `tables`: memory of the context's scene.
    KernelContext context(const KernelContext& whole, SceneTables& tables) const;

private:
    LightPathEmission emission_;
};

class Bidirectional : public PathReplacement {
public:
    int traced_bounces() const override { return 0; }
    bool prepare(const PreparationContext& context) override;
    bool splats() const override { return true; }
    bool trace_pass(int64_t sample, const PreparationContext& context, std::vector<std::vector<Splat>>& tiles) override;
    size_t memory_bytes() const override { return scene_.emission().memory_bytes(); }

private:
    BidirectionalScene scene_;
};

} // namespace blush
