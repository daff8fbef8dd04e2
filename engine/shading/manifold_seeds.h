// Seeds of manifold sampling (render/integrator/manifold/manifold_sampling.h): where Newton's method looks for the ways by which light
// reaches a rough surface through mirrors and glass. Photons have found them; they are stored by region of the receivers.
#pragma once

#include "shading/path_guiding.h"

#include <cstdint>

namespace blush {

// Specular events between a rough surface and a light; longer chains are left to the other strategies.
constexpr int max_chain_events = 6;

// The events of a chain as one number: bit k is the event k of a path from the rough surface, 1 a refraction, 0 a reflection; the
// number of events is in the bits from chain_count_shift.
constexpr int chain_count_shift = 8;

struct ManifoldSeed {
    Vec3 position;   // where the photon arrived
    Vec3 target;     // point of the first surface of the chain
    int32_t chain;   // its events
    int32_t segment; // that contains this seed
};
// The seeds of a region for one group of lights.
struct ManifoldSegment {
    int32_t group, first, count;
};
struct ManifoldRegion {
    int32_t first, count; // seeds
    int32_t first_segment, segments;
};
// Lights that are sampled as one: the triangles of a mesh, or a single light.
struct ManifoldGroup {
    int32_t first_light, lights; // records
    float share;                 // of the seeds of region 0
};

struct ManifoldTables {
    const int32_t* regions_of_cell = nullptr; // by cell and side (guiding_cell); null: no manifold sampling
    const ManifoldRegion* regions = nullptr;  // 0: the whole scene
    const ManifoldSegment* segments = nullptr;
    const ManifoldSeed* seeds = nullptr;
    const ManifoldGroup* groups = nullptr;
    const int32_t* group_of_light = nullptr; // by record; -1: not sampled
    int32_t lights = 0;
    ReceiverGrid grid;
    CausticCasterTables casters;
    bool shares = true;         // chains with light paths (render/integrator/manifold/path_chain.h)
    GuideTables guides_without; // only for a pilot: how directions are sampled without manifold sampling

    bool empty() const { return !regions_of_cell; }
};

} // namespace blush
