// Traces the light paths of one sample again that give light to a pixel.
#pragma once

#include "render/integrator/light_path_emission.h"
#include "render/integrator/path.h"

#include <cstdint>
#include <vector>

namespace blush {

struct ReplayedLightVertex {
    Path<float> path; // its ray hits the vertex
    Hit<float> hit;   // none where the path leaves the scene
    Vec3 light;       // that its connection to the camera gives the pixel; black if it gives none
};
struct ReplayedLightPath {
    EmittedPath emitted;
    Vec3 light{0, 0, 0}; // of all its connections to the pixel
    std::vector<ReplayedLightVertex> vertices = {};
};
struct PixelLightPaths {
    int64_t connections = 0; // that give light to the pixel
    Vec3 light{0, 0, 0};     // of all of them: what the film adds to the radiance of the sample
    std::vector<ReplayedLightPath> brightest;
};

// The light paths of pass `pass`, `paths` of them, that `kernel` connects to pixel x, y. `context.scene` must have the emission. Call it
// from within Workers::run or for_each.
PixelLightPaths replay_light_paths(const KernelContext& context, const Kernel& kernel, const LightPathEmission& emission, int64_t paths,
                                   int64_t pass, int x, int y, TileScratch& scratch);

} // namespace blush
