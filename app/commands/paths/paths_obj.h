// Paths as lines for other programs.
#pragma once

#include "app/commands/paths/pixel_paths.h"

#include <string>

namespace blush {

// Wavefront OBJ: a polyline for each path, and a line for each shadow ray, in metres with +Y up. Vertices have the throughput with which
// the path leaves them as colour. Objects are named sample_N, sample_N_light and sample_N_blocked.
std::string paths_obj(const PixelPaths& p);

} // namespace blush
