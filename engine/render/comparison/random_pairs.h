// Random numbers of a path, by dimension: those of a sampler, or the primary sample space of Metropolis light transport.
#pragma once

#include "core/sampler.h"

namespace blush {

class RandomPairs {
public:
    virtual ~RandomPairs() = default;
    // The `dimension`-th pair, uniform in all bits. The same for the same dimension of a path.
    virtual Pair<float> pair(uint32_t dimension) = 0;
};

class SamplerPairs : public RandomPairs {
public:
    explicit SamplerPairs(const Sampler<float>& sampler) : sampler_(sampler) {}
    Pair<float> pair(uint32_t dimension) override { return sampler_.pair(dimension); }

private:
    Sampler<float> sampler_;
};

} // namespace blush
