// Embree's filter of candidate hits on materials with alpha, and the context of a query, which tells it what to do.
#pragma once

#include <cstdint>
#include <embree3/rtcore.h>

namespace blush {

struct SceneTables;

// User data of a geometry's opacity filter: the part that its triangles belong to. Embree keeps a pointer to it.
struct AlphaPart {
    const SceneTables* tables;
    int32_t part;
};

// How a query meets points that are neither opaque nor clear.
enum class Blended {
    by_chance,   // they stop a ray with the probability of their opacity
    ignored,     // they stop no ray
    attenuating, // they stop no ray; their transmittances are multiplied
};

struct TraceContext {
    RTCIntersectContext embree; // the first member: filters find the others by its address
    Blended blended;
    // The other members are not used by chance. Then a ray's id is its lane in the packet, and a ray's random number is the lane's:
    const uint32_t* random; // it decides at panes (thin_transmission.h) and in Russian roulette; null: neither
    uint32_t depth[16];     // of the product (transmittance.h)
    uint32_t limit[16];     // a ray of more depth is stopped
};

void opacity_filter(const RTCFilterFunctionNArguments* args);

} // namespace blush
