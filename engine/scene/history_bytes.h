// How much memory a step of history keeps alive.
#pragma once

#include "scene/edit.h"

#include <cstddef>

namespace blush {

// Estimate of what `kept` holds in memory that `neighbour` does not share: whole tables (they are copied when one record changes), and
// pixels that have no other owner left.
size_t bytes_held(const Project& kept, const Project& neighbour);

} // namespace blush
