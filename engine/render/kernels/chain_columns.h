// State and results of delta chains (integrator/delta_chains.h).
#pragma once

#include "core/vec.h"
#include "render/kernels/column.h"

#include <cstdint>
#include <vector>

namespace blush {

// The sample of a pixel whose chains look for lamps.
struct ChainStart {
    float x, y;
    uint32_t index;
};
// A lamp that a chain nearly met. `apart`: by 1 - the cosine of the angle between the chain and the lamp.
struct ChainSighting {
    int32_t slot;
    float apart;
    float share; // of the chain
    double rate; // chains that meet it, per chain
    Vec3d light; // nits that each adds to its sample
};

struct ChainColumns {
    // Of the queues: the probability with which a path sample would have come so far, over that with which Russian roulette let the chain
    // come so far.
    Column<float> share[2];
    Column<int32_t> alive; // by slot: chains of the sample
    // By slot: the second moment of a path sample, which follows one lobe at each surface, of the luminance that the chains have met.
    Column<double> path_squares;
    // For the pilot of highlights: chains look for lamps and find no light. The samples are these, not those of a tile.
    bool sights = false;
    std::vector<ChainStart> samples;
    std::vector<ChainSighting> sightings; // accumulated
    std::vector<uint8_t> turned;          // by sample: a delta lobe goes on from the first surface
};

} // namespace blush
