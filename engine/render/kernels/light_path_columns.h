// The light paths of a tile: how they leave their lights, their state between vertices, and what they give to the film.
#pragma once

#include "core/vec.h"
#include "render/film/splat.h"
#include "render/kernels/column.h"

#include <cstdint>
#include <vector>

namespace blush {

// A light path as it leaves its light.
struct EmittedPath {
    Vec3 origin{0, 0, 0}, direction{0, 0, 1}; // unit direction
    Vec3 light_position{0, 0, 0};             // point of the light; at infinity: unit direction towards it
    Vec3 light_normal{0, 0, 0};               // unit; zero for points and at infinity
    Vec3 flux{0, 0, 0};                       // radiance (point: intensity, parallel sun: irradiance) times cosine over density
    float density = 0;                        // emission_density(); 0: the path does not exist
    int32_t light = 0;                        // record
    uint32_t index = 0;                       // of the sampler
    bool infinite = false, delta = false;     // delta: no ray can hit the light
};

struct LightPathColumns {
    std::vector<EmittedPath> emitted; // by slot; at most tile_capacity
    uint32_t key = 0;                 // of the sampler

    // By path of the two queues: density of the other strategies for the path up to its last vertex over that of light paths, where a
    // camera path hits the light, and where NEE connects to it.
    Column<float> hit_ratio[2], nee_ratio[2];
    // By connection of the shadow queue: image position in pixels; density of the camera's strategies over that of light paths (only if
    // `measures`).
    Column<float> x, y, others;

    std::vector<Splat> splats; // accumulated
    // For the pilot: the connections that became splats. `amount`: luminance without MIS.
    struct Moment {
        int32_t pixel;
        float amount, others;
    };
    bool measures = false;
    std::vector<Moment> moments; // accumulated, if it measures
};

} // namespace blush
