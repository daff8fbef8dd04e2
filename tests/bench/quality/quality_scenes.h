// Scenes of the case "quality" beyond the shipped ones.
#pragma once

#include "core/result.h"
#include "tests/bench/bench_scene.h"

#include <filesystem>
#include <vector>

namespace blush::bench {

// A textured model under an environment map, about a million triangles, an interior lit through a window, a caustic of a point. The model
// is pmndrs.glb of `folder` and the map ../hdri/venice.exr beside it, if both exist; else both are generated. Errors: those of reading the
// files.
Result<std::vector<BenchScene>> quality_scenes(const std::filesystem::path& folder);

} // namespace blush::bench
