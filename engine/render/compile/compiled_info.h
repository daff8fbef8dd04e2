// Statistics of a compiled scene.
#pragma once

#include "core/result.h"
#include "render/compile/feature_report.h"

#include <cstdint>
#include <string>
#include <vector>

namespace blush {

// Numbers as rendered, after area lights became meshes.
struct CompiledInfo {
    int64_t meshes = 0, instances = 0, materials = 0, textures = 0;
    int64_t triangles = 0; // as traced: instances are counted each time
    int64_t emissive_triangles = 0, point_lights = 0, suns = 0;
    bool environment = false;
    std::string kernel;               // "v4/plain"
    FeatureReport features;           // feature report: of the kernel and of everything built only if needed
    double memory_mb = 0;             // tables, textures and Embree's BVH
    double seconds_setup = 0;         // the last update: from scene to first ray
    std::vector<Diagnostic> warnings; // objects without area, broken textures, ...
};

} // namespace blush
