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
    both,        // they stop a ray by chance, and the transmittances of all are multiplied
};

constexpr int max_packet = 16;

// By lane of a packet: the nearest of the hits that stop a ray by chance, as Embree numbers it.
struct ChosenHits {
    float t[max_packet], u[max_packet], v[max_packet];
    uint32_t geometry[max_packet], instance[max_packet], triangle[max_packet];
};

struct TraceContext {
    RTCIntersectContext embree; // the first member: filters find the others by its address
    Blended blended;
    // A ray's id is its lane in the packet.
    const uint32_t* random;     // of the lanes; attenuating: decides at panes (thin_transmission.h) and in Russian roulette; null: neither
    const uint32_t* index;      // of the lanes (RayArrays); null: 0
    uint32_t depth[max_packet]; // attenuating, both: of the product (transmittance.h)
    uint32_t limit[max_packet]; // a ray of more depth is stopped
    ChosenHits* chosen;         // both: t is infinite at first
};

void opacity_filter(const RTCFilterFunctionNArguments* args);

} // namespace blush
