// State and results of delta chains (integrator/delta_chains.h).
#pragma once

#include "core/vec.h"
#include "render/kernels/column.h"

#include <cstdint>
#include <vector>

namespace blush {

class HighlightPlaces;

// What chains are traced for.
enum class ChainTask {
    emission, // the light that they meet
    sight,    // the lamps that they nearly meet
    follow,   // where one chain of known lobes leads from a position on the film
};

// The sample of a pixel whose chains look for lamps.
struct ChainStart {
    float x, y;
    uint32_t index;
};
// The lobes (DeltaLobeKind) of a chain from the camera on, in its lowest bits first.
struct ChainLobeCodes {
    static constexpr int bits_per_lobe = 2;
    uint32_t codes = 0;
    int32_t count = 0;
};
// A lamp that a chain nearly met. `apart`: by 1 - the cosine of the angle between the chain and the lamp.
struct ChainSighting {
    int32_t slot;
    float apart;
    float share; // of the chain
    double rate; // chains that meet it, per chain
    Vec3d light; // nits that each adds to its sample
    // To locate it: the chain's position on the film, pixels, and its lobes; the light, the sampled point on it, which is a direction at
    // infinity, and the density of that.
    float film_x, film_y;
    ChainLobeCodes lobes;
    int32_t light_index;
    Vec3 target;
    float target_density;
};
// A chain to follow, from a position on the film, pixels, with the random numbers of a sample.
struct FollowedChain {
    ChainStart sample;
    float film_x, film_y;
    ChainLobeCodes lobes;
};
// The ray behind its last lobe; invalid where it met another surface than one with its next lobe.
struct FollowedEnd {
    Vec3 origin, direction;
    bool valid = false;
};

struct ChainColumns {
    // Of the queues: the probability with which a path sample would have come so far, over that with which Russian roulette let the chain
    // come so far.
    Column<float> share[2];
    Column<int32_t> lobes[2]; // of the queues: the codes of lobes so far
    Column<int32_t> alive;    // by slot: chains of the sample
    // By slot: the second moment of a path sample, which follows one lobe at each surface, of the luminance that the chains have met.
    Column<double> path_squares;
    Column<float> film_x, film_y; // by slot: position on the film, pixels, where a sample has one other than its path's
    Column<float> weight;         // by slot: of the sample, over that of a path; -1: it keeps the position of its path
    ChainTask task = ChainTask::emission;
    // Emission: samples of pixels with places aim at them; null: none.
    const HighlightPlaces* places = nullptr;
    // Sight: the samples, which are not those of a tile.
    std::vector<ChainStart> samples;
    std::vector<ChainSighting> sightings; // accumulated
    std::vector<uint8_t> turned;          // by sample: a delta lobe goes on from the first surface
    // Follow.
    std::vector<FollowedChain> followed;
    std::vector<FollowedEnd> ends; // of the same size
};

} // namespace blush
