// JSON of `blush paths`.
#pragma once

#include "app/commands/json_output.h"
#include "app/commands/paths/pixel_paths.h"

namespace blush {

// All vertices of all paths, their arithmetic, the sum and the film's value (docs/reference/json.md).
OrderedJson paths_json(const PixelPaths& p);

} // namespace blush
